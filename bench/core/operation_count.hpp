// The number of operations of each kind in a kernel, counted at compile time by running the kernel on a
// Real that counts.
#pragma once

#include <gnomon/portable.h>

#include <cstddef>
#include <type_traits>
#include <utility>

#if !defined(GNOMON_BENCH_FUSED)
#define GNOMON_BENCH_FUSED is_fused<float>
#endif

namespace gnomon::bench {

/// Numbers of operations. The floor executes the first five kinds; the others move and compare.
struct operations {
    int additions = 0, multiplications = 0, fused = 0, divisions = 0, roots = 0;
    int comparisons = 0, selections = 0, extrema = 0, signs = 0;
};

/// A Real without a value. Operations on two constants are not counted, since a compiler evaluates them.
struct counting_real {
    using value_type = float;
    operations* total = nullptr;

    counting_real() = default;
    template <class Number>
    requires std::is_arithmetic_v<Number>
    constexpr explicit counting_real(Number) {}
    constexpr explicit counting_real(operations* counted) : total(counted) {}

    struct mask {
        operations* total;
        friend constexpr mask operator&&(mask a, mask b) { return {a.total ? a.total : b.total}; }
        friend constexpr mask operator||(mask a, mask b) { return a && b; }
        friend constexpr mask operator!(mask a) { return a; }
        friend constexpr bool any(mask) { return true; } // so that nothing is skipped
        friend constexpr counting_real select(mask m, counting_real a, counting_real b)
        {
            return count(&operations::selections, counting_real(m.total), a, b);
        }
    };

    template <class... Operands> static constexpr counting_real count(int operations::*kind, Operands... operands)
    {
        counting_real result;
        ((result.total = result.total ? result.total : operands.total), ...);
        if (result.total) ++(result.total->*kind);
        return result;
    }

    friend constexpr counting_real operator+(counting_real a, counting_real b)
    {
        return count(&operations::additions, a, b);
    }
    friend constexpr counting_real operator-(counting_real a, counting_real b)
    {
        return count(&operations::additions, a, b);
    }
    friend constexpr counting_real operator*(counting_real a, counting_real b)
    {
        return count(&operations::multiplications, a, b);
    }
    friend constexpr counting_real operator/(counting_real a, counting_real b)
    {
        return count(&operations::divisions, a, b);
    }
    friend constexpr counting_real operator-(counting_real a) { return count(&operations::signs, a); }
    friend constexpr counting_real abs(counting_real a) { return count(&operations::signs, a); }
    friend constexpr counting_real sqrt(counting_real a) { return count(&operations::roots, a); }
    friend constexpr mask operator<(counting_real a, counting_real b)
    {
        return {count(&operations::comparisons, a, b).total};
    }
    friend constexpr mask operator>(counting_real a, counting_real b) { return a < b; }
    friend constexpr mask operator<=(counting_real a, counting_real b) { return a < b; }
    friend constexpr mask operator>=(counting_real a, counting_real b) { return a < b; }
    friend constexpr mask operator==(counting_real a, counting_real b) { return a < b; }
    friend constexpr mask operator!=(counting_real a, counting_real b) { return a < b; }
};

template <class Kernel> constexpr operations count_operations()
{
    operations total;
    [&]<std::size_t... k>(std::index_sequence<k...>) { Kernel::run((static_cast<void>(k), counting_real(&total))...); }
    (std::make_index_sequence<Kernel::inputs>());
    return total;
}

/// The operations of Kernel::run for Kernel::inputs operands.
template <class Kernel> inline constexpr operations operations_of = count_operations<Kernel>();

} // namespace gnomon::bench

namespace gnomon {

template <> struct pack_operations<bench::counting_real> {
    using real = bench::counting_real;
    static constexpr bool fused = GNOMON_BENCH_FUSED;
    static constexpr real min(real a, real b) { return real::count(&bench::operations::extrema, a, b); }
    static constexpr real max(real a, real b) { return real::count(&bench::operations::extrema, a, b); }
    static constexpr real power_of_two(real n) { return real::count(&bench::operations::signs, n); }
    static constexpr real fma(real a, real b, real c) { return real::count(&bench::operations::fused, a, b, c); }
};

} // namespace gnomon
