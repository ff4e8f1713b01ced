// expect: include goes up
#include "../methods/variance.hpp"
