// expect: nothing
#include "image_code.hpp"
#include "made_by_the_build.h"
