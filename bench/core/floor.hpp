// The machine's limit for a kernel: the same count of additions, multiplications, fused multiply-adds, divisions and
// square roots, none of which waits for another.
#ifndef GNOMON_BENCH_FLOOR_HPP
#define GNOMON_BENCH_FLOOR_HPP

#include "operation_count.hpp"

namespace gnomon::bench {

// After a lambda's parameters: as GNOMON_INLINE is for functions.
#define GNOMON_BENCH_INLINE __attribute__((always_inline))

#if defined(__x86_64__)
#define GNOMON_BENCH_REGISTER "x"
#else
#define GNOMON_BENCH_REGISTER "w"
#endif

/// Makes the compiler forget where x comes from, without an instruction: what follows is neither merged nor vectorised.
template <class Real> GNOMON_INLINE void forget(Real& x)
{
    if constexpr (requires { x.low; }) forget(x.low), forget(x.high);
    else if constexpr (requires { x.data; }) asm volatile("" : "+" GNOMON_BENCH_REGISTER(x.data));
    else asm volatile("" : "+" GNOMON_BENCH_REGISTER(x));
}

/// Computes operation(a, b) so many times: a is forgotten each time, else one would do.
template <int count, class Real, class Operation> GNOMON_INLINE void repeat(Real a, Real b, Operation operation)
{
    const auto once = [&](int) GNOMON_BENCH_INLINE {
        forget(a);
        Real result = operation(a, b);
        forget(result);
    };
    const auto times = [&]<int... k>(std::integer_sequence<int, k...>) GNOMON_BENCH_INLINE { (once(k), ...); };
    constexpr int unrolled = 256; // the resolve of a list has tens of thousands, which would take minutes to compile
    for (int i = 0; i < count / unrolled; ++i) times(std::make_integer_sequence<int, unrolled>());
    times(std::make_integer_sequence<int, count % unrolled>());
}

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
#endif
