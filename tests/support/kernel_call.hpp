// Kernels as functions from numbers to numbers over rows in blocks: the common shape in which tests, benches and
// shaders run every kernel.
//
// A block holds 64 rows, one column for each number, so that packs load lanes and a workgroup of a shader is a block.
// With n numbers in a row, number j of row i is at [(i / 64) (64 n) + 64 j + i % 64].
#pragma once

#include "reals.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <tuple>
#include <type_traits>

namespace gnomon::test {

inline constexpr std::size_t block_rows = 64;

/// True if a and b have equal bits or are both NaN.
template <class T> bool same(T a, T b)
{
    return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}

template <class Real, class T> inline constexpr std::size_t numbers_in = sizeof(T) / sizeof(Real);

/// The next argument, a Real or a struct of Reals, from the next columns, past which `column` is moved.
template <class Real, class T> T take(const lane_t<Real>*& column)
{
    static_assert(sizeof(T) % sizeof(Real) == 0 && std::is_trivially_copyable_v<T>);
    std::array<Real, numbers_in<Real, T>> numbers;
    for (Real& x : numbers) {
        x = load<Real>(column);
        column += block_rows;
    }
    T value;
    std::memcpy(&value, &numbers, sizeof value);
    return value;
}

template <class Real, auto kernel, class = decltype(kernel)> struct kernel_call;

template <class Real, auto kernel, class Result, class... Arguments>
struct kernel_call<Real, kernel, Result (*)(Arguments...)> {
    static constexpr std::size_t inputs = (numbers_in<Real, Arguments> + ...), outputs = numbers_in<Real, Result>;

    static void run(std::size_t blocks, const lane_t<Real>* in, lane_t<Real>* out)
    {
        static_assert(block_rows % lanes<Real>() == 0);
        for (; blocks > 0; --blocks, in += block_rows * inputs, out += block_rows * outputs)
            for (std::size_t i = 0; i < block_rows; i += lanes<Real>()) {
                const lane_t<Real>* column = in + i;
                const std::tuple<Arguments...> arguments{
                    take<Real, Arguments>(column)...}; // braces evaluate left to right
                const Result result = std::apply([](const auto&... a) { return kernel(a...); }, arguments);
                std::array<Real, outputs> numbers;
                std::memcpy(&numbers, &result, sizeof result);
                for (std::size_t j = 0; j < outputs; ++j) store(numbers[j], out + j * block_rows + i);
            }
    }
};

} // namespace gnomon::test
