// Every kernel of kernels.txt on inputs of every kind, in T and in packs of T: promised results are in [0, 1] for ten
// million hostile inputs, and packs give the bits of the scalar.
#pragma once

#include "kernels.hpp"
#include "support/effort.hpp"
#include "support/kernel_inputs.hpp"

#include <gnomon/simd/wide.hpp>

#include <doctest/doctest.h>

#include <string>

namespace gnomon::test {

template <class T> using kernel_run = void (*)(std::size_t blocks, const T* in, T* out);

/// A kernel as kernels.txt has it, for T and for packs of T.
template <class T> struct tested_kernel {
    const char* name;
    std::size_t inputs, outputs;
    const char* families;
    bool unit;
    kernel_run<T> scalars, narrow_packs, wide_packs;
};

template <class T> using narrow_pack = gnomon::pack<xsimd::make_sized_batch_t<T, 16 / sizeof(T)>>;
template <class T> using wide_pack = wide<gnomon::pack<xsimd::batch<T>>>;

/// A text of the row that holds result i, for messages.
template <class T>
std::string row_text(const tested_kernel<T>& k, const std::vector<T>& in, const std::vector<T>& out, std::size_t i)
{
    const std::size_t block = i / (block_rows * k.outputs), row = i % block_rows;
    std::string text = k.name;
    char number[40];
    const auto append = [&](const char* before, const std::vector<T>& from, std::size_t numbers) {
        text += before;
        for (std::size_t j = 0; j < numbers; ++j) {
            std::snprintf(number, sizeof number, " %a", double(from[(block * numbers + j) * block_rows + row]));
            text += number;
        }
    };
    append(" of", in, k.inputs);
    append(" is", out, k.outputs);
    return text;
}

/// The first mistake of a kernel, or an empty text.
template <class T> std::string first_mistake(const tested_kernel<T>& k)
{
    constexpr std::size_t blocks = 64;
    kernel_inputs<T> source(k.name, k.families, k.inputs);
    std::vector<T> in(blocks * block_rows * k.inputs), scalar(blocks * block_rows * k.outputs), lanes(scalar.size());
    const auto mistake_of = [&](kernel_run<T> packs, const std::string& real) -> std::string {
        if (packs == nullptr) return {};
        packs(blocks, in.data(), lanes.data());
        for (std::size_t i = 0; i < scalar.size(); ++i)
            if (!same(scalar[i], lanes[i]))
                return real + ": " + row_text(k, in, lanes, i) + ", not as" + row_text(k, in, scalar, i);
        return {};
    };
    const std::int64_t mixed = effort(200'000) / std::int64_t(blocks * block_rows) + 1;
    const std::int64_t hostile = k.unit ? effort(4'000'000) / std::int64_t(blocks * block_rows) + 1 : 0;
    for (std::int64_t batch = 0; batch < mixed + hostile; ++batch) {
        source.draw(blocks, in.data(), batch < mixed ? row_kind::all : row_kind::hostile);
        k.scalars(blocks, in.data(), scalar.data());
        for (std::size_t i = 0; k.unit && i < scalar.size(); ++i)
            if (!(scalar[i] >= 0 && scalar[i] <= 1)) return row_text(k, in, scalar, i);
        if (batch > mixed && batch % 16 != 0) continue;
        std::string mistake = mistake_of(k.narrow_packs, real_name<narrow_pack<T>>());
        if (mistake.empty()) mistake = mistake_of(k.wide_packs, real_name<wide_pack<T>>());
        if (!mistake.empty()) return mistake;
    }
    return {};
}

template <class T> void check_every_kernel()
{
#define CHECK_LINE(name, inputs_, outputs_, ...)                               \
    static_assert(kernel_call<T, &gnomon::name<T>>::inputs == (inputs_) &&     \
                      kernel_call<T, &gnomon::name<T>>::outputs == (outputs_), \
                  "kernels.py has misread " #name);
    GNOMON_FOR_EACH_KERNEL(CHECK_LINE)
#undef CHECK_LINE

    // A table, since code for each kernel takes minutes to compile.
#define RUN(Real, name) &kernel_call<Real, &gnomon::name<Real>>::run
#if !defined(__SANITIZE_ADDRESS__) // as in reals.hpp
#define PACKS(name) RUN(narrow_pack<T>, name), RUN(wide_pack<T>, name)
#else
#define PACKS(name) nullptr, nullptr
#endif
#define ENTRY(name, ...) {#name, __VA_ARGS__, RUN(T, name), PACKS(name)},
    static constexpr tested_kernel<T> kernels[] = {GNOMON_FOR_EACH_KERNEL(ENTRY)};
#undef ENTRY
#undef PACKS
#undef RUN
    for (const tested_kernel<T>& k : kernels) {
        const std::string mistake = first_mistake(k);
        CHECK_MESSAGE(mistake.empty(), mistake);
    }
}

} // namespace gnomon::test
