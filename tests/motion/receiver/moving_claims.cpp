// Claims about moving receivers: static ones are a special case, planes do not shadow themselves, filters are means of
// bilinear look-ups, and any input gives an intensity.
#include "moving_cases.hpp"

#include <doctest/doctest.h>

using namespace gnomon;
using namespace gnomon::test;

TEST_CASE_TEMPLATE("moving receiver: on a path of no length it is the static receiver", T, float, double)
{
    bit_source bits(44);
    for (std::int64_t i = 0; i < effort(5000); ++i) {
        const test_map<T> map = any_map<T>(bits);
        receiver_path<T> p = any_path<T>(bits, side - 2 * margin - 1);
        p.x1 = p.x0, p.y1 = p.y0, p.w1 = p.w0, p.depth.z1 = p.depth.z0;
        const auto s = any_shutter(responses[std::size_t(i) % responses.size()], p.depth.t0, p.depth.t1, bits);
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

// The receiver's own range is ignored by its id; that of a neighbour in the same plane has the same depth at every
// time, bit for bit.
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
        // A plane that lasts longer is the same line by other numbers, each within roundings of its depths. A bias of
        // the error of range_occluding_part and of two roundings for each end suffices.
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

TEST_CASE_TEMPLATE("moving receiver: fully shadowed if a range is in front at all times", T, float, double)
{
    bit_source bits(46);
    const test_map<T> map = uniform_map(depth_time_range<T>{T(0), T(1), T(-2), T(-1.5), T(7)});
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const receiver_path<T> p = any_path<T>(bits, side - 2 * margin - 1);
        const auto s = any_shutter(responses[std::size_t(i) % responses.size()], p.depth.t0, p.depth.t1, bits);
        // Shares of up to 24 texels, weights of up to 16 that sum to 1, each with the error of one range.
        const wide error = (24 + 1) * 32 * s.largest() * rounding<T> / (wide(s.end) - wide(s.begin));
        REQUIRE(1 - wide(nearest(map, p, s)) <= error);
        REQUIRE(1 - wide(filtered(map, p, s, 1 + int(i % 3))) <= 2 * error);
    }
}

// The mean of K x K receivers on paths shifted by whole texels, or by halves where K is even, as the first comment of
// moving_receiver.h states. Not in perspective, where shifted paths enter texels at other times, with other chords.
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

TEST_CASE_TEMPLATE("moving receiver: hostile ranges, paths and texels give an intensity, and NaN is lit", T, float,
                   double)
{
    hostile_source<T> hostile(48);
    bit_source bits(49);
    const T nan = std::numeric_limits<T>::quiet_NaN();
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const auto any = [&] { return bits.chance(0.5) ? hostile.special() : hostile.pattern(); };
        receiver_path<T> p = any_path<T>(bits, 8);
        for (T* x : {&p.x0, &p.y0, &p.w0, &p.x1, &p.y1, &p.w1, &p.depth.t0, &p.depth.t1, &p.depth.z0, &p.depth.z1})
            if (bits.chance(0.2)) *x = any();
        const auto s = any_shutter(responses[std::size_t(i) % responses.size()], T(0), T(1), bits);
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
