// expect: include goes up
#ifndef GNOMON_GNOMON_H
#define GNOMON_GNOMON_H
#include "simd/xsimd.hpp"
#include "passes/blur.hpp"
#include "passes/layers/layer_map.hpp"
#endif
