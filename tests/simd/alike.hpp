// Results of two targets that count as equal.
#pragma once

#include "support/kernel_call.hpp"

#include <cmath>
#include <limits>

namespace gnomon::test {

// NEON of 32 bits takes denormal numbers for zero, and so do packs on it. Scalars do as well while a flushed_denormals
// lives.
#if defined(__ARM_NEON) && !defined(__aarch64__)
inline constexpr bool packs_flush = true;

class flushed_denormals {
  public:
    flushed_denormals() { set(get() | bit); }
    ~flushed_denormals() { set(get() & ~bit); }
    flushed_denormals(const flushed_denormals&) = delete;
    flushed_denormals& operator=(const flushed_denormals&) = delete;

  private:
    static constexpr unsigned bit = 1u << 24; // FZ
    static unsigned get()
    {
        unsigned word = 0;
        asm volatile("vmrs %0, fpscr" : "=r"(word) : : "memory");
        return word;
    }
    static void set(unsigned word) { asm volatile("vmsr fpscr, %0" : : "r"(word) : "memory"); }
};
#else
inline constexpr bool packs_flush = false;

class flushed_denormals {
  public:
    flushed_denormals() {} // not trivial, so that nobody warns of a variable without use
};
#endif

// Of x < 0 ? 0 : x, clang makes an instruction here that returns +0 for -0.
#if defined(__clang__) && (defined(__wasm__) || defined(__aarch64__))
inline constexpr bool zeros_lose_signs = true;
#else
inline constexpr bool zeros_lose_signs = false;
#endif

/// True for equal bits and for two NaNs; where packs flush denormals, also for a denormal or zero each, since a number
/// that is only moved is not flushed; where zeros lose their signs, also for two zeros.
template <class T> bool alike(T a, T b)
{
    const auto small = [](T x) { return std::abs(x) < std::numeric_limits<T>::min(); };
    return same(a, b) || (packs_flush && small(a) && small(b)) || (zeros_lose_signs && a == 0 && b == 0);
}

} // namespace gnomon::test
