// expect: include goes up
#ifndef GNOMON_PASSES_UP_EVERYTHING_HPP
#define GNOMON_PASSES_UP_EVERYTHING_HPP
#include "../../../examples/toolbox/image.hpp"
#endif
