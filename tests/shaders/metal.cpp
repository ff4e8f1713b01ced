// The Metal text of every kernel, read by clang with the stand-in for metal_stdlib, as a module: it proves the text and
// its translation, not Apple's compiler.
#include "kernels.hpp"
#include "metal/kernels.metal"
#include "module.hpp"

namespace {

template <class Function> void run_blocks(Function function, std::size_t blocks, const float* in, float* out)
{
    for (uint group = 0; group < blocks; ++group)
        for (uint lane = 0; lane < 64; ++lane) function(in, out, group, lane);
}

bool same_name(const char* a, const char* b)
{
    for (; *a != 0 && *a == *b; ++a, ++b) {
    }
    return *a == *b;
}

} // namespace

GNOMON_PARITY_EXPORT const char* parity_device() { return GNOMON_FUSED ? "fused clang" : "split clang"; }

GNOMON_PARITY_EXPORT bool parity_run(const char* kernel_name, std::size_t blocks, const float* in, float* out)
{
#define RUN(name, ...) \
    if (same_name(kernel_name, #name)) return run_blocks(parity_##name, blocks, in, out), true;
    GNOMON_FOR_EACH_KERNEL(RUN)
    return false;
}
