// expect: nothing
#ifndef GNOMON_PASSES_LAYERS_LAYER_MAP_HPP
#define GNOMON_PASSES_LAYERS_LAYER_MAP_HPP
#include <gnomon/motion/layers/layer_grid.h>
#endif
