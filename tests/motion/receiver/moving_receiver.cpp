// Moving receivers over maps of resolved lists: the closed form against 4096 times and against extended precision.
#include "moving_cases.hpp"

#include <doctest/doctest.h>

using namespace gnomon;
using namespace gnomon::test;

TEST_CASE_TEMPLATE("moving receiver: the closed form is the mean over 4096 times", T, float, double)
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

// In a cell weights are linear in time, positions in perspective are not: u(s) = s w1 / (w0 (1 - s) + w1 s) deviates
// from s by at most (sqrt(r) - 1) / (sqrt(r) + 1), r = w1 / w0.
TEST_CASE("moving receiver: in perspective weights deviate from lines by the stated bound, which is attained")
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

TEST_CASE_TEMPLATE("moving receiver: in one texel, within the stated error", T, float, double)
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

// Simpson's rule is exact for a product of three lines, between the ends of the shutter's parts.
TEST_CASE_TEMPLATE("moving receiver: with filtering, the integral of shutter and weights, within the stated error", T,
                   float, double)
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

// The bound of sampled_receiver_end: each border, and each begin, end and crossing of a range, costs at most one
// sample.
TEST_CASE("moving receiver: samples, as many as Palmer's or more, tend to the closed form")
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
