#include "drivers.hpp"
void gnomon::demo::bounds(const settings&) {}
