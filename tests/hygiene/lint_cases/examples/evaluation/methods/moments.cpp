// expect: include goes up
#include "evaluation/hard/driver.hpp"
