// expect: nothing
#ifndef GNOMON_MOTION_LAYERS_LAYER_GRID_H
#define GNOMON_MOTION_LAYERS_LAYER_GRID_H
#include "stochastic_sample.h"
#endif
