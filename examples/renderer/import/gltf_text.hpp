// Checks of the text of a glTF file that tinygltf does not make: tinygltf treats a value of a wrong type as absent,
// cuts indices to 32 bits, and supports no extension that moves vertices. Functions throw std::runtime_error with the
// cause.
#pragma once

#include <string_view>

namespace gnomon::renderer {

// True for a binary file.
bool is_gltf_binary(std::string_view bytes);

// True for a file that declares version 1.
bool is_gltf_1(std::string_view bytes);

// The JSON text of a file. Throws if a chunk of a binary file ends beyond the file: tinygltf would read up to eight
// bytes beyond.
std::string_view gltf_json_text(std::string_view bytes);

// Refuses versions other than 2, required extensions other than those for materials, textures, lights and the types of
// vertex attributes, and values of a wrong type that determine the place of a vertex.
void check_gltf_text(std::string_view text);

} // namespace gnomon::renderer
