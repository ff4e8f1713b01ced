// Single scattering: the coordinates of the end of a view ray by the polar angle and by its cosine, of which the first is the
// baseline; the weight of a ray that ends within a texel; radiance in a homogeneous medium and in fog; and the bounds of a
// camera, which are made once for each frame.
#include "core/uniform.hpp"

#include <gnomon/scattering/height_fog.h>
#include <gnomon/scattering/rectified_frustum.h>
#include <gnomon/scattering/transmittance_weights.h>

namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC {

struct positions : uniform<3> {
    static auto samples(std::size_t count, std::uint64_t seed) { return uniform::samples(count, seed, -1, 1); }
};

struct shares : uniform<3> {
    static auto samples(std::size_t count, std::uint64_t seed) { return uniform::samples(count, seed, 0, 1); }
};

/// Returns a sum over all results, so that none is optimised away.
struct by_angle : positions {
    static constexpr auto name = "position by angle";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real x, Real y, Real z)
    {
        const auto p = rectified_from_position(x, y, z);
        const rectified_range<Real> range{literal<Real>(1.5), literal<Real>(0.7)};
        return (p.radius + rectified_row_of(p.azimuth, literal<Real>(-2), literal<Real>(4), literal<Real>(1))) +
               rectified_polar_depth(p.polar, range);
    }
};

struct by_cosine : positions {
    static constexpr auto name = "position by cosine";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real x, Real y, Real z)
    {
        const rectified_range<Real> range{literal<Real>(0), literal<Real>(1)};
        const Real azimuth = polynomial_atan2(y, x);
        return (gnomon_sqrt(x * x + y * y) +
                rectified_row_of(azimuth, literal<Real>(-2), literal<Real>(4), literal<Real>(1))) +
               rectified_cosine_depth(rectified_cosine(x, y, z), range);
    }
};

struct within_texel : shares {
    static constexpr auto name = "weight within a texel";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real g, Real q, Real f)
    {
        return transmittance_weight_within(g, q, f);
    }
};

/// Shadow intensity, distance, and the cosine of the polar angle.
struct radiance : shares {
    static constexpr auto name = "radiance";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real intensity, Real distance, Real cosine)
    {
        const Real phase = phase_henyey_greenstein(cosine, literal<Real>(0.7));
        return scattering_radiance(literal<Real>(1), intensity, distance, literal<Real>(0.6), literal<Real>(0.4), phase,
                                   literal<Real>(3));
    }
};

struct fog : shares {
    static constexpr auto name = "radiance in fog";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real intensity, Real distance, Real cosine)
    {
        return radiance::run(intensity, height_fog_amount(literal<Real>(0), distance, literal<Real>(-0.8)), cosine);
    }
};

/// The bounds of a camera whose far plane has corners around the position.
struct frustum : positions {
    static constexpr auto name = "bounds of a camera";
    template <class Real> static GNOMON_INLINE constexpr Real run(Real x, Real y, Real z)
    {
        const Real half = literal<Real>(0.5);
        const auto f = rectified_frustum_from_corners(rectified_corners<Real>{
            {x - half, y - half, z}, {x + half, y - half, z}, {x + half, y + half, z}, {x - half, y + half, z}});
        return ((f.radius + f.azimuth_start) + (f.azimuth_length + f.polar_least)) + f.polar_most;
    }
};

[[maybe_unused]] const bool registered =
    add_kernels<by_angle, by_angle, by_cosine, within_texel, radiance, fog>("scattering") &&
    (add_row<frustum, by_angle, float>("scattering", "scalar float", run_packs<frustum, float>), true);

} // namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC
