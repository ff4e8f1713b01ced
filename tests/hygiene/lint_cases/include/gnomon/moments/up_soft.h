// expect: include goes up
#ifndef GNOMON_MOMENTS_UP_SOFT_H
#define GNOMON_MOMENTS_UP_SOFT_H
#include "../soft/penumbra.h"
#endif
