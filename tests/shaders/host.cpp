// The kernels for one Real, REAL, as a module: each module is compiled with flags of its own, and none may take
// another's instantiations.
#include "kernels.hpp"
#include "module.hpp"
#include "support/kernel_call.hpp"

#include <gnomon/simd/wide.hpp>

#include <string_view>

using namespace gnomon;

template <std::size_t count> using lanes = pack<xsimd::make_sized_batch_t<float, count>>;
using number = REAL;

GNOMON_PARITY_EXPORT const char* parity_device() { return is_fused<number> ? "fused host" : "split host"; }

GNOMON_PARITY_EXPORT bool parity_run(const char* kernel, std::size_t blocks, const float* in, float* out)
{
#define RUN(name, ...) \
    if (std::string_view(kernel) == #name) return test::kernel_call<number, &name<number>>::run(blocks, in, out), true;
    GNOMON_FOR_EACH_KERNEL(RUN)
    return false;
}
