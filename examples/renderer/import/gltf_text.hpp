// Checks of the text of a glTF file that tinygltf does not make: it takes a value of the wrong type for an absent one,
// cuts indices to 32 bits, and knows no extension that moves corners. Functions throw std::runtime_error with the
// cause.
#pragma once

#include <string_view>

namespace gnomon::renderer {

// True for a file of chunks, not of text.
bool is_gltf_binary(std::string_view bytes);

// True for a file that says that it is of version 1.
bool is_gltf_1(std::string_view bytes);

// The JSON text of a file. Both chunks of a binary one must end within the file: tinygltf reads up to eight bytes
// beyond it.
std::string_view gltf_json_text(std::string_view bytes);

// Refuses versions other than 2, extensions that the file requires, unless they concern materials, textures and lights
// alone or the types of vertex attributes, and values of the wrong type where they say where a corner is.
void check_gltf_text(std::string_view text);

} // namespace gnomon::renderer
