// Lists of ranges: insertion of a range, the front at a time, the resolve, and transmittance.
#include "core/measure.hpp"
#include "support/hostile.hpp"

#include <gnomon/motion/range/range_list.h>
#include <gnomon/motion/range/range_transmittance.h>

namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC {

/// Eight ranges of a texel and a ninth. The baseline uses no list: the front of all nine at 16 times, as from
/// 16 shadow maps.
struct nine_ranges : compilation {
    static constexpr std::size_t inputs = 45;
    static std::vector<std::array<double, inputs>> samples(std::size_t count, std::uint64_t seed)
    {
        test::bit_source bits(seed);
        std::vector<std::array<double, inputs>> result(count);
        for (auto& sample : result)
            for (std::size_t k = 0; k < inputs; k += 5) {
                const double t = bits.uniform(0, 1), z = bits.uniform(-1, 1);
                const double numbers[] = {t, std::min(t + bits.uniform(0, 0.5), 1.0), z,
                                          std::clamp(z + bits.uniform(-0.3, 0.3), -1.0, 1.0), double(bits.below(8))};
                std::copy(std::begin(numbers), std::end(numbers), sample.begin() + std::ptrdiff_t(k));
            }
        return result;
    }

    template <class Real>
    static GNOMON_INLINE constexpr depth_time_range<Real> range(const std::array<Real, inputs>& x, std::size_t k)
    {
        return {x[5 * k], x[5 * k + 1], x[5 * k + 2], x[5 * k + 3], x[5 * k + 4]};
    }

    /// The list of the first eight as they are, without insertion.
    template <class Real> static GNOMON_INLINE constexpr range_list<Real> list(const std::array<Real, inputs>& x)
    {
        range_list<Real> all;
        for (std::size_t k = 0; k < 8; ++k) all.ranges[k] = range(x, k);
        all.time_added = all.depth_added = Real(0);
        return all;
    }
};

struct sixteen_times : nine_ranges {
    static constexpr auto name = "front at 16 times";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        real sum = real(0);
        for (int i = 0; i < 16; ++i) {
            const real t = real(static_cast<lane_t<real>>((i + 0.5) / 16));
            real front = real(1);
            for (std::size_t k = 0; k < 9; ++k) {
                const depth_time_range<real> r = range(x, k);
                front = gnomon_select(r.t0 <= t && t < r.t1, gnomon_min(front, range_depth(r, t)), front);
            }
            sum = sum + front;
        }
        return sum;
    }
};

/// If the eight do not occlude one another, there is no room for the ninth.
struct list_insert : nine_ranges {
    static constexpr auto name = "insert into a list of 8";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        const range_list<real> all = range_list_insert(list(x), range(x, 8));
        return all.ranges[0].z0 + all.ranges[7].z0 + all.depth_added;
    }
};

struct list_front : nine_ranges {
    static constexpr auto name = "front of a list of 8";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        const depth_time_range<real> span = range_list_front(list(x), real(0.5));
        return span.t1 + span.z0 + span.z1;
    }
};

struct list_resolve : nine_ranges {
    static constexpr auto name = "resolve of a list of 8";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        const range_list<real> all = range_list_resolve(list(x));
        return all.ranges[0].z0 + all.ranges[7].z0 + all.depth_added;
    }
};

/// One step of the transmittance of nine ranges, with ids for opacities.
struct transmittance_step : nine_ranges {
    static constexpr auto name = "step of transmittance";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        range_transmittance<real> step = range_transmittance_begin(real(0.5), real(1));
        for (std::size_t k = 0; k < 9; ++k)
            step = range_transmittance_add(step, range(x, k), real(9), real(0.125) * range(x, k).id);
        return range_transmittance_lost(step, step.t0, step.t1);
    }
};

[[maybe_unused]] const bool registered =
    add_kernels<sixteen_times, sixteen_times, list_insert, list_front, list_resolve, transmittance_step>("lists");

} // namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC
