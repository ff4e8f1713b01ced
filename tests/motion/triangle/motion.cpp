// Motion of the point of a triangle that a sample sees, against barycentric coordinates in 120 digits; hostile input.
#include "motion/receiver/moving_reference.hpp"
#include "support/oracle.hpp"

#include <gnomon/motion/triangle/triangle_motion.h>

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

using namespace gnomon;
using namespace gnomon::test;

namespace {

// Homogeneous coordinates x, y, z, w and a last one that is 1.
using point5 = std::array<high, 5>;

template <class T> std::array<point5, 3> corners_at(const moving_triangle<T>& m, const high& t)
{
    std::array<point5, 3> p;
    const std::array<const moving_vertex<T>*, 3> v{&m.a, &m.b, &m.c};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto mean = [&](T q, T r) { return high((1 - t) * high(q) + t * high(r)); };
        p[k] = {mean(v[k]->x0, v[k]->x1), mean(v[k]->y0, v[k]->y1), mean(v[k]->z0, v[k]->z1), mean(v[k]->w0, v[k]->w1),
                1};
    }
    return p;
}

/// Weights of the corners that sum to 1 and whose point projects to the sample, by Cramer's rule.
template <class T> std::array<high, 3> weights_at(const moving_triangle<T>& m, T s_x, T s_y, const high& t)
{
    const auto p = corners_at(m, t);
    std::array<high, 3> x, y, weights;
    for (std::size_t k = 0; k < 3; ++k) x[k] = p[k][0] - high(s_x) * p[k][3], y[k] = p[k][1] - high(s_y) * p[k][3];
    high sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        weights[k] = x[i] * y[j] - x[j] * y[i];
        sum += weights[k];
    }
    for (high& w : weights) w /= sum;
    return weights;
}

/// A coordinate of the point at one end of the shutter, and the error that the kernel states for it. by: 3 to divide by w,
/// 4 not to.
template <class T> struct end_of_motion {
    high place, error;

    end_of_motion(const std::array<point5, 3>& p, const std::array<high, 3>& weights, const reference<T>& r, exact t,
                  std::size_t axis, std::size_t by)
    {
        high sum = 0, divisor = 0, sizes = 0, moved = 0;
        for (std::size_t k = 0; k < 3; ++k) sum += weights[k] * p[k][axis], divisor += weights[k] * p[k][by];
        place = sum / divisor;
        const auto edges = r.at(t).edges;
        const exact whole = std::abs(edges[0] + edges[1] + edges[2]);
        for (std::size_t k = 0; k < 3; ++k) {
            sizes += abs(weights[k]) * (abs(p[k][axis]) + abs(place * p[k][by]));
            moved += high(r.tolerance[k] / whole) * abs(p[k][axis] - place * p[k][by]);
        }
        error = (moved + 16 * high(u<T>) * sizes) / abs(divisor);
    }
};

} // namespace

TEST_CASE_TEMPLATE("the motion is that of the point that the sample sees, within its stated error", T, float, double)
{
    std::int64_t asked = 0, sharp = 0, behind = 0;
    bit_source bits(22);
    for_each_scene<T>(40'000, 21, [&](const moving_triangle<T>& m, T s_x, T s_y, movement) {
        const moving_edges<T> e = moving_triangle_edges(m, s_x, s_y);
        for (const T facing : {T(1), T(-1)}) {
            const coverage_intervals<T> x = moving_coverage(e, facing);
            if (x.count == 0) continue;
            const T t = x.begin0 + (x.end0 - x.begin0) * T(bits.uniform(0, 1));
            const reference<T> r(m, s_x, s_y);
            const auto weights = weights_at(m, s_x, s_y, high(t));
            const auto open = corners_at(m, 0), close = corners_at(m, 1);
            const T divided = T(bits.below(2));
            const triangle_motion<T> d = moving_triangle_motion(m, e, t, divided);
            ++asked;
            bool narrow = true, before = true;
            for (const auto* p : {&open, &close}) {
                const end_of_motion<T> w(*p, weights, r, exact(t), 3, 4);
                narrow = narrow && w.error < abs(w.place) / 1000;
                before = before && w.place > 0;
            }
            if (!narrow) continue;
            if (!before) {
                ++behind;
                REQUIRE((d.d_x == 0 && d.d_y == 0 && d.d_z == 0));
                continue;
            }
            ++sharp;
            const std::array<T, 3> found{d.d_x, d.d_y, d.d_z};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::size_t by = axis < 2 || divided > 0 ? 3 : 4;
                const end_of_motion<T> from(open, weights, r, exact(t), axis, by),
                    to(close, weights, r, exact(t), axis, by);
                const high expected = to.place - from.place;
                if (abs(expected) > 65000) continue;
                REQUIRE(abs(high(found[axis]) - expected) <= from.error + to.error);
            }
        }
    });
    CHECK(double(sharp) > 0.6 * double(asked));
    CHECK(asked > effort(10'000));
    CHECK(behind == 0); // all corners of these scenes are before the light
}

TEST_CASE("what does not move has no motion, bit for bit; what is carried moves as all of its points")
{
    CHECK(rc::check("in float", [] {
        const auto number = [](double low, double high) {
            return float(low + (high - low) * *rc::gen::inRange(0, 1 << 20) / (1 << 20));
        };
        moving_triangle<float> m;
        const float by_x = number(-4, 4), by_y = number(-4, 4), by_z = number(-1, 1);
        for (moving_vertex<float>* v : {&m.a, &m.b, &m.c}) {
            const float x = number(-8, 8), y = number(-8, 8), z = number(-1, 1), w = number(0.5, 4);
            *v = {x, y, z, w, x, y, z, w};
        }
        const float s_x = number(-2, 2), s_y = number(-2, 2), t = number(0, 1);
        const auto motion = [&] { return moving_triangle_motion(m, moving_triangle_edges(m, s_x, s_y), t, 0.f); };
        const triangle_motion<float> still = motion();
        RC_ASSERT(still.d_x == 0 && still.d_y == 0 && still.d_z == 0);
        for (moving_vertex<float>* v : {&m.a, &m.b, &m.c})
            v->w0 = v->w1 = 1, v->x1 = v->x0 + by_x, v->y1 = v->y0 + by_y, v->z1 = v->z0 + by_z;
        const triangle_motion<float> carried = motion();
        RC_ASSERT(std::abs(carried.d_x - by_x) < 1e-5f);
        RC_ASSERT(std::abs(carried.d_y - by_y) < 1e-5f);
        RC_ASSERT(std::abs(carried.d_z - by_z) < 1e-5f);
    }));
}

TEST_CASE_TEMPLATE("any bits give a finite motion, and none where the point is behind the light", T, float, double)
{
    hostile_source<T> hostile(24);
    bit_source bits(25);
    std::int64_t moving = 0;
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        std::array<T, 35> numbers;
        const auto kind = bits.below(3);
        for (T& x : numbers) {
            x = T(bits.uniform(-2, 2));
            if (kind > 0 && bits.chance(kind == 1 ? 0.05 : 1))
                x = bits.chance(0.5) ? hostile.special() : hostile.pattern();
        }
        moving_triangle<T> m;
        moving_edges<T> e;
        std::memcpy(&m, numbers.data(), sizeof m);
        std::memcpy(&e, numbers.data() + 24, sizeof e);
        const triangle_motion<T> d = moving_triangle_motion(m, e, numbers[33], numbers[34]);
        for (const T x : {d.d_x, d.d_y, d.d_z}) REQUIRE(std::abs(x) <= T(triangle_motion_limit));
        moving += d.d_x < 0 || d.d_x > 0;
        for (moving_vertex<T>* v : {&m.a, &m.b, &m.c}) v->w1 = -std::abs(v->w1);
        const triangle_motion<T> none = moving_triangle_motion(m, e, numbers[33], numbers[34]);
        REQUIRE((none.d_x == 0 && none.d_y == 0 && none.d_z == 0));
    }
    CHECK(moving > 100);
}
