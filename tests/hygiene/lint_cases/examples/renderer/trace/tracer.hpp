// expect: include goes up
#include "../../evaluation/core/report.hpp"
