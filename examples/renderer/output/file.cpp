#include "file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

namespace gnomon::renderer {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, std::string_view cause)
{
    throw std::runtime_error(fmt::format("{}: {}", file.string(), cause));
}

} // namespace

std::string read_file(const std::filesystem::path& file)
{
    if (std::filesystem::is_directory(file)) fail(file, "is a folder");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) fail(file, std::strerror(errno));
    std::string content{std::istreambuf_iterator<char>(stream), {}};
    if (stream.bad()) fail(file, "cannot be read");
    return content;
}

void write_file(const std::filesystem::path& file, std::string_view content)
{
    std::error_code error;
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
    if (error) fail(file, error.message());
    const std::filesystem::path part = file.string() + ".part";
    std::ofstream stream(part, std::ios::binary | std::ios::trunc);
    if (!stream) fail(part, std::strerror(errno));
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
    stream.close();
    if (stream) std::filesystem::rename(part, file, error);
    if (stream && !error) return;
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    fail(file, error ? error.message() : "cannot be written in full");
}

} // namespace gnomon::renderer
