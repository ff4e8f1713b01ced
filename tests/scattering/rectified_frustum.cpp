// Bounds of rectified coordinates: they contain every view ray, and some ray touches each of them.
#include "climbed.hpp"
#include "support/far_planes.hpp"

#include <algorithm>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr double pi = 3.14159265358979324;

/// A point of the far plane, from the corners as they are stored.
template <class T> std::array<wide, 3> far_point(const rectified_corners<T>& q, wide s, wide t)
{
    const auto mixed = [&](T rectified_corner<T>::*at) {
        return (1 - t) * ((1 - s) * wide(q.a.*at) + s * wide(q.b.*at)) +
               t * ((1 - s) * wide(q.d.*at) + s * wide(q.c.*at));
    };
    return {mixed(&rectified_corner<T>::x), mixed(&rectified_corner<T>::y), mixed(&rectified_corner<T>::z)};
}

wide polar_of(const std::array<wide, 3>& p) { return std::atan2(std::hypot(p[0], p[1]), p[2]); }
wide azimuth_of(const std::array<wide, 3>& p) { return std::atan2(p[1], p[0]); }

/// The angle by which an azimuth is outside of length from start on.
wide outside(wide azimuth, wide start, wide length)
{
    const wide from_middle = std::remainder(azimuth - start - length / 2, 2 * wide(pi));
    return std::max(wide(0), std::abs(from_middle) - length / 2);
}

/// What a point exceeds the bounds by: in radius and sideways relative to the radius, in polar as an angle.
struct excess {
    wide radius = 0, azimuth = 0, polar = 0;
    template <class T> excess(const rectified_frustum<T>& f, const std::array<wide, 3>& p)
    {
        const wide r = std::hypot(p[0], p[1]), all = wide(f.radius);
        if (all > 0) radius = (r - all) / all;
        if (all > 0) azimuth = outside(azimuth_of(p), wide(f.azimuth_start), wide(f.azimuth_length)) * r / all;
        polar = std::max(wide(f.polar_least) - polar_of(p), polar_of(p) - wide(f.polar_most));
    }
};

/// A camera for a place in the unit cube, often nearly with an edge or a corner on the axis.
template <class T> rectified_corners<T> climbed_far_plane(const place& p)
{
    const auto axes = camera_axes(2 * p[0] - 1, pi * (2 * p[1] - 1), pi * (2 * p[2] - 1));
    const double along = std::tan(0.02 + 1.1 * p[3]);
    return far_plane<T>(axes, along * (0.5 + 1.9 * p[4]), along, 1 + p[5]);
}

/// Least and greatest polar angle of points on the border of the far plane.
struct sampled_polar {
    wide least = 4, most = -1;
    void add(const std::array<wide, 3>& p) { least = std::min(least, polar_of(p)), most = std::max(most, polar_of(p)); }
};

/// The border at a fraction of one of its four edges.
template <class T> std::array<wide, 3> border_point(const rectified_corners<T>& q, int edge, wide t)
{
    return edge == 0   ? far_point(q, t, 0)
           : edge == 1 ? far_point(q, 1, t)
           : edge == 2 ? far_point(q, 1 - t, 1)
                       : far_point(q, 0, 1 - t);
}

/// The whole border: 100 points of each edge, and 60 between the neighbours of its extreme ones, by thirds.
template <class T> sampled_polar searched_border(const rectified_corners<T>& q)
{
    sampled_polar r;
    for (int edge = 0; edge < 4; ++edge)
        for (const wide sign : {wide(1), wide(-1)}) {
            const auto at = [&](wide t) {
                const auto p = border_point(q, edge, t);
                r.add(p);
                return sign * polar_of(p);
            };
            int best = 0;
            for (int i = 1; i <= 100; ++i)
                if (at(wide(i) / 100) > at(wide(best) / 100)) best = i;
            wide from = wide(std::max(best - 1, 0)) / 100, to = wide(std::min(best + 1, 100)) / 100;
            for (int i = 0; i < 30; ++i) {
                const wide third = (to - from) / 3;
                if (at(from + third) < at(to - third)) from += third;
                else to -= third;
            }
        }
    return r;
}

/// The points of the border at azimuths from first to last.
template <class T> sampled_polar sampled_row(const rectified_corners<T>& q, wide first, wide last)
{
    sampled_polar r;
    for (int i = 0; i <= 100; ++i) {
        const wide azimuth = first + (last - first) * i / 100, c = std::cos(azimuth), s = std::sin(azimuth);
        for (int edge = 0; edge < 4; ++edge) {
            const auto a = border_point(q, edge, 0), b = border_point(q, edge, 1);
            const wide at_a = c * a[1] - s * a[0], at_b = c * b[1] - s * b[0];
            if ((at_a < 0) == (at_b < 0)) continue;
            const auto p = border_point(q, edge, at_a / (at_a - at_b));
            if (c * p[0] + s * p[1] > 0) r.add(p);
        }
    }
    return r;
}

/// 1 or -1 if the light direction or its opposite is within the far plane, 0 if neither is, and 2 where it is close.
template <class T> int axis_within(const rectified_corners<T>& q)
{
    const rectified_corner<T> corners[] = {q.a, q.b, q.c, q.d};
    int left = 0, right = 0;
    for (int i = 0; i < 4; ++i) {
        const auto &a = corners[i], &b = corners[(i + 1) % 4];
        const wide turn = wide(a.x) * wide(b.y) - wide(a.y) * wide(b.x);
        const wide scale = std::hypot(wide(a.x), wide(a.y)) * std::hypot(wide(b.x), wide(b.y));
        if (std::abs(turn) <= 8 * wide(u<T>) * scale) return 2;
        (turn > 0 ? left : right)++;
    }
    if (left < 4 && right < 4) return 0;
    // The axis meets the plane a + s (b - a) + t (d - a) at this z.
    const auto a = far_point(q, 0, 0), b = far_point(q, 1, 0), d = far_point(q, 0, 1);
    const auto turn = [&](std::size_t i, std::size_t j) {
        return (b[i] - a[i]) * (d[j] - a[j]) - (b[j] - a[j]) * (d[i] - a[i]);
    };
    const wide z = (turn(1, 2) * a[0] + turn(2, 0) * a[1] + turn(0, 1) * a[2]) / turn(0, 1);
    return z > 0 ? 1 : -1;
}

} // namespace

TEST_CASE_TEMPLATE("bounds of random cameras contain their view rays", T, float, double)
{
    bit_source bits(1);
    int inside = 0, into = 0;
    double worst[3] = {};
    for (std::int64_t camera = 0; camera < effort(10'000); ++camera) {
        const auto q = any_far_plane<T>(bits);
        const auto f = rectified_frustum_from_corners(q);
        inside += f.azimuth_length > T(6), into += f.polar_most == T(pi);
        for (int ray = camera % 100 == 0 ? 10'000 : 100; ray > 0; --ray) {
            const wide s = bits.chance(0.1) ? wide(bits.below(2)) : wide(bits.uniform(0, 1));
            const wide t = bits.chance(0.1) ? wide(bits.below(2)) : wide(bits.uniform(0, 1));
            const excess e(f, far_point(q, s, t));
            worst[0] = std::max(worst[0], double(e.radius)), worst[1] = std::max(worst[1], double(e.azimuth));
            worst[2] = std::max(worst[2], double(e.polar));
        }
    }
    CHECK_MESSAGE(worst[0] <= 4 * u<T>, (worst[0] / u<T>));
    CHECK_MESSAGE(worst[1] <= 16 * u<T>, (worst[1] / u<T>));
    CHECK_MESSAGE(worst[2] <= 8 * u<T>, (worst[2] / u<T>));
    if (!draws_few()) CHECK((inside > 1000 && into > 500)); // cameras with and without the axis in view
}

TEST_CASE_TEMPLATE("no ray that a search finds exceeds the bounds by more than the stated errors", T, float, double)
{
    const auto climbed = [](double limit, auto measure) {
        const summit found = climb(8, 100'000, 1, [&](const place& p) {
            const auto q = climbed_far_plane<T>(p);
            return double(measure(excess(rectified_frustum_from_corners(q), far_point(q, wide(p[6]), wide(p[7]))))) /
                   u<T>;
        });
        CHECK_MESSAGE(found.score <= limit, found.score);
    };
    climbed(4, [](const excess& e) { return e.radius; });
    climbed(16, [](const excess& e) { return e.azimuth; });
    climbed(8, [](const excess& e) { return e.polar; });
}

TEST_CASE_TEMPLATE("bounds are touched: by corners, by points of the far plane's border, and by the axis", T, float,
                   double)
{
    bit_source bits(2);
    for (std::int64_t camera = 0; camera < effort(1'000); ++camera) {
        const auto q = any_far_plane<T>(bits);
        const auto f = rectified_frustum_from_corners(q);
        const int axis = axis_within(q);
        const std::array<std::array<wide, 3>, 4> corners{far_point(q, 0, 0), far_point(q, 1, 0), far_point(q, 1, 1),
                                                         far_point(q, 0, 1)};
        wide radius = 0, first = 9, last = 9;
        for (const auto& p : corners) {
            const wide r = std::hypot(p[0], p[1]), start = wide(f.azimuth_start);
            radius = std::max(radius, r);
            if (r == 0) continue; // no azimuth
            first = std::min(first, std::abs(std::remainder(azimuth_of(p) - start, 2 * wide(pi))));
            last =
                std::min(last, std::abs(std::remainder(azimuth_of(p) - start - wide(f.azimuth_length), 2 * wide(pi))));
        }
        REQUIRE(relative(f.radius, radius) <= 4);
        REQUIRE((-T(pi) <= f.azimuth_start && f.azimuth_start <= T(pi) && f.azimuth_length >= 0));
        if (axis == 1 || axis == -1) {
            REQUIRE(f.azimuth_length == T(2 * pi));
            REQUIRE((axis > 0 ? f.polar_least == 0 : f.polar_most == T(pi)));
        } else if (axis == 0) {
            REQUIRE(f.azimuth_length <= T(pi));
            REQUIRE(std::max(first, last) <= wide(16 * u<T>));
        }
        if (axis == 2) continue;
        const sampled_polar border = searched_border(q);
        REQUIRE(double(f.polar_least) == doctest::Approx(axis == 1 ? 0 : double(border.least)).epsilon(1e-6));
        REQUIRE(double(f.polar_most) == doctest::Approx(axis == -1 ? pi : double(border.most)).epsilon(1e-6));
    }
}

TEST_CASE_TEMPLATE("the angles of a row contain its rays and are touched, and those of all rows make the frustum's", T,
                   float, double)
{
    bit_source bits(3);
    double worst = 0;
    for (std::int64_t camera = 0; camera < effort(400); ++camera) {
        const auto q = any_far_plane<T>(bits);
        const auto f = rectified_frustum_from_corners(q);
        const int axis = axis_within(q);
        if (axis == 2 || f.azimuth_length < T(0.01)) continue;
        const int rows = 1 + int(bits.below(40));
        T least = T(pi), most = 0;
        for (int row = 0; row < rows; ++row) {
            const T first = f.azimuth_start + f.azimuth_length * T(row) / T(rows);
            const T last = f.azimuth_start + f.azimuth_length * T(row + 1) / T(rows);
            const auto polar = rectified_row_polar(q, first, last);
            least = std::min(least, polar.least), most = std::max(most, polar.most);
            if (last - first > T(3) || row % 4 > 0) continue;
            const sampled_polar border = sampled_row(q, wide(first), wide(last));
            worst = std::max(worst, double(wide(polar.least) - border.least));
            worst = std::max(worst, double(border.most - wide(polar.most)));
            REQUIRE((axis == 1 ? 0 : double(border.least)) - double(polar.least) <= 0.01);
            REQUIRE(double(polar.most) - (axis == -1 ? pi : double(border.most)) <= 0.01);
        }
        REQUIRE(std::abs(least - f.polar_least) <= T(32 * u<T>));
        REQUIRE(std::abs(most - f.polar_most) <= T(32 * u<T>));
    }
    CHECK_MESSAGE(worst <= 16 * u<T>, (worst / u<T>));
    const summit found = climb(10, 100'000, 2, [&](const place& p) {
        const auto q = climbed_far_plane<T>(p);
        const T first = T(2 * pi * (p[6] - 0.5)), last = first + T(p[7]);
        const auto ray = far_point(q, wide(p[8]), wide(p[9]));
        if (outside(azimuth_of(ray), wide(first), wide(last) - wide(first)) > 0) return -1.0;
        const auto polar = rectified_row_polar(q, first, last);
        return double(std::max(wide(polar.least) - polar_of(ray), polar_of(ray) - wide(polar.most))) / u<T>;
    });
    CHECK_MESSAGE(found.score <= 16, found.score);
}

TEST_CASE_TEMPLATE("frusta are total: a far plane at the eye, corners on the axis, all on it, and any bits", T, float,
                   double)
{
    const auto f = rectified_frustum_from_corners(rectified_corners<T>{});
    CHECK((f.radius == 0 && f.azimuth_length == 0 && f.polar_least == 0 && f.polar_most == 0));
    // A corner on the axis: a quarter of a turn, from the three others.
    const auto corner =
        rectified_frustum_from_corners(rectified_corners<T>{{0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}});
    CHECK(std::abs(corner.azimuth_start) <= T(4 * u<T>));
    CHECK(std::abs(corner.azimuth_length - T(pi / 2)) <= T(8 * u<T>));
    CHECK(corner.polar_least == 0);
    const auto edge =
        rectified_frustum_from_corners(rectified_corners<T>{{-1, 0, -2}, {1, 0, -2}, {1, 1, -2}, {-1, 1, -2}});
    CHECK((edge.azimuth_length >= T(3.14159) && edge.polar_most == T(pi)));
    const auto line = rectified_frustum_from_corners(rectified_corners<T>{{0, 0, 1}, {0, 0, 2}, {0, 0, 3}, {0, 0, 4}});
    CHECK((line.radius == 0 && line.polar_least == 0 && line.polar_most == 0));
    hostile_source<T> source(4);
    for (std::int64_t i = 0; i < effort(50'000); ++i) {
        const auto x = source.draw(), y = source.draw();
        const rectified_corners<T> q{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, {y[0], y[1], y[2]}, {y[3], y[4], y[5]}};
        const auto any = rectified_frustum_from_corners(q);
        const auto row = rectified_row_polar(q, x[6], y[6]);
        REQUIRE((0 <= any.polar_least && any.polar_least <= any.polar_most && any.polar_most <= T(pi)));
        REQUIRE((0 <= row.least && row.least <= row.most && row.most <= T(pi)));
        REQUIRE((0 <= any.azimuth_length && any.azimuth_length <= T(2 * pi) && !(any.radius < 0)));
        REQUIRE(!(std::abs(any.azimuth_start) > T(pi)));
    }
}
