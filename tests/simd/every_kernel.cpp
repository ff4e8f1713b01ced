// Every kernel on another target. The host writes rows of inputs with the results of its scalars; the target runs the
// same rows, and its scalars and packs must have the same bits.
//
//     every_kernel write FILE    on the host
//     every_kernel read FILE     on the target; exit status 1 and a line for each kernel and Real that differs
//
// Both must make exact products in one way, by fused multiply-add or by splitting: these differ where a product over- or
// underflows.
#include "alike.hpp"
#include "kernels.hpp"
#include "support/kernel_inputs.hpp"

#if defined(GNOMON_TEST_STD_SIMD)
#include <gnomon/simd/std_simd.hpp>
#endif

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr std::size_t blocks = 16; // of 64 rows

struct exchange {
    std::FILE* file;
    bool write;
    int compared = 0, wrong = 0;

    template <class T> void pass(std::vector<T>& numbers)
    {
        const std::size_t done = write ? std::fwrite(numbers.data(), sizeof(T), numbers.size(), file)
                                       : std::fread(numbers.data(), sizeof(T), numbers.size(), file);
        if (done == numbers.size()) return;
        std::fprintf(stderr, "every_kernel: cannot %s all rows\n", write ? "write" : "read");
        std::exit(2);
    }
};

struct kernel_shape {
    const char* name;
    std::size_t inputs, outputs;
    const char* families;
};

template <class Real, class T, class Run>
void compare(exchange& x, const kernel_shape& k, const std::vector<T>& in, const std::vector<T>& expected, Run run)
{
    std::vector<T> out(expected.size());
    run.template operator()<Real>(in.data(), out.data());
    std::size_t differ = 0, first = 0;
    for (std::size_t i = out.size(); i-- > 0;)
        if (!alike(out[i], expected[i])) ++differ, first = i;
    ++x.compared, x.wrong += differ > 0;
    if (differ == 0) return;
    std::printf("%s, %s: %zu of %zu results differ; first %a, not %a, of", k.name, real_name<Real>().c_str(), differ,
                out.size(), double(out[first]), double(expected[first]));
    const std::size_t block = first / (block_rows * k.outputs), row = first % block_rows;
    for (std::size_t j = 0; j < k.inputs; ++j)
        std::printf(" %a", double(in[(block * k.inputs + j) * block_rows + row]));
    std::printf("\n");
}

/// run.operator()<Real>(in, out) calls the kernel for Real.
template <class T, class Run> void exchange_rows(exchange& x, const kernel_shape& k, Run run)
{
    std::vector<T> in(blocks * block_rows * k.inputs), out(blocks * block_rows * k.outputs);
    if (x.write) {
        kernel_inputs<T>(k.name, k.families, k.inputs).draw(blocks, in.data());
        run.template operator()<T>(in.data(), out.data());
    }
    x.pass(in), x.pass(out);
#if !defined(GNOMON_TEST_HOST)
    if (x.write) return;
    compare<T>(x, k, in, out, run);
    const flushed_denormals flushed;
    if constexpr (packs_flush) run.template operator()<T>(in.data(), out.data());
#if defined(GNOMON_TEST_STD_SIMD)
    compare<pack<std::experimental::native_simd<T>>>(x, k, in, out, run);
#elif defined(GNOMON_SIMD_XSIMD_HPP)
    if constexpr (has_batch<T>) compare<pack<xsimd::batch<T>>>(x, k, in, out, run);
#endif
#endif
}

template <class T> void exchange_kernels(exchange& x)
{
#define EXCHANGE_KERNEL(name, inputs, outputs, families, unit)                                    \
    exchange_rows<T>(x, {#name, inputs, outputs, families}, []<class Real>(const T* in, T* out) { \
        kernel_call<Real, &gnomon::name<Real>>::run(blocks, in, out);                             \
    });
    GNOMON_FOR_EACH_KERNEL(EXCHANGE_KERNEL)
#undef EXCHANGE_KERNEL
}

} // namespace

int main(int argc, char** argv)
{
    const std::string word = argc == 3 ? argv[1] : "";
    if (word != "write" && word != "read") return std::fprintf(stderr, "usage: every_kernel write|read FILE\n"), 2;
    exchange x{std::fopen(argv[2], word == "write" ? "wb" : "rb"), word == "write"};
    if (!x.file) return std::perror(argv[2]), 2;
    exchange_kernels<float>(x);
#if !defined(GNOMON_TEST_FLOAT)
    exchange_kernels<double>(x);
#endif
    if (std::fclose(x.file) != 0) return std::perror(argv[2]), 2;
    if (!x.write) std::printf("%d of %d kernels and Reals differ from the host\n", x.wrong, x.compared);
    return x.wrong > 0;
}
