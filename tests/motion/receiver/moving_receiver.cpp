// Receivers that move over a map of resolved lists: the closed form against 4096 times, against extended precision in
// one texel, against a receiver at rest; planes that must not shadow themselves; percentage-closer filtering.
#include "receiver_paths.hpp"
#include "support/effort.hpp"

#include <doctest/doctest.h>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr int side = 16, margin = 2; // texels of the map, and around it for filters
constexpr int times = 4096;

template <class T> using texel_list = std::vector<depth_time_range<T>>;

template <class T> struct test_map {
    std::vector<texel_list<T>> lists;
    const texel_list<T>& at(T column, T row) const
    {
        REQUIRE((column >= -margin && column < side - margin && row >= -margin && row < side - margin));
        return lists[std::size_t(int(row) + margin) * side + std::size_t(int(column) + margin)];
    }
};

template <class T> test_map<T> any_map(bit_source& bits)
{
    test_map<T> map;
    for (int i = 0; i < side * side; ++i) map.lists.push_back(resolved_list<T>(bits));
    return map;
}

template <class T> test_map<T> uniform_map(const depth_time_range<T>& r) { return {{side * side, {r}}}; }

template <class T> T nearest(const test_map<T>& map, const receiver_path<T>& p, const test_shutter<T>& s)
{
    moving_receiver<T> state = moving_receiver_begin(p, s.begin, s.end);
    for_each_texel(p, [&](const texel_sweep<T>& sweep) {
        state = moving_receiver_texel(state, sweep);
        for (const auto& r : map.at(sweep.column, sweep.row)) state = s.add(state, r);
    });
    return moving_receiver_end(state);
}

template <class T>
T filtered(const test_map<T>& map, const receiver_path<T>& p, const test_shutter<T>& s, int look_ups = 1)
{
    moving_receiver<T> state = moving_receiver_begin(p, s.begin, s.end);
    const T back = T(-0.5) * T(look_ups);
    for_each_texel(receiver_path_shift(p, back, back), [&](const texel_sweep<T>& sweep) {
        for (int j = 0; j <= look_ups; ++j)
            for (int i = 0; i <= look_ups; ++i) {
                state = moving_receiver_tap(state, sweep, T(i), T(j), T(look_ups));
                for (const auto& r : map.at(sweep.column + T(i), sweep.row + T(j))) state = s.filter(state, r);
            }
    });
    return moving_receiver_end(state);
}

template <class T> bool hides(const texel_list<T>& list, const receiver_path<T>& p, wide t)
{
    const wide z = exact_depth(p.depth, t);
    return std::any_of(list.begin(), list.end(), [&](const depth_time_range<T>& r) {
        return wide(r.t0) <= t && t < wide(r.t1) && exact_depth(r, t) < z && r.id != p.depth.id;
    });
}

/// The mean over many times in the exposure, by definition.
template <class T>
wide sampled(const test_map<T>& map, const receiver_path<T>& p, const test_shutter<T>& s, bool bilinear)
{
    wide sum = 0;
    for (int k = 0; k < times; ++k) {
        const wide x = (k + 0.5L) / times, t = wide(s.begin) + x * (wide(s.end) - wide(s.begin));
        if (t < wide(p.depth.t0) || t > wide(p.depth.t1)) continue;
        const exact_position at = exact_path_at(p, t);
        const wide off = bilinear ? 0.5L : 0, column = std::floor(at.x - off), row = std::floor(at.y - off);
        const wide u = at.x - off - column, v = at.y - off - row;
        wide hidden = 0;
        for (int i = 0; i < (bilinear ? 4 : 1); ++i) {
            const wide weight = bilinear ? (i % 2 ? u : 1 - u) * (i / 2 ? v : 1 - v) : 1;
            if (hides(map.at(T(column + i % 2), T(row + i / 2)), p, t)) hidden += weight;
        }
        sum += s.density(x) * hidden / times;
    }
    return sum;
}

/// Whether it goes along a border of texels, where rounding says in which.
template <class T> bool between_texels(const receiver_path<T>& p)
{
    const auto near = [](wide a, wide b) { return std::abs(a - std::round(a)) + std::abs(b - std::round(a)) < 1e-5L; };
    return near(wide(p.x0) / wide(p.w0), wide(p.x1) / wide(p.w1)) ||
           near(wide(p.y0) / wide(p.w0), wide(p.y1) / wide(p.w1));
}

/// How far the closed form may be from that many times.
template <class T>
wide sampling_error(const test_map<T>& map, const receiver_path<T>& p, const test_shutter<T>& s, bool bilinear)
{
    wide events = 11, undecided = 0, chord = 0; // the path's ends, the shutter's own breaks
    const T back = bilinear ? T(-0.5) : T(0);
    const receiver_path<T> path = receiver_path_shift(p, back, back);
    const wide exposure = wide(s.end) - wide(s.begin);
    for_each_texel(path, [&](const texel_sweep<T>& sweep) {
        events += 1;
        for (int i = 0; i < (bilinear ? 4 : 1); ++i)
            for (const auto& r : map.at(sweep.column + T(i % 2), sweep.row + T(i / 2))) {
                events += 3; // begins, meets, ends
                undecided += exact_loss(r, p.depth, sweep.t_begin, sweep.t_end, s).error;
            }
        if (!(sweep.t_begin < sweep.t_end)) return;
        const exact_position a = exact_path_at(path, wide(sweep.t_begin)), b = exact_path_at(path, wide(sweep.t_end));
        const wide root = std::sqrt(std::max(a.w / b.w, b.w / a.w)), part = wide(sweep.t_end) - wide(sweep.t_begin);
        if (bilinear) chord += part / exposure * (std::abs(a.x - b.x) + std::abs(a.y - b.y)) * (root - 1) / (root + 1);
        // A border's time by the comment of texel_border_share, x and |c| w being 32 at most.
        const bool sideways = sweep.across_column <= sweep.across_row;
        const T texel = sideways ? sweep.column : sweep.row, last = sideways ? sweep.last_column : sweep.last_row;
        if (bilinear || texel == last) return;
        const wide border = wide(texel) + (texel < last ? 1 : 0);
        const wide distance0 = wide(sideways ? p.x0 : p.y0) - border * wide(p.w0);
        const wide distance1 = wide(sideways ? p.x1 : p.y1) - border * wide(p.w1);
        undecided += s.largest() * (4 * 128 / std::abs(distance0 - distance1) + 2) * rounding<T> / exposure;
    });
    // An event between two times costs half a step, and so do, by a weight's slope, at most 4 lengths per exposure,
    // those of the second order; bilinear positions are as exact as texels are large, 32 of them.
    const wide slope = 4 * 32 / (wide(p.depth.t1) - wide(p.depth.t0)) * exposure;
    const wide smooth = bilinear ? events * slope / (8.0L * times * times) + 4 * 8 * 32 * 5 * rounding<T> : 0;
    return s.largest() * (events / (2.0L * times) + smooth + chord) + undecided;
}

template <class T> test_shutter<T> exposure_of(const receiver_path<T>& p, std::size_t i, bit_source& bits)
{
    const bool whole = i / 3 % 2 == 0;
    return any_shutter(responses[i % 3], whole ? p.depth.t0 : T(0), whole ? p.depth.t1 : T(1), bits);
}

} // namespace

TEST_CASE_TEMPLATE("moving receiver: the closed form is what 4096 times say", T, float, double)
{
    bit_source bits(41);
    wide worst[3] = {0, 0, 0}; // nearest, bilinear, bilinear in perspective
    for (std::int64_t i = 0; i < effort(600); ++i) {
        const test_map<T> map = any_map<T>(bits);
        const receiver_path<T> p = any_path<T>(bits, side - 2 * margin - 1);
        const auto s = exposure_of(p, std::size_t(i), bits);
        for (const bool bilinear : {false, true}) {
            if (!bilinear && between_texels(p)) continue;
            const wide expected = sampled(map, p, s, bilinear), error = sampling_error(map, p, s, bilinear);
            const wide difference = std::abs(wide(bilinear ? filtered(map, p, s) : nearest(map, p, s)) - expected);
            CAPTURE(bilinear);
            CAPTURE(i);
            CHECK(difference <= error);
            wide& record = worst[!bilinear ? 0 : p.w0 == p.w1 ? 1 : 2];
            record = std::max(record, difference);
        }
    }
    MESSAGE("most: nearest ", double(worst[0]), ", bilinear ", double(worst[1]), ", and in perspective ",
            double(worst[2]));
}

// In a cell the weights' way is a chord, in perspective an arc: u(s) = s w1 / (w0 (1 - s) + w1 s) departs from s by
// (sqrt(r) - 1) / (sqrt(r) + 1) at most, r = w1 / w0.
TEST_CASE("moving receiver: how far weights are from linear in perspective is as said, and reached")
{
    bit_source bits(42);
    for (int i = 0; i < 1000; ++i) {
        const wide w0 = 1, w1 = wide(std::exp(bits.uniform(-1, 1))), root = std::sqrt(w1 / w0);
        wide most = 0;
        for (int k = 0; k <= 1000; ++k) {
            const wide s = k / 1000.0L;
            most = std::max(most, std::abs(s * w1 / (w0 * (1 - s) + w1 * s) - s));
        }
        const wide stated = std::abs((root - 1) / (root + 1));
        REQUIRE(most <= stated + 1e-15L);
        REQUIRE(most >= 0.999L * stated - 1e-6L);
    }
}

TEST_CASE_TEMPLATE("moving receiver: in one texel within the stated error", T, float, double)
{
    bit_source bits(43);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        receiver_path<T> p = any_path<T>(bits, 1);
        p.x0 = p.x1 = p.y0 = p.y1 = T(0.5), p.w0 = p.w1 = T(1);
        const auto s = exposure_of(p, std::size_t(i), bits);
        moving_receiver<T> state = moving_receiver_begin(p, s.begin, s.end);
        loss all{0, 0};
        for (const auto& r : resolved_list<T>(bits)) {
            state = s.add(state, r);
            const loss one = exact_loss(r, p.depth, p.depth.t0, p.depth.t1, s);
            all = {all.share + one.share, all.error + one.error};
        }
        REQUIRE(std::abs(wide(moving_receiver_end(state)) - all.share) <= all.error);
    }
}

// A product of three lines is what Simpson's rule is exact for, between the shutter's breaks.
TEST_CASE_TEMPLATE("moving receiver: filtered, the integral of shutter and weights within the stated error", T, float,
                   double)
{
    bit_source bits(51);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const receiver_path<T> p = any_path<T>(bits, 4);
        const auto s = exposure_of(p, std::size_t(i), bits);
        moving_receiver<T> state = moving_receiver_begin(p, s.begin, s.end);
        for (T* x : {&state.u0, &state.v0, &state.u1, &state.v1}) *x = T(bits.uniform(0, 1));
        const T a = T(bits.uniform(0, 1)), b = T(bits.uniform(0, 1));
        const depth_time_range<T> r{std::min(a, b), std::max(a, b), T(-2), T(-2), T(9)};
        const wide exposure = wide(s.end) - wide(s.begin);
        wide expected = 0;
        for (int k = 0; k < 8; ++k) {
            const wide from = std::max({wide(r.t0), wide(state.t0), wide(s.begin) + exposure * k / 8});
            const wide to = std::min({wide(r.t1), wide(state.t1), wide(s.begin) + exposure * (k + 1) / 8});
            if (!(from < to)) continue;
            const auto value = [&](wide t) {
                const wide passed = (t - wide(state.t0)) / (wide(state.t1) - wide(state.t0));
                const wide x = std::clamp((t - wide(s.begin)) / exposure, k / 8.0L, (k + 1) / 8.0L - 1e-18L);
                return s.density(x) * (wide(state.u0) + passed * (wide(state.u1) - wide(state.u0))) *
                       (wide(state.v0) + passed * (wide(state.v1) - wide(state.v0)));
            };
            expected += (to - from) / exposure * (value(from) + 4 * value((from + to) / 2) + value(to)) / 6;
        }
        const wide error = 97 * s.largest() * rounding<T> / exposure;
        REQUIRE(std::abs(wide(moving_receiver_end(s.filter(state, r))) - expected) <= error);
    }
}

TEST_CASE_TEMPLATE("moving receiver: at rest it is the static one", T, float, double)
{
    bit_source bits(44);
    for (std::int64_t i = 0; i < effort(5000); ++i) {
        const test_map<T> map = any_map<T>(bits);
        receiver_path<T> p = any_path<T>(bits, side - 2 * margin - 1);
        p.x1 = p.x0, p.y1 = p.y0, p.w1 = p.w0, p.depth.z1 = p.depth.z0;
        const auto s = any_shutter(responses[std::size_t(i) % 3], p.depth.t0, p.depth.t1, bits);
        static_receiver<T> rests = static_receiver_begin(p.depth.z0, p.depth.id, s.begin, s.end);
        const T x = p.x0 / p.w0, y = p.y0 / p.w0;
        for (const auto& r : map.at(std::floor(x), std::floor(y))) rests = s.add(rests, r);
        REQUIRE(nearest(map, p, s) == static_receiver_end(rests)); // bit for bit

        rests = static_receiver_begin(p.depth.z0, p.depth.id, s.begin, s.end);
        const T column = std::floor(x - T(0.5)), row = std::floor(y - T(0.5));
        for (int k = 0; k < 4; ++k) {
            const T weight =
                texel_weight(x - T(0.5) - column, T(k % 2), T(1)) * texel_weight(y - T(0.5) - row, T(k / 2), T(1));
            rests = static_receiver_set_weight(rests, weight);
            for (const auto& r : map.at(column + T(k % 2), row + T(k / 2))) rests = s.add(rests, r);
        }
        // Positions up to 12 have 8 roundings (receiver_path_at), so weights of two axes 16 in all; each of 4 x 7
        // ranges at most 41 of the largest response (moving_receiver_filtered_light) and 32 (static_receiver_end).
        const wide error = (2 * 4 * 8 * 12 + 4 * 7 * 73) * s.largest() * rounding<T>;
        REQUIRE(std::abs(wide(filtered(map, p, s)) - wide(static_receiver_end(rests))) <= error);
    }
}

// Its own range counts by id; its neighbour's, in the same plane, is at the same depth at every time, bit for bit.
TEST_CASE_TEMPLATE("moving receiver: a plane that comes towards the light is lit", T, float, double)
{
    bit_source bits(45);
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const receiver_path<T> p = any_path<T>(bits, side - 2 * margin - 1);
        const auto s = exposure_of(p, std::size_t(i), bits);
        depth_time_range<T> plane = p.depth;
        for (const T id : {p.depth.id, T(7)}) {
            plane.id = id;
            const test_map<T> map = uniform_map(plane);
            REQUIRE(nearest(map, p, s) == 0);
            REQUIRE(filtered(map, p, s, 1 + int(i % 3)) == 0);
        }
        // A plane that is there for longer is the same line by other numbers, each within roundings of its depths: a
        // bias of what range_occluding_part leaves undecided, and of the two roundings of each end, is enough.
        const T a = T(bits.uniform(-1, 1)), b = T(bits.uniform(-1, 1)), bias = T(32 * rounding<T>);
        const depth_time_range<T> all{T(0), T(1), a, b, T(7)};
        receiver_path<T> part = p;
        part.depth = range_clip(all, p.depth.t0, p.depth.t1);
        part.depth.id = T(6);
        part.depth.z0 -= bias, part.depth.z1 -= bias;
        REQUIRE(nearest(uniform_map(all), part, s) == 0);
        REQUIRE(filtered(uniform_map(all), part, s) == 0);
    }
}

TEST_CASE_TEMPLATE("moving receiver: dark all the time where there is something in front all the time", T, float,
                   double)
{
    bit_source bits(46);
    const test_map<T> map = uniform_map(depth_time_range<T>{T(0), T(1), T(-2), T(-1.5), T(7)});
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const receiver_path<T> p = any_path<T>(bits, side - 2 * margin - 1);
        const auto s = any_shutter(responses[std::size_t(i) % 3], p.depth.t0, p.depth.t1, bits);
        // Shares of up to 24 texels, weights of up to 16 that sum to 1, each with the error of one range.
        const wide error = (24 + 1) * 32 * s.largest() * rounding<T> / (wide(s.end) - wide(s.begin));
        REQUIRE(1 - wide(nearest(map, p, s)) <= error);
        REQUIRE(1 - wide(filtered(map, p, s, 1 + int(i % 3))) <= 2 * error);
    }
}

// What the head of moving_receiver.h says: K x K receivers on paths shifted by whole texels, or by halves where K is
// even, have one mean. In perspective their texels are cut at other times, so that the chords are others.
TEST_CASE("percentage-closer filtering is the mean of bilinear look-ups")
{
    using T = double; // ranges that go nearly along with the receiver cost nothing to speak of
    bit_source bits(47);
    for (std::int64_t i = 0; i < effort(500); ++i) {
        const test_map<T> map = any_map<T>(bits);
        receiver_path<T> p = any_path<T>(bits, side - 2 * margin - 2);
        if (p.w0 != p.w1) continue;
        p = receiver_path_shift(p, T(0.75), T(0.75));
        const auto s = exposure_of(p, std::size_t(i), bits);
        const int look_ups = 2 + int(i % 2);
        wide mean = 0;
        for (int k = 0; k < look_ups * look_ups; ++k) {
            const T dx = T(k % look_ups) - T(look_ups - 1) / 2, dy = T(k / look_ups) - T(look_ups - 1) / 2;
            mean += wide(filtered(map, receiver_path_shift(p, dx, dy), s)) / (look_ups * look_ups);
        }
        // Of up to 2 x 24 texels, with 16 lists of 7 ranges each; positions have 8 2^-p of up to 16 texels.
        const wide parts = 48 * 16 * 7, exposure = wide(s.end) - wide(s.begin);
        const wide error = (parts * 97 + 16 * 4 * 8 * 16) * s.largest() * rounding<T> / exposure;
        REQUIRE(std::abs(wide(filtered(map, p, s, look_ups)) - mean) <= error);
    }
}

TEST_CASE_TEMPLATE("moving receiver: hostile ranges, paths and texels leave it in [0, 1], NaN lit", T, float, double)
{
    hostile_source<T> hostile(48);
    bit_source bits(49);
    const T nan = std::numeric_limits<T>::quiet_NaN();
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const auto any = [&] { return bits.chance(0.5) ? hostile.special() : hostile.pattern(); };
        receiver_path<T> p = any_path<T>(bits, 8);
        for (T* x : {&p.x0, &p.y0, &p.w0, &p.x1, &p.y1, &p.w1, &p.depth.t0, &p.depth.t1, &p.depth.z0, &p.depth.z1})
            if (bits.chance(0.2)) *x = any();
        const auto s = any_shutter(responses[std::size_t(i) % 3], T(0), T(1), bits);
        moving_receiver<T> plain = moving_receiver_begin(p, s.begin, s.end), taps = plain;
        texel_sweep<T> sweep = texel_sweep_begin(p);
        bool known = true;
        for (int texel = 0; texel < 4; ++texel, sweep = texel_sweep_next(sweep)) {
            plain = moving_receiver_texel(plain, sweep);
            taps = moving_receiver_tap(taps, sweep, T(texel % 2), T(texel / 2), T(1));
            depth_time_range<T> r{T(0), T(1), T(-2), T(-2), T(7)};
            for (T* x : {&r.t0, &r.t1, &r.z0, &r.z1})
                if (bits.chance(0.2)) *x = any();
            plain = s.add(plain, r), taps = s.filter(taps, r);
            known = known && !std::isnan(p.depth.z0) && !std::isnan(p.depth.z1);
            if (!known) REQUIRE((plain.shadowed == 0 || p.depth.t0 >= p.depth.t1));
        }
        for (const T x : {moving_receiver_end(plain), moving_receiver_end(taps)}) REQUIRE((x >= 0 && x <= 1));
    }
    receiver_path<T> p{{T(0), T(1), nan, nan, T(1)}, T(1.5), T(1.5), T(1), T(3.5), T(1.5), T(1)};
    const auto s = any_shutter(response::box, T(0), T(1), bits);
    CHECK(nearest(uniform_map(depth_time_range<T>{T(0), T(1), T(-1), T(-1), T(7)}), p, s) == 0);
    p.depth.z0 = p.depth.z1 = T(0);
    CHECK(nearest(uniform_map(depth_time_range<T>{T(0), T(1), nan, T(-1), T(7)}), p, s) == 0);
    CHECK(filtered(uniform_map(depth_time_range<T>{T(0), nan, T(-1), T(-1), T(7)}), p, s) == 0);
}

// The bound of sampled_receiver_end: each border, and each range's begin, end and meeting, costs one sample at most.
TEST_CASE("moving receiver: samples, by Palmer's count and by more, tend to the closed form")
{
    using T = double;
    bit_source bits(50);
    for (std::int64_t i = 0; i < effort(1000); ++i) {
        const test_map<T> map = any_map<T>(bits);
        const receiver_path<T> p = any_path<T>(bits, side - 2 * margin - 1);
        const auto s = any_shutter(response::box, p.depth.t0, p.depth.t1, bits);
        if (between_texels(p)) continue;
        const T n = receiver_sample_count(p, 1000) * (i % 2 ? 256 : 1);
        sampled_receiver<T> state = sampled_receiver_begin(n);
        for (T k = 0; k < n; ++k) {
            const T t = receiver_sample_time(p, k, n, bits.uniform(0, 1)), z = range_depth(p.depth, t);
            const texel_position<T> at = receiver_path_at(p, t);
            T most = 0;
            for (const auto& r : map.at(std::floor(at.x), std::floor(at.y)))
                most = std::max(most, range_intensity(r, t, z, p.depth.id, 0));
            state = sampled_receiver_add(state, most);
        }
        T events = 0;
        for_each_texel(p, [&](const texel_sweep<T>& sweep) {
            events += 1;
            for (const auto& r : map.at(sweep.column, sweep.row))
                events += r.t0 < sweep.t_end && sweep.t_begin < r.t1 ? 3 : 0;
        });
        REQUIRE(std::abs(sampled_receiver_end(state) - nearest(map, p, s)) <= events / n + 1e-9);
    }
}
