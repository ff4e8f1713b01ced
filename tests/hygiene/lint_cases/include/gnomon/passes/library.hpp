// expect: include of a library
#ifndef GNOMON_PASSES_LIBRARY_HPP
#define GNOMON_PASSES_LIBRARY_HPP
#include <glm/glm.hpp>
#endif
