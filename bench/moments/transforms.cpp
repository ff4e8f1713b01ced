// The sparse quantization transform of signed depth against a dense one, for which depth in [0, 1] serves: what a fragment
// of a caster pays, many times a texel where translucent casters overlap (Peters et al. 2017, Sec. 2.4 and 2.6), and what
// a look-up pays. Both give the same channels.
#include "core/measure.hpp"
#include "moments.hpp"

#include <gnomon/moments/affine.h>
#include <gnomon/moments/quantization.h>

#include <array>

namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC {

/// An affine map of four numbers: a column for each, and the image of 0.
struct dense_map {
    std::array<std::array<double, 4>, 4> columns;
    std::array<double, 4> offset;

    template <class Real>
    GNOMON_INLINE constexpr std::array<Real, 4> operator()(Real x1, Real x2, Real x3, Real x4) const
    {
        std::array<Real, 4> result;
        for (std::size_t k = 0; k < 4; ++k)
            result[k] = (literal<Real>(columns[0][k]) * x1 + literal<Real>(columns[1][k]) * x2) +
                        (literal<Real>(columns[2][k]) * x3 + literal<Real>(columns[3][k]) * x4) +
                        literal<Real>(offset[k]);
        return result;
    }
};

/// The map of a function that is affine.
template <class Function> constexpr dense_map map_of(Function f)
{
    dense_map m{{f(1, 0, 0, 0), f(0, 1, 0, 0), f(0, 0, 1, 0), f(0, 0, 0, 1)}, f(0, 0, 0, 0)};
    for (auto& column : m.columns)
        for (std::size_t k = 0; k < 4; ++k) column[k] -= m.offset[k];
    return m;
}

inline constexpr dense_map encoding = map_of([](double b1, double b2, double b3, double b4) {
    const auto c = theta4(moments4_from_unit(moments4<double>{b1, b2, b3, b4}));
    return std::array{c.c1, c.c2, c.c3, c.c4};
});
inline constexpr dense_map decoding = map_of([](double c1, double c2, double c3, double c4) {
    const auto b = moments4_affine(theta4_inverse(channels4<double>{c1, c2, c3, c4}), depth_change<double>{0.5, 0.5});
    return std::array{b.b1, b.b2, b.b3, b.b4};
});

template <class Real> GNOMON_INLINE constexpr Real sum(const std::array<Real, 4>& a)
{
    return (a[0] + a[1]) + (a[2] + a[3]);
}

struct depths : compilation {
    static constexpr std::size_t inputs = 1;

    static std::vector<std::array<double, 1>> samples(std::size_t count, std::uint64_t seed)
    {
        std::vector<std::array<double, 1>> result(count);
        for (std::size_t i = 0; i < count; ++i) result[i][0] = double((i * 2654435761u + seed) % 65536) / 65535;
        return result;
    }
};

struct dense_encode : depths {
    static constexpr auto name = "dense";
    template <class Real> static GNOMON_INLINE constexpr Real run(Real z)
    {
        const Real square = z * z;
        return sum(encoding(z, square, z * square, square * square));
    }
};

struct sparse_encode : depths {
    static constexpr auto name = "sparse";
    template <class Real> static GNOMON_INLINE constexpr Real run(Real z)
    {
        const auto c = theta4(moments4_from_depth(z));
        return sum(std::array{c.c1, c.c2, c.c3, c.c4});
    }
};

struct channels : channels_and_receiver<4>, compilation {};

struct dense_decode : channels {
    static constexpr auto name = "dense";
    template <class Real> static GNOMON_INLINE constexpr Real run(Real c1, Real c2, Real c3, Real c4, Real)
    {
        return sum(decoding(c1, c2, c3, c4));
    }
};

struct sparse_decode : channels {
    static constexpr auto name = "sparse";
    template <class Real> static GNOMON_INLINE constexpr Real run(Real c1, Real c2, Real c3, Real c4, Real)
    {
        const auto b = theta4_inverse(channels4<Real>{c1, c2, c3, c4});
        return sum(std::array{b.b1, b.b2, b.b3, b.b4});
    }
};

[[maybe_unused]] const bool registered = add_kernels<dense_encode, dense_encode, sparse_encode>("depth to channels") &&
                                         add_kernels<dense_decode, dense_decode, sparse_decode>("channels to moments");

} // namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC
