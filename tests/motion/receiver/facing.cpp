// Turning surfaces: the times at which they face the light, by facing_function, against the product of both vectors at
// many times in extended precision.
#include "receiver_cases.hpp"
#include "support/effort.hpp"

#include <gnomon/motion/receiver/facing.h>

#include <doctest/doctest.h>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> moving_vector<T> any_vector(bit_source& bits)
{
    const auto number = [&] { return bits.chance(0.1) ? T(bits.below(3)) - T(1) : T(bits.uniform(-1, 1)); };
    moving_vector<T> v{number(), number(), number(), number(), number(), number()};
    if (bits.chance(0.1)) v.x1 = v.x0, v.y1 = v.y0, v.z1 = v.z0;
    return v;
}

template <class T> std::array<wide, 3> exact_vector(const moving_vector<T>& v, wide t)
{
    return {wide(v.x0) * (1 - t) + wide(v.x1) * t, wide(v.y0) * (1 - t) + wide(v.y1) * t,
            wide(v.z0) * (1 - t) + wide(v.z1) * t};
}

wide dot(const std::array<wide, 3>& a, const std::array<wide, 3>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

template <class T> wide largest_length(const moving_vector<T>& v)
{
    const auto a = exact_vector(v, 0), b = exact_vector(v, 1);
    return std::sqrt(std::max(dot(a, a), dot(b, b)));
}

template <class T> bool faces(const edge_intervals<T>& x, T t)
{
    return x.begin <= t && t <= x.end && !(x.gap_begin < t && t < x.gap_end);
}

} // namespace

TEST_CASE_TEMPLATE("facing: coefficients within the stated error, times as by dense sampling", T, float, double)
{
    bit_source bits(61);
    std::int64_t asked = 0, decided = 0, twice = 0;
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const moving_vector<T> n = any_vector<T>(bits), d = any_vector<T>(bits);
        const moving_edge<T> f = facing_function(n, d);
        const wide size = largest_length(n) * largest_length(d), error = 4 * rounding<T> * size;
        const auto n0 = exact_vector(n, 0), n1 = exact_vector(n, 1), d0 = exact_vector(d, 0), d1 = exact_vector(d, 1);
        REQUIRE(std::abs(wide(f.e0) - dot(n0, d0)) <= error);
        REQUIRE(std::abs(wide(f.e1) - (dot(n0, d1) + dot(n1, d0)) / 2) <= error);
        REQUIRE(std::abs(wide(f.e2) - dot(n1, d1)) <= error);
        const edge_intervals<T> x = moving_edge_inside(f, T(1));
        twice += x.gap_begin < x.gap_end && x.begin == 0 && x.end == 1;
        for (int k = 0; k <= 32; ++k) {
            const T t = T(k) / 32;
            const wide exact = dot(exact_vector(n, wide(t)), exact_vector(d, wide(t)));
            ++asked;
            // 20 of the coefficients, and 2 roundings of times at a slope of 4 at most.
            if (std::abs(exact) <= (20 + 8) * rounding<T> * size) continue;
            ++decided;
            REQUIRE(faces(x, t) == (exact > 0));
        }
    }
    CHECK(decided > asked * 98 / 100);
    CHECK(twice > effort(100'000) / 1000);
}

TEST_CASE_TEMPLATE("facing: at all times, never, turning away, twice, and with NaN", T, float, double)
{
    const T nan = std::numeric_limits<T>::quiet_NaN();
    const moving_vector<T> up{0, 0, 1, 0, 0, 1}, turning{0, 0, 1, 0, 0, -1};
    const auto times = [](const moving_vector<T>& n, const moving_vector<T>& d) {
        return moving_edge_inside(facing_function(n, d), T(1));
    };
    CHECK((times(up, up).begin == 0 && times(up, up).end == 1));
    const moving_vector<T> down{0, 0, -1, 0, 0, -1};
    CHECK(times(up, down).begin > times(up, down).end);
    CHECK((times(turning, up).begin == 0 && times(turning, up).end == T(0.5)));
    // Normal and light turn to the other side at 1/4 and at 3/4; in between they point away from one another.
    const moving_vector<T> early{0, 0, 1, 0, 0, -3}, late{0, 0, 3, 0, 0, -1};
    const edge_intervals<T> both = times(early, late);
    CHECK((both.begin == 0 && both.end == 1));
    CHECK(both.gap_begin == doctest::Approx(0.25));
    CHECK(both.gap_end == doctest::Approx(0.75));
    for (const auto member : {&moving_vector<T>::x0, &moving_vector<T>::y0, &moving_vector<T>::z0,
                              &moving_vector<T>::x1, &moving_vector<T>::y1, &moving_vector<T>::z1}) {
        moving_vector<T> broken = up;
        broken.*member = nan;
        for (const auto& x : {times(broken, up), times(up, broken)})
            CHECK((x.begin == 0 && x.end == 1 && x.gap_begin == x.gap_end)); // lit
    }
}

// As in the thesis: the parts of a path that face the light, each with its shadows, and darkness between them.
TEST_CASE_TEMPLATE("facing: the parts of a path that face the light", T, float, double)
{
    const moving_vector<T> n{0, 0, 1, 0, 0, -3}, d{0, 0, 3, 0, 0, -1};
    const edge_intervals<T> x = moving_edge_inside(facing_function(n, d), T(1));
    const receiver_path<T> path{{T(0), T(1), T(0), T(0.5), T(1)}, T(1), T(1), T(1), T(9), T(5), T(1)};
    wide dark = wide(x.gap_end) - wide(x.gap_begin);
    for (const auto& part :
         {receiver_path_clip(path, x.begin, x.gap_begin), receiver_path_clip(path, x.gap_end, x.end)}) {
        moving_receiver<T> state = moving_receiver_begin(part, T(0), T(1));
        texel_sweep<T> sweep = texel_sweep_begin(part);
        const depth_time_range<T> occluder{T(0.125), T(1), T(-1), T(-1), T(2)};
        for (bool more = true; more;) {
            state = add_range(moving_receiver_texel(state, sweep), occluder, box_shutter{});
            more = sweep.t_end < part.depth.t1;
            sweep = texel_sweep_next(sweep);
        }
        dark += wide(moving_receiver_end(state));
    }
    CHECK(std::abs(dark - 0.875L) <= 64 * rounding<T>);
}
