// The path of a receiver over the map: its texels and their times against the path in extended precision, times that
// are contiguous bit for bit for any path, and the number and times of samples.
#include "receiver_paths.hpp"
#include "support/effort.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> bool same_bits(T a, T b) { return std::memcmp(&a, &b, sizeof a) == 0; }

template <class T> receiver_path<T> hostile_path(hostile_source<T>& source, bit_source& bits)
{
    receiver_path<T> p = any_path<T>(bits, 6);
    T* const numbers[] = {&p.depth.t0, &p.depth.t1, &p.depth.z0, &p.depth.z1, &p.depth.id, &p.x0,
                          &p.y0,       &p.w0,       &p.x1,       &p.y1,       &p.w1};
    const bool all = bits.chance(0.3);
    for (T* x : numbers)
        if (all || bits.chance(0.1)) *x = bits.chance(0.5) ? source.special() : source.pattern();
    return p;
}

} // namespace

// Whole sweeps by the loop of a caller.
TEST_CASE_TEMPLATE("sweep: for any path its times are contiguous bit for bit, and it ends", T, float, double)
{
    hostile_source<T> hostile(31);
    bit_source bits(32);
    std::int64_t swept = 0, endless = 0;
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const receiver_path<T> p = i % 2 ? hostile_path<T>(hostile, bits) : any_path<T>(bits, 12);
        texel_sweep<T> s = texel_sweep_begin(p);
        const T columns = s.last_column - s.column, rows = s.last_row - s.row;
        REQUIRE((std::abs(columns) <= 131072 && std::abs(rows) <= 131072));
        if (std::abs(columns) + std::abs(rows) > 1000 && ++endless > 20) continue; // 20 of the longest will do
        const std::int64_t bound = std::int64_t(std::abs(columns) + std::abs(rows)) + 1;
        REQUIRE(same_bits(s.t_begin, p.depth.t0));
        std::int64_t texels = 1;
        for (; s.t_end < p.depth.t1; ++texels) {
            REQUIRE(texels < bound);
            REQUIRE(s.t_begin <= s.t_end);
            const texel_sweep<T> next = texel_sweep_next(s);
            REQUIRE(same_bits(next.t_begin, s.t_end));
            // One step towards the last texel.
            const T left = std::abs(s.last_column - s.column) + std::abs(s.last_row - s.row);
            REQUIRE(std::abs(next.column - s.column) + std::abs(next.row - s.row) == 1);
            REQUIRE(std::abs(s.last_column - next.column) + std::abs(s.last_row - next.row) == left - 1);
            s = next;
        }
        REQUIRE(same_bits(s.t_end, p.depth.t1));
        swept += texels;
        // Further calls stay at the last texel.
        for (std::int64_t k = 0; k <= bound; ++k) s = texel_sweep_next(s);
        REQUIRE((same_bits(s.column, s.last_column) && same_bits(s.row, s.last_row)));
        REQUIRE(same_bits(s.t_end, p.depth.t1));
    }
    CHECK(swept > 3 * effort(100'000));
}

TEST_CASE_TEMPLATE("sweep: without a valid path it has one texel for the whole time", T, float, double)
{
    const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
    const receiver_path<T> p{{T(0.25), T(0.75), 0, 0, 1}, T(1.5), T(2.5), 1, T(8.5), T(9.5), 1};
    for (const auto member : {&receiver_path<T>::x0, &receiver_path<T>::y0, &receiver_path<T>::w0,
                              &receiver_path<T>::x1, &receiver_path<T>::y1, &receiver_path<T>::w1})
        for (const T bad : {nan, inf, -inf}) {
            receiver_path<T> broken = p;
            broken.*member = bad;
            const bool is_w = member == &receiver_path<T>::w0 || member == &receiver_path<T>::w1;
            if (is_w && bad == inf) continue; // at the origin, and a path from there
            const texel_sweep<T> s = texel_sweep_begin(broken);
            CHECK(s.t_begin == T(0.25));
            CHECK(s.t_end == T(0.75));
            if (member == &receiver_path<T>::x0 && bad != -inf) CHECK(s.column == 65536);
        }
    receiver_path<T> behind = p;
    behind.w1 = T(-1);
    CHECK(texel_sweep_begin(behind).t_end == T(0.75));
    CHECK(texel_sweep_over(behind, T(0), T(0), T(9), T(9)).t_last < T(0.75));
    CHECK(texel_sweep_over(p, T(3), T(0), T(9), T(2)).column == 9); // none
    behind = p;
    behind.depth.t1 = T(0.125);
    CHECK(texel_sweep_begin(behind).t_end == T(0.125));
}

namespace {

struct texel_area {
    int left, top, right, bottom;
};

template <class T> texel_sweep<T> sweep_over(const receiver_path<T>& p, const texel_area& a)
{
    return texel_sweep_over(p, T(a.left), T(a.top), T(a.right), T(a.bottom));
}

/// Texels from (left, top) to before (right, bottom) in which a sweep spends time.
template <class T> std::vector<std::array<T, 4>> visited(texel_sweep<T> s, const texel_area& a)
{
    std::vector<std::array<T, 4>> result;
    for (;; s = texel_sweep_next(s)) {
        if (s.t_begin < s.t_end && s.column >= T(a.left) && s.column < T(a.right) && s.row >= T(a.top) &&
            s.row < T(a.bottom))
            result.push_back({s.column, s.row, s.t_begin, s.t_end});
        if (!(s.t_end < s.t_last)) return result;
    }
}

texel_area any_area(bit_source& bits)
{
    const int left = int(bits.below(9)) - 2, top = int(bits.below(9)) - 2;
    return {left, top, left + 1 + int(bits.below(6)), top + 1 + int(bits.below(6))};
}

} // namespace

TEST_CASE_TEMPLATE("sweep over an area: the bits of the whole sweep there, in as few steps as possible", T, float,
                   double)
{
    bit_source bits(36);
    std::int64_t other_bits = 0, some = 0;
    const std::int64_t cases = effort(50'000);
    for (std::int64_t i = 0; i < cases; ++i) {
        const receiver_path<T> p = any_path<T>(bits, 12);
        const texel_area area = any_area(bits);
        const auto expected = visited(texel_sweep_begin(p), area), found = visited(sweep_over(p, area), area);
        some += !expected.empty();
        if (found == expected) continue;
        // Rounding decides by which texel a path enters at a corner or along a border.
        ++other_bits;
        const auto time = [](const std::vector<std::array<T, 4>>& texels) {
            wide sum = 0;
            for (const auto& t : texels) sum += wide(t[3]) - wide(t[2]);
            return sum;
        };
        const auto on_border = [](T x, T w) { return std::abs(x / w - std::round(x / w)) < T(1e-4); };
        if (on_border(p.x0, p.w0) || on_border(p.y0, p.w0)) continue; // it belongs to one side
        REQUIRE(std::abs(time(found) - time(expected)) <= 1000 * rounding<T>);
    }
    CHECK(some > cases / 5);
    CHECK(other_bits < cases / 50);
}

TEST_CASE_TEMPLATE("sweep over an area: it ends for any path", T, float, double)
{
    hostile_source<T> hostile(37);
    bit_source bits(38);
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const receiver_path<T> p = i % 4 ? hostile_path<T>(hostile, bits) : any_path<T>(bits, 1e9);
        const texel_area a = any_area(bits);
        texel_sweep<T> s = sweep_over(p, a);
        for (std::int64_t steps = (a.right - a.left) + (a.bottom - a.top) + 3;; s = texel_sweep_next(s)) {
            REQUIRE((s.column >= T(a.left - 1) && s.column <= T(a.right)));
            REQUIRE((s.row >= T(a.top - 1) && s.row <= T(a.bottom)));
            if (!(s.t_end < s.t_last)) break;
            REQUIRE(--steps > 0);
        }
    }
}

// The light's plane is where w is 0: behind it the path is not seen.
TEST_CASE_TEMPLATE("sweep over an area: texels are those of the path, also past the light's plane", T, float, double)
{
    bit_source bits(39);
    std::int64_t inside = 0, behind = 0;
    for (std::int64_t i = 0; i < effort(50'000); ++i) {
        receiver_path<T> p = any_path<T>(bits, 12);
        const double x = bits.uniform(-8, 8), y = bits.uniform(-8, 8), w = bits.uniform(-1, 0.5);
        if (bits.chance(0.5)) p.x0 = T(x), p.y0 = T(y), p.w0 = T(w);
        else p.x1 = T(x), p.y1 = T(y), p.w1 = T(w);
        const texel_area area = any_area(bits);
        const auto texels = visited(sweep_over(p, area), area);
        const wide t = wide(p.depth.t0) + wide(bits.uniform(0, 1)) * (wide(p.depth.t1) - wide(p.depth.t0));
        const exact_position at = exact_path_at(p, t);
        // x - c w is known within 8 2^-p of 12 + 12 w, and positions, which it is divided by w for, within its 16th.
        const wide slack = 8 * 24 * 16 * rounding<T> / std::abs(at.w) + 1000 * rounding<T>;
        const auto off = [&](wide low, wide high, wide position) { return std::max(low - position, position - high); };
        const wide beyond = std::max(off(area.left, area.right, at.x), off(area.top, area.bottom, at.y));
        const auto there =
            std::ranges::find_if(texels, [&](const auto& c) { return wide(c[2]) <= t && t <= wide(c[3]); });
        if (at.w < 0 || beyond > slack) {
            behind += at.w < 0 && beyond < 0;
            REQUIRE(there == texels.end());
        } else if (beyond < -slack) {
            ++inside;
            REQUIRE(there != texels.end());
            REQUIRE(off(wide((*there)[0]), wide((*there)[0]) + 1, at.x) <= slack);
            REQUIRE(off(wide((*there)[1]), wide((*there)[1]) + 1, at.y) <= slack);
        }
    }
    CHECK(inside > effort(50'000) / 50);
    CHECK(behind > 0);
}

// A time well inside of a step is in the step's texel. Well inside means by more than the error of border times, with
// positions off the borders by the rounding of the first and the last one.
TEST_CASE_TEMPLATE("sweep: texels are those of the path", T, float, double)
{
    bit_source bits(33);
    std::int64_t asked = 0, decided = 0;
    for (std::int64_t i = 0; i < effort(50'000); ++i) {
        const receiver_path<T> p = any_path<T>(bits, 12);
        for_each_texel(p, [&](const texel_sweep<T>& s) {
            if (!(s.t_begin < s.t_end)) return;
            const wide t = wide(s.t_begin) + wide(bits.uniform(0, 1)) * (wide(s.t_end) - wide(s.t_begin));
            const exact_position at = exact_path_at(p, t);
            // The comment's error of a border time, times speed, is one of position: 4 2^-p (2 12 w) twice over w, and
            // rounding times moves it by 4 2^-p of up to 12 r, r = 4 the ratio of both w.
            const wide tolerance = (2 * 4 * 24 + 4 * 12 * 4) * 4 * rounding<T>;
            const auto inside = [&](wide x, T texel) {
                return wide(texel) - tolerance <= x && x <= wide(texel) + 1 + tolerance;
            };
            REQUIRE(inside(at.x, s.column));
            REQUIRE(inside(at.y, s.row));
            ++asked;
            decided += wide(s.column) <= at.x && at.x < wide(s.column) + 1;
        });
    }
    CHECK(decided >= asked - asked / 100); // not on a path along a border
}

TEST_CASE_TEMPLATE("path: positions, shifts and parts", T, float, double)
{
    bit_source bits(34);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const receiver_path<T> p = any_path<T>(bits, 12);
        const T passed = T(bits.uniform(0, 1)), t = p.depth.t0 * (1 - passed) + p.depth.t1 * passed;
        if (t < p.depth.t0 || t > p.depth.t1 || p.depth.t1 - p.depth.t0 < T(0.01)) continue;
        const exact_position at = exact_path_at(p, wide(t));
        const wide ratio = std::max(wide(p.w0) / wide(p.w1), wide(p.w1) / wide(p.w0));
        const wide error = 8 * 12 * (ratio == 1 ? 1 : 1 + ratio) * rounding<T>;
        const texel_position<T> found = receiver_path_at(p, t);
        REQUIRE(std::abs(wide(found.x) - at.x) <= error);
        REQUIRE(std::abs(wide(found.y) - at.y) <= error);
        const texel_position<T> shifted = receiver_path_at(receiver_path_shift(p, T(3), T(-2)), t);
        REQUIRE(std::abs(wide(shifted.x) - at.x - 3) <= 2 * error); // up to 15 texels
        REQUIRE(std::abs(wide(shifted.y) - at.y + 2) <= 2 * error);
        // The second half of a path goes from its middle to its end.
        const receiver_path<T> part = receiver_path_clip(p, t, T(1));
        REQUIRE(part.depth.t0 == t);
        REQUIRE(part.depth.t1 == p.depth.t1);
        REQUIRE(std::abs(wide(receiver_path_at(part, t).x) - at.x) <= 2 * error);
        REQUIRE(std::abs(wide(part.x1 / part.w1) - wide(p.x1) / wide(p.w1)) <= 2 * error);
    }
}

TEST_CASE_TEMPLATE("samples: max(2 length, 5) rounded up and capped, one time in each n-th", T, float, double)
{
    const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
    const auto count = [](T dx, T dy, T most, T w = 1) {
        return receiver_sample_count(receiver_path<T>{{0, 1, 0, 0, 0}, 1, 2, 1, (1 + dx) * w, (2 + dy) * w, w}, most);
    };
    CHECK(count(0, 0, 100) == 5);
    CHECK(count(T(2.5), 0, 100) == 5);
    CHECK(count(3, 4, 100) == 10);
    CHECK(count(3, 4, 100, T(0.5)) == 10);
    CHECK(count(-3, T(4.125), 100) == 11);
    CHECK(count(300, 400, 100) == 100);
    CHECK(count(300, 400, 1) == 5);
    CHECK(count(300, 400, nan) == 5);
    CHECK(count(nan, 0, 100) == 5);
    CHECK(count(inf, 0, inf) == 1048576);
    bit_source bits(35);
    for (int i = 0; i < 10'000; ++i) {
        const receiver_path<T> p = any_path<T>(bits, 12);
        const wide dx = wide(p.x1) / wide(p.w1) - wide(p.x0) / wide(p.w0);
        const wide dy = wide(p.y1) / wide(p.w1) - wide(p.y0) / wide(p.w0);
        REQUIRE(std::abs(wide(receiver_path_length(p)) - std::hypot(dx, dy)) <= 4 * 24 * rounding<T>);
        const T n = receiver_sample_count(p, T(1000));
        const wide wanted = std::max(2 * wide(receiver_path_length(p)), 5.0L);
        REQUIRE((wide(n) >= wanted && wide(n) < wanted + 1));
        for (T k = 0; k < n; ++k) {
            const wide t = wide(receiver_sample_time(p, k, n, T(bits.uniform(0, 1))));
            const wide passed = (t - wide(p.depth.t0)) / (wide(p.depth.t1) - wide(p.depth.t0));
            const wide slack = 8 * rounding<T> / (wide(p.depth.t1) - wide(p.depth.t0));
            REQUIRE((passed >= wide(k) / wide(n) - slack && passed <= wide(k + 1) / wide(n) + slack));
        }
    }
    sampled_receiver<T> state = sampled_receiver_begin(T(4));
    for (const T x : {T(1), nan, T(0.5), T(7)}) state = sampled_receiver_add(state, x);
    CHECK(sampled_receiver_end(state) == T(0.625));
    CHECK(sampled_receiver_end(sampled_receiver_begin(T(0))) == 0);
}
