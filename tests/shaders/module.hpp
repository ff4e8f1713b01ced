// Functions that a shared object exports to be a route (module_route.cpp loads it).
#pragma once

#include <cstddef>

#define GNOMON_PARITY_EXPORT extern "C" __attribute__((visibility("default")))

/// "fused" or "split" (route.hpp, products), a space and where it runs; or "unavailable", a space and why.
GNOMON_PARITY_EXPORT const char* parity_device();

/// Runs a kernel over blocks; false where there is none of this name.
GNOMON_PARITY_EXPORT bool parity_run(const char* kernel, std::size_t blocks, const float* in, float* out);
