// The blocker search of four and of six moments from the factored matrix: the closed form, the nodes of the canonical
// distribution, and Algorithm 1 as printed, which solves from moments. The baseline is the sum over nodes. And the
// intensity from a summed-area table, from channels to the shadow.
#include "core/measure.hpp"
#include "moments/moments.hpp"

#include <gnomon/comparators/hamburger_cholesky.h>
#include <gnomon/storage/moments4_summed.h>
#include <gnomon/storage/moments6_summed.h>
#include <gnomon/storage/variance_summed.h>

namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC {

/// The operands of four-moment kernels: the factored matrix of a table for 784 texels, and z_f.
struct matrix4 : compilation {
    static constexpr std::size_t inputs = 5;
    static std::vector<std::array<double, inputs>> samples(std::size_t count, std::uint64_t seed)
    {
        std::vector<std::array<double, inputs>> result(count);
        const auto channels = channels_and_receiver<4>::samples(count, seed);
        for (std::size_t i = 0; i < count; ++i) {
            const auto& s = channels[i];
            const auto h = hankel4_from_summed(channels4<double>{s[0], s[1], s[2], s[3]}, 784);
            result[i] = {h.mean, h.variance, h.third, h.determinant, s[4]};
        }
        return result;
    }
};

/// The weight and the weighted distance of a node before z_f.
template <class Real> struct blocked {
    Real weight = literal<Real>(0), distance = literal<Real>(0);
    GNOMON_INLINE constexpr void add(Real z_f, Real depth, Real node_weight)
    {
        const Real w = gnomon_select(depth < z_f, node_weight, literal<Real>(0));
        weight = weight + w;
        distance = distance + w * (z_f - depth);
    }
    GNOMON_INLINE constexpr Real depth(Real z_f) const
    {
        return blocker_depth_before(z_f, distance / (literal<Real>(blocker_epsilon) + weight));
    }
};

struct nodes4 : matrix4 {
    static constexpr auto name = "nodes";
    static constexpr bool has_error = true;
    template <class Real>
    static GNOMON_INLINE constexpr Real run(Real mean, Real variance, Real third, Real determinant, Real z_f)
    {
        const auto d = hamburger4_distribution(hankel4<Real>{mean, variance, third, determinant}, z_f);
        blocked<Real> b;
        b.add(z_f, d.depth1, d.weight1);
        b.add(z_f, d.depth2, d.weight2);
        return b.depth(z_f);
    }
};

struct closed4 : matrix4 {
    static constexpr auto name = "closed form";
    static constexpr bool has_error = true;
    template <class Real>
    static GNOMON_INLINE constexpr Real run(Real mean, Real variance, Real third, Real determinant, Real z_f)
    {
        return blocker4_depth(hankel4<Real>{mean, variance, third, determinant}, z_f);
    }
};

struct channels : channels_and_receiver<4>, compilation {};

struct table_blocker : channels {
    static constexpr auto name = "closed form, from channels of a table";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real c1, Real c2, Real c3, Real c4, Real z_f)
    {
        return moments4_summed_blocker(channels4<Real>{c1, c2, c3, c4}, literal<Real>(784), z_f);
    }
};

struct printed : channels {
    static constexpr auto name = "Algorithm 1, from channels of a table";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real c1, Real c2, Real c3, Real c4, Real z_f)
    {
        const auto b =
            moments4_add_bias(theta4_inverse(channels4<Real>{c1, c2, c3, c4}), literal<Real>(bias4_theta_paper_b2),
                              literal<Real>(bias4_theta_paper_b4), literal<Real>(6e-7));
        return hamburger4_cholesky_blocker(b, z_f);
    }
};

struct table_intensity : channels {
    static constexpr auto name = "intensity, from channels of a table";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real c1, Real c2, Real c3, Real c4, Real z_f)
    {
        return moments4_summed_intensity(channels4<Real>{c1, c2, c3, c4}, literal<Real>(784), z_f);
    }
};

/// The operands of six-moment kernels: the factored matrix of a table for 784 texels, and z_f.
struct matrix6 : compilation {
    static constexpr std::size_t inputs = 9;
    static std::vector<std::array<double, inputs>> samples(std::size_t count, std::uint64_t seed)
    {
        std::vector<std::array<double, inputs>> result(count);
        const auto channels = channels_and_receiver<6>::samples(count, seed);
        for (std::size_t i = 0; i < count; ++i) {
            const auto& s = channels[i];
            const auto h = hankel6_from_summed(channels6<double>{s[0], s[1], s[2], s[3], s[4], s[5]}, 784);
            result[i] = {h.mean, h.variance, h.shift2, h.shift3, h.ratio, h.whole, h.first, h.second, s[6]};
        }
        return result;
    }
};

struct nodes6 : matrix6 {
    static constexpr auto name = "nodes";
    static constexpr bool has_error = true;
    template <class Real>
    static GNOMON_INLINE constexpr Real run(Real a, Real b, Real c, Real d, Real e, Real f, Real g, Real h, Real z_f)
    {
        const auto n = hamburger6_distribution(hankel6<Real>{a, b, c, d, e, f, g, h}, z_f);
        blocked<Real> sum;
        sum.add(z_f, n.depth1, n.weight1);
        sum.add(z_f, n.depth2, n.weight2);
        sum.add(z_f, n.depth3, n.weight3);
        return sum.depth(z_f);
    }
};

struct lone6 : matrix6 {
    static constexpr auto name = "lone root";
    static constexpr bool has_error = true;
    template <class Real>
    static GNOMON_INLINE constexpr Real run(Real a, Real b, Real c, Real d, Real e, Real f, Real g, Real h, Real z_f)
    {
        return blocker6_depth(hankel6<Real>{a, b, c, d, e, f, g, h}, z_f);
    }
};

[[maybe_unused]] const bool registered =
    add_kernels<nodes4, nodes4, closed4>("blockers, four moments") &&
    add_kernels<printed, printed, table_blocker, table_intensity>("soft shadows") &&
    add_kernels<nodes6, nodes6, lone6>("blockers, six moments");

} // namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC
