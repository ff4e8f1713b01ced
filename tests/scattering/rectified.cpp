// Rectified coordinates: a view ray lies in one row and at one depth, which grows with the depth of a texel of the map.
#include "climbed.hpp"

#include <gnomon/scattering/rectified.h>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr double pi = 3.14159265358979324;
constexpr std::int64_t evaluations = 50'000;

/// A point whose coordinates have magnitudes from 2^-10 to 2^10, with any signs.
template <class T> std::array<T, 3> point(const place& p)
{
    std::array<T, 3> r{};
    for (std::size_t k = 0; k < 3; ++k) r[k] = magnitude<T>(std::abs(2 * p[k] - 1), 10) * T(p[k] < 0.5 ? -1 : 1);
    return r;
}

} // namespace

TEST_CASE_TEMPLATE("coordinates have their stated errors", T, float, double)
{
    const auto radius = [](const auto& q) { return std::hypot(wide(q[0]), wide(q[1])); };
    check_error(2, 3, evaluations, [&](const place& p) {
        const auto q = point<T>(p);
        return relative(rectified_from_position(q[0], q[1], q[2]).radius, radius(q));
    });
    check_error(2.6, 3, evaluations, [&](const place& p) {
        const auto q = point<T>(p);
        return ulps(rectified_from_position(q[0], q[1], q[2]).azimuth, std::atan2(wide(q[1]), wide(q[0])));
    });
    check_error(3.6, 3, evaluations, [&](const place& p) {
        const auto q = point<T>(p);
        return ulps(rectified_from_position(q[0], q[1], q[2]).polar, std::atan2(radius(q), wide(q[2])));
    });
    check_error(3, 3, evaluations, [&](const place& p) {
        const auto q = point<T>(p);
        const wide cosine = wide(q[2]) / std::sqrt(radius(q) * radius(q) + wide(q[2]) * wide(q[2]));
        return double(std::abs(wide(rectified_cosine(q[0], q[1], q[2])) - cosine)) / u<T>;
    });
    check_error(2, 1, evaluations, [&](const place& p) {
        const T footprint = T(std::exp2(16 * p[0]));
        return double(std::abs(wide(rectified_level(footprint)) - std::log2(wide(footprint)))) / (16 * u<T>);
    });
}

TEST_CASE("the axes, the eye and planes through them have their exact coordinates")
{
    const auto on_axis = rectified_from_position(0.0f, 0.0f, 3.0f), into = rectified_from_position(0.0f, 0.0f, -3.0f);
    CHECK((on_axis.radius == 0 && on_axis.azimuth == 0 && on_axis.polar == 0));
    CHECK((into.radius == 0 && into.azimuth == 0 && into.polar == float(pi)));
    const auto eye = rectified_from_position(0.0f, 0.0f, 0.0f);
    CHECK((eye.radius == 0 && eye.azimuth == 0 && eye.polar == 0));
    CHECK((rectified_cosine(0.0f, 0.0f, 0.0f) == 1 && rectified_cosine(0.0f, 0.0f, -2.0f) == -1));
    const auto side = rectified_from_position(3.0f, -4.0f, 0.0f);
    CHECK((side.radius == 5 && side.polar == float(pi / 2) && rectified_cosine(3.0f, -4.0f, 0.0f) == 0));
}

TEST_CASE("all points of a view ray have one azimuth and one depth, by the angle and by its cosine")
{
    bit_source bits(1);
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const double x = bits.uniform(-1, 1), y = bits.uniform(-1, 1), z = bits.uniform(-1, 1),
                     s = bits.uniform(0.01, 100);
        const auto a = rectified_from_position(x, y, z), b = rectified_from_position(s * x, s * y, s * z);
        const auto angles = rectified_polar_range(0.2, 2.9);
        const auto cosines = rectified_cosine_range(-0.9, 0.8);
        REQUIRE(b.radius == doctest::Approx(s * a.radius).epsilon(1e-14));
        REQUIRE(b.azimuth == doctest::Approx(a.azimuth).epsilon(1e-14));
        REQUIRE(rectified_polar_depth(a.polar, angles) ==
                doctest::Approx(rectified_polar_depth(b.polar, angles)).epsilon(1e-13));
        REQUIRE(rectified_cosine_depth(rectified_cosine(x, y, z), cosines) ==
                doctest::Approx(rectified_cosine_depth(rectified_cosine(s * x, s * y, s * z), cosines)).epsilon(1e-13));
    }
}

TEST_CASE_TEMPLATE(
    "depth grows with z on every light ray, and tells a point of a view ray before an occluder from one behind", T,
    float, double)
{
    bit_source bits(2);
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const T x = T(bits.uniform(-1, 1)), y = T(bits.uniform(-1, 1));
        const T z = T(bits.uniform(-3, 3)), beyond = z + T(bits.uniform(1e-4, 3));
        const auto angles = rectified_polar_range(T(0), T(pi));
        const auto cosines = rectified_cosine_range(T(-1), T(1));
        const auto by_angle = [&](T at) {
            return rectified_polar_depth(rectified_from_position(x, y, at).polar, angles);
        };
        const auto by_cosine = [&](T at) { return rectified_cosine_depth(rectified_cosine(x, y, at), cosines); };
        REQUIRE(by_angle(z) <= by_angle(beyond) + T(4 * u<T>));
        REQUIRE(by_cosine(z) <= by_cosine(beyond) + T(8 * u<T>));
        if (!is_float<T>) REQUIRE((by_angle(z) < by_angle(beyond) && by_cosine(z) < by_cosine(beyond)));
    }
}

TEST_CASE_TEMPLATE("ranges put view rays in 1 / 1.1 of [-1, 1], whatever is outside beyond them, and are total", T,
                   float, double)
{
    bit_source bits(3);
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const T a = T(bits.uniform(0, pi)), b = T(bits.uniform(0, pi)), least = std::min(a, b), most = std::max(a, b);
        const auto range = rectified_polar_range(least, most);
        const bool narrow = double(most) - double(least) < 0x1p-10;
        const double end = double(rectified_polar_depth(least, range)),
                     other = double(rectified_polar_depth(most, range));
        REQUIRE(end == doctest::Approx(-other).epsilon(1e-2));
        if (!narrow) REQUIRE(end == doctest::Approx(1 / 1.1).epsilon(is_float<T> ? 1e-3 : 1e-10));
        else REQUIRE((end >= 0 && end <= 0.9091 + 1e-3));
        REQUIRE((rectified_polar_depth(T(0), range) >= T(end) && rectified_polar_depth(T(pi), range) <= T(other)));
        const auto cosines = rectified_cosine_range(std::cos(most), std::cos(least));
        REQUIRE(rectified_cosine_depth(T(-1), cosines) <= rectified_cosine_depth(std::cos(most), cosines));
    }
    for (const T one : {T(0), T(1), T(pi)}) {
        CHECK(rectified_polar_depth(one, rectified_polar_range(one, one)) == 0);
        CHECK(rectified_polar_depth(T(one + 1), rectified_polar_range(one, one)) == -1);
        CHECK(rectified_cosine_depth(one, rectified_cosine_range(one, one)) == 0);
    }
    hostile_source<T> source(4);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto x = source.draw();
        for (const T depth : {rectified_polar_depth(x[0], rectified_polar_range(x[1], x[2])),
                              rectified_cosine_depth(x[0], rectified_cosine_range(x[1], x[2]))})
            REQUIRE((std::isnan(depth) || (-1 <= depth && depth <= 1)));
        const auto p = rectified_from_position(x[0], x[1], x[2]);
        REQUIRE((std::isnan(p.polar) || (0 <= p.polar && p.polar <= T(pi))));
        const T level = rectified_level(x[0]), row = rectified_row_of(x[0], x[1], x[2], std::abs(x[3]));
        REQUIRE((level >= 0 && level <= 16));
        REQUIRE((std::isnan(row) || (0 <= row && row <= std::abs(x[3]))));
        REQUIRE(!(rectified_column_of(x[0], x[1]) < 0));
    }
}

TEST_CASE_TEMPLATE("rows follow the azimuth over any start, wrap at a full turn, and end at the nearer side", T, float,
                   double)
{
    bit_source bits(5);
    const double close = is_float<T> ? 1e-3 : 1e-10;
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const double start = bits.uniform(-pi, pi), span = bits.chance(0.3) ? 2 * pi : bits.uniform(0.1, pi);
        const double share = bits.uniform(0.001, 0.999), azimuth = std::remainder(start + share * span, 2 * pi);
        const double row = double(rectified_row_of(T(azimuth), T(start), T(span), T(64)));
        REQUIRE(std::abs(row - 64 * share) <= close * 64);
        const double before = std::remainder(start - 0.01, 2 * pi),
                     behind = std::remainder(start + span + 0.01, 2 * pi);
        if (span < 6) {
            REQUIRE(rectified_row_of(T(before), T(start), T(span), T(64)) == 0);
            REQUIRE(rectified_row_of(T(behind), T(start), T(span), T(64)) == 64);
        }
    }
    CHECK(rectified_row_of(T(1), T(1), T(0), T(8)) >= 0); // no extent
    CHECK(std::isnan(rectified_row_of(std::numeric_limits<T>::quiet_NaN(), T(1), T(2), T(8))));
}

TEST_CASE("columns, footprints and levels are those of the texel")
{
    CHECK(rectified_column_of(2.0f, 0.5f) == 3.5f); // the average of four whole texels, at the centre of the fourth
    CHECK(rectified_column_of(0.1f, 0.5f) == 0);
    CHECK(rectified_footprint(2.0f, 0.5f, 0.125f, 8.0f) == 4);
    CHECK(rectified_footprint(8.0f, 0.5f, 0.125f, 8.0f) == 8);
    for (int k = 0; k <= 16; ++k) CHECK(rectified_level(std::exp2(float(k))) == doctest::Approx(k).epsilon(1e-6));
    CHECK((rectified_level(0.3f) == 0 && rectified_level(1e9f) == 16 && rectified_level(std::nanf("")) == 0));
}
