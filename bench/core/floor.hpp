// The floor of a kernel: the time of the machine for the same number of additions, multiplications, fused
// multiply-adds, divisions and square roots, none of which depends on another.
#pragma once

#include "operation_count.hpp"

namespace gnomon::bench {

// The counterpart of GNOMON_INLINE behind the parameters of a lambda.
#define GNOMON_BENCH_INLINE __attribute__((always_inline))

#if defined(__x86_64__)
#define GNOMON_BENCH_REGISTER "x"
#else
#define GNOMON_BENCH_REGISTER "w"
#endif

/// Hides the origin of x from the compiler, without an instruction, so that operations on x are neither
/// merged nor vectorised.
template <class Real> GNOMON_INLINE void forget(Real& x)
{
    if constexpr (requires { x.low; }) forget(x.low), forget(x.high);
    else if constexpr (requires { x.data; }) asm volatile("" : "+" GNOMON_BENCH_REGISTER(x.data));
    else asm volatile("" : "+" GNOMON_BENCH_REGISTER(x));
}

/// Computes operation(a, b) `count` times. Without forget(a) the compiler would compute it once.
template <int count, class Real, class Operation> GNOMON_INLINE void repeat(Real a, Real b, Operation operation)
{
    const auto once = [&](int) GNOMON_BENCH_INLINE {
        forget(a);
        Real result = operation(a, b);
        forget(result);
    };
    const auto times = [&]<int... k>(std::integer_sequence<int, k...>) GNOMON_BENCH_INLINE { (once(k), ...); };
    constexpr int unrolled = 256; // the tens of thousands of a resolve would take minutes to compile
    for (int i = 0; i < count / unrolled; ++i) times(std::make_integer_sequence<int, unrolled>());
    times(std::make_integer_sequence<int, count % unrolled>());
}

/// Executes the operations of Kernel `times` times.
template <class Kernel, class Real> [[gnu::noinline]] void run_floor(std::size_t times)
{
    constexpr operations n = operations_of<Kernel>;
    Real a(lane_t<Real>(1.25)), b(lane_t<Real>(0.75));
    forget(b);
    for (std::size_t i = 0; i < times; ++i) {
        repeat<n.divisions>(a, b, [](Real x, Real y) GNOMON_BENCH_INLINE { return x / y; });
        repeat<n.roots>(a, b, [](Real x, Real) GNOMON_BENCH_INLINE { return gnomon_sqrt(x); });
        repeat<n.additions>(a, b, [](Real x, Real y) GNOMON_BENCH_INLINE { return x + y; });
        repeat<n.multiplications>(a, b, [](Real x, Real y) GNOMON_BENCH_INLINE { return x * y; });
        repeat<n.fused>(a, b, [](Real x, Real y) GNOMON_BENCH_INLINE { return gnomon_fma(x, y, y); });
    }
}

} // namespace gnomon::bench
