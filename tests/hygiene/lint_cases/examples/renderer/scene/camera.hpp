// expect: nothing
#include "../output/image.hpp"
