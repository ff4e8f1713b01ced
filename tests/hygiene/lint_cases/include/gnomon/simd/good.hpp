// expect: nothing
#ifndef GNOMON_SIMD_GOOD_HPP
#define GNOMON_SIMD_GOOD_HPP
#include "../passes/blur.hpp"
#include <xsimd/xsimd.hpp>
#include <cmath>
#define GNOMON_PACK 1
inline auto* f(auto& x) { return x ? &x : nullptr; }
#endif
