// expect: include goes up
#ifndef GNOMON_SCATTERING_UP_PASS_H
#define GNOMON_SCATTERING_UP_PASS_H
#include "../passes.h"
#endif
