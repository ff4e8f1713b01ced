// expect: include goes up
#include "lessons/parts.hpp"
