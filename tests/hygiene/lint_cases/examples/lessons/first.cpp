// expect: nothing
#include "parts.hpp"
