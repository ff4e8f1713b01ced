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

struct kernel_shape {
    const char* name;
    std::size_t inputs, outputs;
    const char* families;
    bool unit;
};

/// A text of the row that holds result i, for messages.
template <class T>
std::string row_text(const kernel_shape& k, const std::vector<T>& in, const std::vector<T>& out, std::size_t i)
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

/// The first mistake of a kernel, or an empty text. run.operator()<Real>(blocks, in, out) calls the kernel for Real.
template <class T, class Run> std::string first_mistake(const kernel_shape& k, Run run)
{
    constexpr std::size_t blocks = 64;
    kernel_inputs<T> source(k.name, k.families, k.inputs);
    std::vector<T> in(blocks * block_rows * k.inputs), scalar(blocks * block_rows * k.outputs), lanes(scalar.size());
    const std::int64_t mixed = effort(200'000) / std::int64_t(blocks * block_rows) + 1;
    const std::int64_t hostile = k.unit ? effort(4'000'000) / std::int64_t(blocks * block_rows) + 1 : 0;
    for (std::int64_t batch = 0; batch < mixed + hostile; ++batch) {
        source.draw(blocks, in.data(), batch < mixed ? row_kind::all : row_kind::hostile);
        run.template operator()<T>(blocks, in.data(), scalar.data());
        for (std::size_t i = 0; k.unit && i < scalar.size(); ++i)
            if (!(scalar[i] >= 0 && scalar[i] <= 1)) return row_text(k, in, scalar, i);
        if (batch > mixed && batch % 16 != 0) continue;
        std::string mistake;
        const auto compare = [&]<class Pack> {
            run.template operator()<Pack>(blocks, in.data(), lanes.data());
            for (std::size_t i = 0; i < scalar.size() && mistake.empty(); ++i)
                if (!same(scalar[i], lanes[i]))
                    mistake =
                        real_name<Pack>() + ": " + row_text(k, in, lanes, i) + ", not as" + row_text(k, in, scalar, i);
        };
#if !defined(__SANITIZE_ADDRESS__) // as in reals.hpp
        compare.template operator()<gnomon::pack<xsimd::make_sized_batch_t<T, 16 / sizeof(T)>>>();
        compare.template operator()<wide<gnomon::pack<xsimd::batch<T>>>>();
#else
        static_cast<void>(compare);
#endif
        if (!mistake.empty()) return mistake;
    }
    return {};
}

template <class T> void check_every_kernel()
{
#define CHECK_KERNEL(name, inputs_, outputs_, families, unit)                                                          \
    {                                                                                                                  \
        using call = kernel_call<T, &gnomon::name<T>>;                                                                 \
        static_assert(call::inputs == (inputs_) && call::outputs == (outputs_), "kernels.py has misread " #name);      \
        const std::string mistake = first_mistake<T>({#name, inputs_, outputs_, families, unit},                       \
                                                     []<class Real>(std::size_t blocks, const T* in, T* out) {         \
                                                         kernel_call<Real, &gnomon::name<Real>>::run(blocks, in, out); \
                                                     });                                                               \
        CHECK_MESSAGE(mistake.empty(), mistake);                                                                       \
    }
    GNOMON_FOR_EACH_KERNEL(CHECK_KERNEL)
#undef CHECK_KERNEL
}

} // namespace gnomon::test
