// expect: nothing
#include "evaluation/methods/variance.hpp"
