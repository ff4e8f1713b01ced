// expect: include goes up
#ifndef GNOMON_PASSES_UP_ADAPTER_HPP
#define GNOMON_PASSES_UP_ADAPTER_HPP
#include <gnomon/adapters/glm.hpp>
#endif
