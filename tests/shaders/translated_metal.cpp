// What a translator makes of the kernels for Metal, by clang under fast mathematics that no macro tells of, as a module. Apple's
// compilers are clang, too.
#include <metal_stdlib>

using namespace metal;

#include "module.hpp"
#include "translated.metal"

namespace {

template <class In, class Out> auto entry(void (*function)(const In&, Out&, uint3, uint))
{
    return [function](const float* in, float* out, uint group, uint lane) {
        function(reinterpret_cast<const In&>(*in), reinterpret_cast<Out&>(*out), {group, 0, 0}, lane);
    };
}

template <class In, class Out, class Sizes> auto entry(void (*function)(uint3, uint, const In&, Out&, Sizes&))
{
    return [function](const float* in, float* out, uint group, uint lane) {
        Sizes sizes{};
        function({group, 0, 0}, lane, reinterpret_cast<const In&>(*in), reinterpret_cast<Out&>(*out), sizes);
    };
}

template <class Function> bool run_blocks(Function function, std::size_t blocks, const float* in, float* out)
{
    for (uint group = 0; group < blocks; ++group)
        for (uint lane = 0; lane < 64; ++lane) function(in, out, group, lane);
    return true;
}

} // namespace

GNOMON_PARITY_EXPORT const char* parity_device() { return "split clang, by a translator, fast mathematics"; }

GNOMON_PARITY_EXPORT bool parity_run(const char* kernel_name, std::size_t blocks, const float* in, float* out)
{
#define RUN(name) \
    if (__builtin_strcmp(kernel_name, #name) == 0) return run_blocks(entry(translated_##name::MAIN), blocks, in, out);
    FOR_EACH_TRANSLATED(RUN)
    return false;
}
