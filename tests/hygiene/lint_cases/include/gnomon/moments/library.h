// expect: include of a library
#ifndef GNOMON_MOMENTS_LIBRARY_H
#define GNOMON_MOMENTS_LIBRARY_H
#include <cmath>
#endif
