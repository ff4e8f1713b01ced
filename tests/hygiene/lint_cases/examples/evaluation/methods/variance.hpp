// expect: nothing
#include "evaluation/core/report.hpp"
