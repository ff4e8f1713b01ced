// tinygltf, compiled once.
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
