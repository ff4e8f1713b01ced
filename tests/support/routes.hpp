// The routes through the moment kernels as functions from numbers to numbers, so that one text can test all of them.
#pragma once

#include <gnomon/moments/bounds.h>
#include <gnomon/moments/hamburger4.h>
#include <gnomon/moments/hamburger6.h>
#include <gnomon/moments/two_point.h>
#include <gnomon/storage/moments4.h>
#include <gnomon/storage/moments6.h>

#include <array>
#include <cstddef>

namespace gnomon::test {

inline constexpr std::size_t route_inputs = 7; ///< up to six moments or channels, then the receiver's depth

/// The results of a route: intensities, then the depths of a distribution, then its weights.
template <std::size_t intensities_, std::size_t depths_> struct route_shape {
    static constexpr std::size_t intensities = intensities_, depths = depths_;
    template <class Real> using results = std::array<Real, intensities + 2 * depths>;
};

template <class Real> route_shape<5, 3>::results<Real> evaluate(hankel4<Real> h, Real z_f)
{
    const hamburger_bounds<Real> b = hamburger4_bounds(h, z_f);
    const distribution3<Real> d = hamburger4_distribution(h, z_f);
    return {hamburger4_lower(h, z_f),
            b.lower,
            b.weight,
            b.upper,
            bounds_intensity(b, Real(lane_t<Real>(0.5))),
            d.depth0,
            d.depth1,
            d.depth2,
            d.weight0,
            d.weight1,
            d.weight2};
}

template <class Real> route_shape<5, 4>::results<Real> evaluate(hankel6<Real> h, Real z_f)
{
    const hamburger_bounds<Real> b = hamburger6_bounds(h, z_f);
    const distribution4<Real> d = hamburger6_distribution(h, z_f);
    return {hamburger6_lower(h, z_f),
            b.lower,
            b.weight,
            b.upper,
            bounds_intensity(b, Real(lane_t<Real>(0.5))),
            d.depth0,
            d.depth1,
            d.depth2,
            d.depth3,
            d.weight0,
            d.weight1,
            d.weight2,
            d.weight3};
}

template <class Real> using route_numbers = std::array<Real, route_inputs>;

template <class Factor> struct route4 : route_shape<5, 3> {
    static constexpr std::size_t moments = 4;
    const char* name;
    Factor factor;
    template <class Real> results<Real> operator()(const route_numbers<Real>& x) const
    {
        return evaluate(factor(moments4<Real>{x[0], x[1], x[2], x[3]}), x[6]);
    }
};

template <class Factor> struct route6 : route_shape<5, 4> {
    static constexpr std::size_t moments = 6;
    const char* name;
    Factor factor;
    template <class Real> results<Real> operator()(const route_numbers<Real>& x) const
    {
        return evaluate(factor(moments6<Real>{x[0], x[1], x[2], x[3], x[4], x[5]}), x[6]);
    }
};

/// A route from channels and a receiver to one intensity.
template <class Intensity> struct intensity_route4 : route_shape<1, 0> {
    static constexpr std::size_t moments = 4;
    const char* name;
    Intensity intensity;
    template <class Real> results<Real> operator()(const route_numbers<Real>& x) const
    {
        return {intensity(channels4<Real>{x[0], x[1], x[2], x[3]}, x[6])};
    }
};

struct two_point_route : route_shape<0, 2> {
    static constexpr std::size_t moments = 3;
    const char* name = "two_point_distribution";
    template <class Real> results<Real> operator()(const route_numbers<Real>& x) const
    {
        const distribution2<Real> d = two_point_distribution(x[0], x[1], x[2], literal<Real>(two_point_least_variance));
        return {d.depth1, d.depth2, d.weight1, d.weight2};
    }
};

/// The number x as a setting, for any Real.
#define GNOMON_TEST_SETTING(x) gnomon::literal<decltype(b.b1)>(x)

/// Calls f(route) for every route from moments, or channels, to results.
template <class F> void for_each_route(F f)
{
    const auto four = [&](const char* name, auto factor) { f(route4<decltype(factor)>{{}, name, factor}); };
    const auto six = [&](const char* name, auto factor) { f(route6<decltype(factor)>{{}, name, factor}); };
    four("hankel4_from_moments", [](auto b) { return hankel4_from_moments(b); });
    four("hankel4_constant_bias", [](auto b) {
        return hankel4_constant_bias(b, GNOMON_TEST_SETTING(bias4_raw_paper_b2),
                                     GNOMON_TEST_SETTING(bias4_raw_paper_b4), GNOMON_TEST_SETTING(3e-7));
    });
    four("hankel4_from_unorm16", [](auto b) { return hankel4_from_unorm16(channels4_from_moments(b)); });
    four("hankel4_from_half", [](auto b) { return hankel4_from_half(channels4_from_moments(b)); });
    four("hankel4_from_float", [](auto b) { return hankel4_from_float(channels4_from_moments(b)); });
    const auto stored = [&](const char* name, auto intensity) {
        f(intensity_route4<decltype(intensity)>{{}, name, intensity});
    };
    stored("moments4_unorm16_intensity", [](auto b, auto z_f) { return moments4_unorm16_intensity(b, z_f); });
    stored("moments4_half_intensity", [](auto b, auto z_f) { return moments4_half_intensity(b, z_f); });
    stored("moments4_half_filtered_intensity",
           [](auto b, auto z_f) { return moments4_half_filtered_intensity(b, z_f); });
    stored("moments4_float_intensity", [](auto b, auto z_f) { return moments4_float_intensity(b, z_f); });
    six("hankel6_from_moments", [](auto b) { return hankel6_from_moments(b); });
    six("hankel6_constant_bias", [](auto b) {
        return hankel6_constant_bias(b, GNOMON_TEST_SETTING(bias6_raw_b2), GNOMON_TEST_SETTING(bias6_raw_b4),
                                     GNOMON_TEST_SETTING(bias6_raw_b6), GNOMON_TEST_SETTING(5e-6));
    });
    six("hankel6_from_unorm10", [](auto b) { return hankel6_from_unorm10(channels6_from_moments(b)); });
    six("hankel6_from_unorm10_filtered",
        [](auto b) { return hankel6_from_unorm10_filtered(channels6_from_moments(b)); });
    six("hankel6_from_unorm16", [](auto b) { return hankel6_from_unorm16(channels6_from_moments(b)); });
    six("hankel6_from_unorm16_filtered",
        [](auto b) { return hankel6_from_unorm16_filtered(channels6_from_moments(b)); });
    six("hankel6_from_float", [](auto b) { return hankel6_from_float(channels6_from_moments(b)); });
    six("hankel6_from_float_filtered", [](auto b) { return hankel6_from_float_filtered(channels6_from_moments(b)); });
    f(two_point_route{});
}

#undef GNOMON_TEST_SETTING

} // namespace gnomon::test
