// Rectified map, prefix averages and look-up together, against single scattering in closed form: rays through the shadow of a box,
// without any shadow, and all in shadow.
#include "support/effort.hpp"
#include "support/formats.hpp"

#include <gnomon/moments/hamburger4.h>
#include <gnomon/moments/hamburger6.h>
#include <gnomon/moments/translucency.h>
#include <gnomon/passes/rectified_look_up.hpp>
#include <gnomon/passes/rectify.hpp>
#include <gnomon/passes/transmittance_prefix.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr std::size_t columns = 40;

/// Exact distributions of depth at one receiver: 1 for occluders in front of it.
struct shadow_of_receiver : stored_texel<shadow_of_receiver, float_texel<channels1>> {
    static constexpr std::string_view name = "exact", id = "exact";
    static constexpr double darkening = 0, filtered_darkening = 0;
    static inline float receiver = 0;

    template <class Real> static channels<Real> from_depth(Real z) { return {Real(double(z) < double(receiver))}; }
    template <class Real> static Real intensity(const channels<Real>& c, std::type_identity_t<Real>) { return c.c1; }
    template <class Real> static Real filtered_intensity(const channels<Real>& c, std::type_identity_t<Real>)
    {
        return c.c1;
    }
};

/// A box caster over columns [from, to) of the light's map at a height along the light from the eye, and a row towards it.
struct box_scene {
    std::vector<float> depths = std::vector<float>(columns * 3, 1.0f);
    light_map light{0, 1.5f, 0.25f, 1, 1, 0.01f};
    rectified_frame frame{columns, -0.005f, 0.01f, rectified_depth::polar};
    std::vector<rectified_row> rows{1};
    double mean;

    box_scene(std::size_t from, std::size_t to, double height, rectified_depth depth, float extinction, float least,
              float most, const rectified_fog& fog = {})
        : mean((double(least) + double(most)) / 2)
    {
        for (std::size_t k = 0; k < depths.size(); ++k)
            if (k % columns >= from && k % columns < to) depths[k] = float(0.25 + height * 0.01);
        frame.depth = depth;
        rectified_rows(frame, rectified_frustum<float>{columns, -0.005f, 0.01f, least, most}, extinction, columns, rows,
                       fog);
    }
    /// The shadow of a view ray that ends at radius, by exact distributions.
    [[nodiscard]] double shadow(double radius, double polar) const
    {
        using format = shadow_of_receiver;
        const rectified_position<float> end{float(radius), 0, float(polar)};
        format::receiver = rectified_depth_at(frame, rows, end);
        std::vector<format::texel> texels(columns);
        rectify<format>({depths, columns, 3}, light, frame, rows, {texels, columns, 1}, {0, 1});
        transmittance_prefix<format>({texels, columns, 1}, rows, {0, 1});
        return double(
            rectified_channels<format>(map_view<const format::texel>(texels, columns, 1), frame, rows, end).c1);
    }
};

/// The shadow of a ray that is shadowed from one radius to another, in a medium of that extinction.
double shadow_between(double from, double to, double radius, double extinction, double sine)
{
    const auto weight = [&](double r) {
        return extinction > 0 ? -std::expm1(-extinction * r / sine) / extinction : r / sine;
    };
    from = std::min(from, radius);
    to = std::clamp(to, from, radius);
    return (weight(to) - weight(from)) / weight(radius);
}

template <class Format> hamburger_bounds<float> bounds_of(const format_channels<Format>& c, float z_f)
{
    if constexpr (channel_count<Format> == 4) return hamburger4_bounds(Format::filtered_factor(c), z_f);
    else return hamburger6_bounds(Format::filtered_factor(c), z_f);
}

} // namespace

TEST_CASE(
    "with exact distributions the shadow of a box is that in closed form, at the mean angle or without extinction")
{
    const double half_pi = std::acos(0.0);
    bit_source bits(1);
    double elsewhere = 0;
    for (std::int64_t i = 0; i < effort(2'000); ++i) {
        const std::size_t from = 1 + bits.below(20), to = from + 1 + bits.below(15);
        const double height = bits.uniform(-30, 30);
        const rectified_depth measure = bits.chance(0.5) ? rectified_depth::polar : rectified_depth::cosine;
        // A ray that passes the height of the box on the border between two texels.
        const double crossing = double(1 + bits.below(39)), polar = std::atan2(crossing, height);
        const double radius = bits.uniform(0.5, columns);
        const bool is_mean = bits.chance(0.5);
        const double extinction = i % 3 == 0 ? 0 : bits.uniform(0, 0.2);
        const double width = bits.uniform(0.1, 0.9 * std::min(polar, 2 * half_pi - polar));
        const double middle = is_mean ? polar : polar + bits.uniform(-0.4, 0.4) * width;
        const box_scene s(from, to, height, measure, float(extinction), float(middle - width), float(middle + width));
        // Beyond the crossing the ray is behind the box where it goes away from the light, else before the crossing.
        const double first = polar < half_pi ? std::max(crossing, double(from)) : double(from);
        const double last = polar < half_pi ? double(to) : std::min(crossing, double(to));
        const double sine = std::sin(polar);
        const double expected = shadow_between(first, std::max(first, last), radius, extinction, sine);
        const double off = std::abs(s.shadow(radius, polar) - expected);
        if (is_mean || extinction <= 0) REQUIRE(off < 2e-5);
        else elsewhere = std::max(elsewhere, off);
    }
    CHECK(elsewhere > 1e-3); // transmittance is that of the mean angle
}

// The density along a ray that rises is e^(-decay distance), and its light is (1 - e^(-extinction amount)) / extinction.
TEST_CASE("in height fog the shadow of a box is that in closed form along the mean ray, up and down")
{
    bit_source bits(5);
    double homogeneous = 0;
    for (std::int64_t i = 0; i < effort(2'000); ++i) {
        const std::size_t from = 1 + bits.below(20), to = from + 1 + bits.below(15);
        const double polar = bits.uniform(1, 2), radius = bits.uniform(0.5, columns), extinction = bits.uniform(0, 0.1);
        const double around = bits.uniform(0, 6), across = bits.uniform(0, 1), sine = std::sin(polar);
        const rectified_fog fog{float(bits.uniform(0, 0.08)), float(across * std::cos(around)),
                                float(across * std::sin(around)), float(-std::sqrt(1 - across * across))};
        const double decay = double(fog.falloff) * (sine * double(fog.up_x) + std::cos(polar) * double(fog.up_z));
        const auto light = [&](double r) {
            const double s = r / sine, amount = std::abs(decay) > 1e-9 ? -std::expm1(-decay * s) / decay : s;
            return extinction > 0 ? -std::expm1(-extinction * amount) / extinction : amount;
        };
        const double first = std::min(double(from), radius), last = std::min(double(to), radius);
        const double expected = (light(last) - light(first)) / light(radius);
        const auto shadow = [&](const rectified_fog& f) {
            const float a = float(polar - 0.3), b = float(polar + 0.3);
            return box_scene(from, to, -300, rectified_depth::polar, float(extinction), a, b, f).shadow(radius, polar);
        };
        REQUIRE(std::abs(shadow(fog) - expected) < 5e-5);
        homogeneous = std::max(homogeneous, std::abs(shadow({}) - expected));
    }
    CHECK(homogeneous > 0.02);
}

TEST_CASE_TEMPLATE("a ray without shadow gets all light but for (1 - beta) w_f, one in full shadow none by beta = 0",
                   Format, moments4_unorm16, moments4_float, moments6_unorm10, moments6_unorm16, moments6_float)
{
    bit_source bits(2);
    for (std::int64_t i = 0; i < effort(2'000); ++i) {
        const double near = bits.uniform(-1, 0.9);
        const float receiver = float(bits.uniform(-1, 1));
        const bool lit = bits.chance(0.5);
        std::vector<format_texel<Format>> texels(columns);
        for (auto& t : texels) {
            double z = bits.chance(0.3) ? near : bits.uniform(-1, 1);
            z = lit ? std::max(z, double(receiver) + 1e-3) : std::min(z, double(receiver) - 1e-3);
            t = texel_of_depth<Format>(float(z));
        }
        std::vector<rectified_row> rows(1);
        const rectified_frame frame{1, 0, 0.01f, rectified_depth::polar};
        rectified_rows(frame, rectified_frustum<float>{1, 0, 0.01f, 1, 2}, float(bits.uniform(0, 4)), columns, rows);
        transmittance_prefix<Format>({texels, columns, 1}, rows, {0, 1});
        const float radius = float(bits.uniform(0, 1)), beta = float(bits.uniform(0, 1));
        const auto c = rectified_channels<Format>(map_view<const format_texel<Format>>(texels, columns, 1), frame, rows,
                                                  {radius, 0.005f, 1.5f});
        const hamburger_bounds<float> b = bounds_of<Format>(c, receiver);
        const double bias = double(Format::filtered_bias_weight) + 1e-3;
        const double light = double(scattering_radiance(0.0f, bounds_intensity(b, beta), 3.0f, 0.5f, 1.0f, 1.0f, 1.0f));
        const double whole = double(attenuated_length(3.0f, 0.5f));
        if (lit) {
            REQUIRE(light <= whole);
            REQUIRE(light >= whole * (1 - (1 - double(beta)) * double(b.weight) - bias));
            REQUIRE(double(Format::filtered_intensity(c, receiver)) <= Format::filtered_darkening);
        } else {
            REQUIRE(double(bounds_intensity(b, 0.0f)) >= 1 - bias);
        }
    }
}

// Averages of moments in double, without storage and bias.
TEST_CASE("in double a ray without shadow gets exactly the light in closed form, and one in full shadow none")
{
    bit_source bits(3);
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const double receiver = bits.uniform(-0.9, 0.9);
        const bool lit = bits.chance(0.5);
        moments4<double> four{};
        moments6<double> six{};
        double share = 1;
        const double q = bits.uniform(0.5, 1);
        for (std::size_t u = 0; u < columns; ++u) {
            const double z = lit ? bits.uniform(receiver + 0.01, 1) : bits.uniform(-1, receiver - 0.01);
            four = moments4_over(four, z, share);
            six = moments6_over(six, z, share);
            share = transmittance_weight_next(share, q);
        }
        const double beta = adaptive_overestimation(bits.uniform(-1, 1)), whole = attenuated_length(3.0, 0.5);
        for (const hamburger_bounds<double>& b : {hamburger4_bounds(hankel4_from_moments(four), receiver),
                                                  hamburger6_bounds(hankel6_from_moments(six), receiver)}) {
            const auto light = [&](double weight) {
                return scattering_radiance(0.0, bounds_intensity(b, weight), 3.0, 0.5, 1.0, 1.0, 1.0);
            };
            if (lit) {
                REQUIRE(std::abs(light(1) - whole) < 1e-9);
                REQUIRE(std::abs(light(beta) - whole * (1 - (1 - beta) * b.weight)) < 1e-9);
            } else {
                REQUIRE(light(0) < 1e-9);
                REQUIRE(light(beta) <= whole * beta * b.weight + 1e-9);
            }
        }
    }
}
