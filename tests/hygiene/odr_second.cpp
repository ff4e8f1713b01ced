#include "all_headers.hpp"

double saturated_elsewhere(double x);
double saturated_elsewhere(double x) { return gnomon::saturate_or_zero(x); }
