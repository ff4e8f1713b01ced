// Whole files, read and written in one go.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gnomon::renderer {

// Throws std::runtime_error "FILE: cause" on failure.
std::string read_file(const std::filesystem::path& file);

// Writes FILE.part, then renames it to FILE: whoever reads FILE sees the earlier content or all of the new one. Makes
// missing folders. Throws std::runtime_error "FILE: cause" on failure.
void write_file(const std::filesystem::path& file, std::string_view content);

} // namespace gnomon::renderer
