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

// Functions are called by pointers: code around each kernel takes minutes to compile.
template <class T> using kernel_run = void (*)(std::size_t blocks, const T* in, T* out);

template <class T> struct tested_kernel {
    const char* name;
    std::size_t inputs, outputs;
    const char* families;
    kernel_run<T> scalars, packs; // no packs where the target has none
};

#if defined(GNOMON_TEST_HOST)
template <class T> using tested_pack = T;
#elif defined(GNOMON_TEST_STD_SIMD)
template <class T> using tested_pack = pack<std::experimental::native_simd<T>>;
#elif defined(GNOMON_SIMD_XSIMD_HPP)
template <class T, bool = has_batch<T>> struct pack_or_scalar {
    using type = pack<xsimd::batch<T>>;
};
template <class T> struct pack_or_scalar<T, false> {
    using type = T;
};
template <class T> using tested_pack = typename pack_or_scalar<T>::type;
#else
template <class T> using tested_pack = T;
#endif

template <class T>
void compare(exchange& x, const tested_kernel<T>& k, const std::string& real, kernel_run<T> run,
             const std::vector<T>& in, const std::vector<T>& expected)
{
    std::vector<T> out(expected.size());
    run(blocks, in.data(), out.data());
    std::size_t differ = 0, first = 0;
    for (std::size_t i = out.size(); i-- > 0;)
        if (!alike(out[i], expected[i])) ++differ, first = i;
    ++x.compared, x.wrong += differ > 0;
    if (differ == 0) return;
    std::printf("%s, %s: %zu of %zu results differ; first %a, not %a, of", k.name, real.c_str(), differ, out.size(),
                double(out[first]), double(expected[first]));
    const std::size_t block = first / (block_rows * k.outputs), row = first % block_rows;
    for (std::size_t j = 0; j < k.inputs; ++j)
        std::printf(" %a", double(in[(block * k.inputs + j) * block_rows + row]));
    std::printf("\n");
}

template <class T> void exchange_rows(exchange& x, const tested_kernel<T>& k)
{
    std::vector<T> in(blocks * block_rows * k.inputs), out(blocks * block_rows * k.outputs);
    if (x.write) {
        kernel_inputs<T>(k.name, k.families, k.inputs).draw(blocks, in.data());
        k.scalars(blocks, in.data(), out.data());
    }
    x.pass(in), x.pass(out);
    if (x.write) return;
    compare(x, k, real_name<T>(), k.scalars, in, out);
    const flushed_denormals flushed;
    if constexpr (packs_flush) k.scalars(blocks, in.data(), out.data());
    if constexpr (!std::is_same_v<tested_pack<T>, T>) compare(x, k, real_name<tested_pack<T>>(), k.packs, in, out);
}

template <class T> void exchange_kernels(exchange& x)
{
#define RUN(Real, name) &kernel_call<Real, &gnomon::name<Real>>::run
#define ENTRY(name, inputs, outputs, families, unit) \
    {#name, inputs, outputs, families, RUN(T, name), RUN(tested_pack<T>, name)},
    static constexpr tested_kernel<T> kernels[] = {GNOMON_FOR_EACH_KERNEL(ENTRY)};
#undef ENTRY
#undef RUN
    for (const tested_kernel<T>& k : kernels) exchange_rows(x, k);
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
