// The stated errors of hamburger4.h and hamburger6.h: both bounds against the moment problem solved in 120 digits, over
// all families of distributions, with receivers on, near and between their depths. Storage formats are compared with
// the kernel in double, which the first rows check. honest_six.cpp climbs for the maxima of six moments.
#include "support/distributions.hpp"
#include "support/effort.hpp"
#include "support/moments_of.hpp"
#include "support/oracle.hpp"
#include "support/statistics.hpp"

#include <gnomon/moments/hamburger4.h>
#include <gnomon/moments/hamburger6.h>
#include <gnomon/storage/formats.hpp>
#include <gnomon/storage/moments4.h>
#include <gnomon/storage/moments6.h>

#include <doctest/doctest.h>

#include <optional>
#include <string>

using namespace gnomon;
using namespace gnomon::test;

namespace {

struct bounds {
    double lower, upper;
};

template <class T> high_moments<4> exactly(const moments4<T>& b) { return {1, b.b1, b.b2, b.b3, b.b4}; }
template <class T> high_moments<6> exactly(const moments6<T>& b) { return {1, b.b1, b.b2, b.b3, b.b4, b.b5, b.b6}; }

template <class T> bounds bounds_at(const hankel4<T>& h, T z_f)
{
    const hamburger_bounds<T> r = hamburger4_bounds(h, z_f);
    CHECK(r.lower == hamburger4_lower(h, z_f));
    return {double(r.lower), double(r.upper)};
}
template <class T> bounds bounds_at(const hankel6<T>& h, T z_f)
{
    const hamburger_bounds<T> r = hamburger6_bounds(h, z_f);
    CHECK(r.lower == hamburger6_lower(h, z_f));
    return {double(r.lower), double(r.upper)};
}

/// The bounds in 120 digits for the moments (1 - alpha) b + alpha b*; none if they are indefinite.
template <std::size_t m> auto solved(const std::array<double, m / 2>& bias, double alpha)
{
    return [=](const auto& b, auto z_f) -> std::optional<bounds> {
        const auto r = oracle<m>(biased<m>(exactly(b), bias, alpha), double(z_f));
        if (!r.valid) return {};
        return bounds{double(r.lower), double(r.upper)};
    };
}

/// The bounds by the kernel in double.
template <class Factor> auto bounds_in_double(Factor factor)
{
    return [=](const auto& b, auto z_f) { return std::optional(bounds_at(factor(in_double(b)), double(z_f))); };
}

/// Compares over families with at least fewest_points depths. stored() maps rounded moments to the channels
/// of a format.
template <class T, std::size_t m, class Stored, class Factor, class Reference>
void check(const std::string& name, int fewest_points, Stored stored, Factor factor, Reference reference)
{
    error_sample sample;
    distribution_source source(20170101);
    for (int f = 0; f < family_count; ++f) {
        if (family_points[std::size_t(f)] < fewest_points) continue;
        for (std::int64_t i = 0; i < effort(2000); ++i) {
            const distribution d = source.draw(family(f));
            const auto b = stored(rounded<T>(exact_moments<m>(d)));
            const T z_f = T(source.receiver(d));
            const std::optional<bounds> exact = reference(b, z_f);
            if (!exact) continue;
            const bounds r = bounds_at(factor(b), z_f);
            sample.add(std::max(std::abs(exact->lower - r.lower), std::abs(exact->upper - r.upper)));
        }
    }
    const error_row measured{sample.quantile(0.99), sample.quantile(0.999), sample.quantile(1)};
    const error_row stated = stated_error(m == 4 ? "moments/hamburger4.h" : "moments/hamburger6.h", name);
    std::printf("%zu moments, %s: p99 %.2g, p99.9 %.2g, max %.2g of %zu\n", m, name.c_str(), measured.p99,
                measured.p999, measured.maximum, sample.size());
    CHECK(measured.p99 <= stated.p99);
    CHECK(measured.p999 <= stated.p999);
    CHECK(measured.maximum <= stated.maximum);
}

const auto unchanged = [](const auto& b) { return b; };

template <class T> channels4<T> raw_channels(const moments4<T>& b) { return channels4_from_moments(b); }
template <class T> channels6<T> raw_channels(const moments6<T>& b) { return channels6_from_moments(b); }
const auto raw = [](const auto& b) { return raw_channels(b); };

template <int bits> float snapped(float x) { return unorm_decode<bits>(unorm_encode<bits>(x)); }

/// The channels of a UNORM texel that holds the moments.
template <int bits> channels4<float> texel(const moments4<float>& b)
{
    const channels4<float> c = theta4(b);
    return {snapped<bits>(c.c1), snapped<bits>(c.c2), snapped<bits>(c.c3), snapped<bits>(c.c4)};
}
template <int bits> channels6<float> texel(const moments6<float>& b)
{
    const channels6<float> c = theta6(b);
    return {snapped<bits>(c.c1), snapped<bits>(c.c2), snapped<bits>(c.c3),
            snapped<bits>(c.c4), snapped<bits>(c.c5), snapped<bits>(c.c6)};
}
template <int bits> constexpr auto texels = [](const auto& b) { return texel<bits>(b); };

} // namespace

TEST_CASE("four moments in double have their stated errors against 120 digits")
{
    const auto factor = [](auto b) { return hankel4_constant_bias(b, 0, 0, 0); };
    check<double, 4>("double, no bias, three depths and more", 3, unchanged, factor, solved<4>({}, 0));
}

TEST_CASE("four moments in float have their stated errors against 120 digits")
{
    const auto factor = [](auto b) { return hankel4_constant_bias(b, 0.375f, 0.375f, 3e-7f); };
    check<float, 4>("float, hankel4_constant_bias at 3e-7", 1, unchanged, factor,
                    solved<4>({0.375, 0.375}, double(3e-7f)));
}

TEST_CASE("four moments in float have their stated errors against double, in every format")
{
    const auto row = [](const char* name, auto stored, auto factor) {
        check<float, 4>(name, 1, stored, factor, bounds_in_double(factor));
    };
    const auto half = [](const auto& b) {
        return moments4_half::decode(moments4_half::encode(moments4_half::from_moments(b)));
    };
    row("float, hankel4_from_float", raw, [](auto b) { return hankel4_from_float(b); });
    row("float, hankel4_from_float_filtered", raw, [](auto b) { return hankel4_from_float_filtered(b); });
    row("float, hankel4_from_half", half, [](auto b) { return hankel4_from_half(b); });
    row("float, hankel4_from_half_filtered", half, [](auto b) { return hankel4_from_half_filtered(b); });
    row("float, hankel4_from_unorm16", texels<16>, [](auto c) { return hankel4_from_unorm16(c); });
    row("float, hankel4_from_unorm16_filtered", texels<16>, [](auto c) { return hankel4_from_unorm16_filtered(c); });
}

TEST_CASE("six moments in double have their stated errors against 120 digits")
{
    const auto factor = [](auto b) { return hankel6_constant_bias(b, 0, 0, 0, 0); };
    check<double, 6>("double, no bias, four depths and more", 4, unchanged, factor, solved<6>({}, 0));
}

TEST_CASE("six moments in float have their stated errors against 120 digits")
{
    const float b2 = float(bias6_raw_b2), b4 = float(bias6_raw_b4), b6 = float(bias6_raw_b6);
    const auto factor = [=](auto b) { return hankel6_constant_bias(b, b2, b4, b6, 5e-6f); };
    check<float, 6>("float, hankel6_constant_bias at 5e-6", 1, unchanged, factor,
                    solved<6>({double(b2), double(b4), double(b6)}, double(5e-6f)));
}

TEST_CASE("six moments in float have their stated errors against double, in every format")
{
    const auto from_float = [](auto b) { return hankel6_from_float(b); };
    const auto from_unorm16 = [](auto b) { return hankel6_from_unorm16(b); };
    const auto from_unorm10 = [](auto b) { return hankel6_from_unorm10(b); };
    const auto float_filtered = [](auto b) { return hankel6_from_float_filtered(b); };
    const auto unorm16_filtered = [](auto b) { return hankel6_from_unorm16_filtered(b); };
    const auto unorm10_filtered = [](auto b) { return hankel6_from_unorm10_filtered(b); };
    check<float, 6>("float, hankel6_from_float", 1, raw, from_float, bounds_in_double(from_float));
    check<float, 6>("float, hankel6_from_float_filtered", 1, raw, float_filtered, bounds_in_double(float_filtered));
    check<float, 6>("float, hankel6_from_unorm16", 1, texels<16>, from_unorm16, bounds_in_double(from_unorm16));
    check<float, 6>("float, hankel6_from_unorm16_filtered", 1, texels<16>, unorm16_filtered,
                    bounds_in_double(unorm16_filtered));
    check<float, 6>("float, hankel6_from_unorm10", 1, texels<10>, from_unorm10, bounds_in_double(from_unorm10));
    check<float, 6>("float, hankel6_from_unorm10_filtered", 1, texels<10>, unorm10_filtered,
                    bounds_in_double(unorm10_filtered));
}
