// expect: name of a layer
#ifndef GNOMON_PASSES_LAYERS_MAP_OF_LAYERS_HPP
#define GNOMON_PASSES_LAYERS_MAP_OF_LAYERS_HPP
#endif
