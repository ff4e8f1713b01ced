// expect: include of a layer
#ifndef GNOMON_PASSES_MAP_OF_SAMPLES_HPP
#define GNOMON_PASSES_MAP_OF_SAMPLES_HPP
#include "../motion/layers/layer_grid.h"
#include "../motion/layers/stochastic_sample.h"
#endif
