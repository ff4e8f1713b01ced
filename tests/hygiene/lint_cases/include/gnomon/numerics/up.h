// expect: include goes up
#ifndef GNOMON_NUMERICS_UP_H
#define GNOMON_NUMERICS_UP_H
#include "../moments/hankel4.h"
#endif
