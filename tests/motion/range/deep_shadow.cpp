// Deep shadow maps: compression keeps its tolerance, one occluder gives the static receiver, and the limit of samples is
// that of resolved ranges.
#include "../receiver/receiver_cases.hpp"
#include "support/climber.hpp"

#include <gnomon/motion/range/deep_shadow.h>

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <set>
#include <utility>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// A vertex of a transmittance over depth; two at one depth are a step.
template <class T> struct vertex {
    T z, v;
};
template <class T> using polyline = std::vector<vertex<T>>;

template <class T> std::vector<deep_layer<T>> compressed(const polyline<T>& line, T tolerance)
{
    std::vector<deep_layer<T>> layers;
    const auto keep = [&](const deep_layer<T>& l) {
        if (l.opacity > 0) layers.push_back(l);
    };
    deep_window<T> window = deep_window_begin(tolerance);
    for (const auto& p : line) keep((window = deep_window_add(window, p.z, p.v)).layer);
    keep(deep_window_end(window));
    return layers;
}

template <class T> T transmittance(const std::vector<deep_layer<T>>& layers, T z)
{
    T t = 1;
    for (const auto& l : layers) t = deep_shadow_add(t, l, z);
    return t;
}

/// The polyline just before depth z and just behind it, by its definition. It is level outside of its vertices.
template <class T> std::array<wide, 2> sides_of(const polyline<T>& line, T z)
{
    std::array<wide, 2> sides{1, 1};
    for (std::size_t i = 0; i < line.size(); ++i) {
        const auto& p = line[i];
        if (p.z < z) {
            sides = {wide(p.v), wide(p.v)};
            if (i + 1 < line.size() && line[i + 1].z > z) {
                const auto& n = line[i + 1];
                const wide passed = (wide(z) - wide(p.z)) / (wide(n.z) - wide(p.z));
                const wide v = wide(p.v) + passed * (wide(n.v) - wide(p.v));
                sides = {v, v};
            }
        } else if (p.z == z) {
            if (i == 0 || line[i - 1].z < z) sides[0] = wide(p.v);
            sides[1] = wide(p.v);
        }
    }
    return sides;
}

/// Distance of the layers from the polyline, beyond the tolerance, in roundings for each layer.
template <class T> double excess_at(const std::vector<deep_layer<T>>& layers, const polyline<T>& line, T z, T tolerance)
{
    const auto [before, behind] = sides_of(line, z);
    const wide v = wide(transmittance(layers, z));
    const wide beyond = std::max(v - before, behind - v) - wide(tolerance);
    return double(beyond / rounding<T>) / double(std::max<std::size_t>(layers.size(), 1));
}

template <class T> double excess(const std::vector<deep_layer<T>>& layers, const polyline<T>& line, T tolerance)
{
    double most = -HUGE_VAL;
    for (std::size_t i = 0; i < line.size(); ++i) {
        most = std::max(most, excess_at(layers, line, line[i].z, tolerance));
        if (i + 1 < line.size())
            most = std::max(most, excess_at(layers, line, (line[i].z + line[i + 1].z) / 2, tolerance));
    }
    return most;
}

/// Vertices from numbers in [0, 1], three for each: a distance, which may be none, a fall, which may be none, and
/// whether distances are short.
template <class T> polyline<T> polyline_of(const std::vector<double>& place, std::size_t from)
{
    polyline<T> line{{T(-1), T(1)}};
    T z = T(-1), v = T(1);
    for (std::size_t i = from; i + 2 < place.size(); i += 3) {
        if (place[i] > 0.4) z += T((place[i] - 0.4) * (place[i + 2] > 0.5 ? 0.1 : 0.001));
        if (place[i + 1] > 0.3) v = std::max(v - T((place[i + 1] - 0.3) * (place[i + 2] > 0.8 ? 0.5 : 0.05)), T(0));
        line.push_back({z, v});
    }
    return line;
}

template <class T> void climb_tolerance()
{
    const summit found = climb(1 + 3 * 24, 400'000, 3, [](const std::vector<double>& place) {
        const T tolerance = T(place[0] < 0.2 ? 0 : 0.2 * place[0] * place[0]);
        const polyline<T> line = polyline_of<T>(place, 1);
        return excess(compressed(line, tolerance), line, tolerance);
    });
    CHECK_MESSAGE(found.score <= 4, found.score);
    CHECK_MESSAGE(found.score > 0.5, found.score);
}

/// The polyline of depths of samples.
template <class T> polyline<T> polyline_of_samples(std::vector<T> depths)
{
    std::sort(depths.begin(), depths.end());
    polyline<T> line;
    const T n = T(depths.size());
    for (std::size_t k = 0; k < depths.size(); ++k) {
        line.push_back({depths[k], T(1) - T(k) / n});
        line.push_back({depths[k], T(1) - T(k + 1) / n});
    }
    return line;
}

/// The polyline of a resolved list: 1 minus the time for which it is in front.
template <class T> polyline<T> polyline_of_ranges(const std::vector<depth_time_range<T>>& list)
{
    std::vector<T> depths;
    for (const auto& r : list) depths.insert(depths.end(), {r.z0, r.z1});
    std::sort(depths.begin(), depths.end());
    polyline<T> line;
    for (const T z : depths) {
        T before = 1, level = 0;
        for (const auto& r : list) {
            before -= deep_shadow_share(r, z);
            if (r.z0 == z && r.z1 == z) level += range_duration(r);
        }
        line.insert(line.end(), {{z, before}, {z, before - level}});
    }
    return line;
}

template <class T> T shadow_at(const std::vector<deep_layer<T>>& layers, T z)
{
    return deep_shadow_end(transmittance(layers, z));
}

/// The intensity of a static receiver whose own surface is in no list.
template <class T> T static_shadow(const std::vector<depth_time_range<T>>& list, T z)
{
    static_receiver<T> state = static_receiver_begin(z, literal<T>(range_nothing), T(0), T(1));
    for (const auto& r : list) state = add_range(state, r, box_shutter{});
    return static_receiver_end(state);
}

} // namespace

TEST_CASE("deep shadows: any polyline within the tolerance, climbed")
{
    climb_tolerance<float>();
    climb_tolerance<double>();
}

TEST_CASE("deep shadows: random opacity functions within the tolerance")
{
    CHECK(rc::check("depths of samples, in few places or in many", [] {
        const auto codes = *rc::gen::container<std::vector<int>>(*rc::gen::inRange<std::size_t>(1, 129),
                                                                 rc::gen::inRange(0, *rc::gen::element(3, 40, 9999)));
        const float tolerance = float(*rc::gen::element(0, 1, 4, 16, 64)) / 256;
        std::vector<float> depths;
        for (const int c : codes) depths.push_back(float(c) / 5000 - 1);
        const auto line = polyline_of_samples(depths);
        const auto layers = compressed(line, tolerance);
        RC_ASSERT(excess(layers, line, tolerance) <= 4);
        RC_ASSERT(layers.size() <= std::set(depths.begin(), depths.end()).size());
        if (tolerance == 0) RC_ASSERT(layers.size() == std::set(depths.begin(), depths.end()).size());
        float last = 0;
        for (float z = -1; z <= 1; z += 1.f / 64) {
            const float shadow = shadow_at(layers, z);
            RC_ASSERT(last <= shadow && shadow <= 1.f);
            last = shadow;
        }
    }));
}

TEST_CASE_TEMPLATE("deep shadows: layers multiply in any order, within the stated error", T, float, double)
{
    bit_source bits(21);
    double worst = 0;
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        std::vector<deep_layer<T>> layers;
        wide exact = 1;
        const T z = T(bits.uniform(-1, 1));
        for (std::size_t n = 1 + bits.below(6); n > 0; --n) {
            const T z0 = T(bits.uniform(-1, 1));
            layers.push_back({z0, bits.chance(0.3) ? z0 : z0 + T(bits.uniform(0, 0.5)), T(bits.uniform(0, 1))});
            const deep_layer<T>& l = layers.back();
            const wide passed = z <= l.z0 ? 0 : z >= l.z1 ? 1 : (wide(z) - wide(l.z0)) / (wide(l.z1) - wide(l.z0));
            exact *= 1 - wide(l.opacity) * passed;
        }
        const double rounded = double(rounding<T>) * double(layers.size());
        const wide forth = wide(transmittance(layers, z));
        std::reverse(layers.begin(), layers.end());
        worst = std::max({worst, double(std::abs(forth - exact)) / rounded,
                          double(std::abs(wide(transmittance(layers, z)) - exact)) / rounded});
    }
    CHECK_MESSAGE(worst <= 4, worst);
}

TEST_CASE_TEMPLATE("deep shadows: the share of a range in front of a depth, within the stated error", T, float, double)
{
    bit_source bits(22);
    double worst = 0;
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const T a = T(bits.uniform(0, 1)), b = T(bits.uniform(0, 1)), near = T(bits.uniform(-1, 1));
        const T far = bits.chance(0.2) ? near : near + T(std::exp2(bits.uniform(-20, 0)));
        const bool falls = bits.chance(0.5);
        const depth_time_range<T> r{std::min(a, b), std::max(a, b), falls ? far : near, falls ? near : far, T(1)};
        const T z = bits.chance(0.5) ? near + T(bits.uniform(0, 1)) * (far - near) : T(bits.uniform(-1, 1));
        const wide passed = z <= near ? 0 : z >= far ? 1 : (wide(z) - wide(near)) / (wide(far) - wide(near));
        const wide duration = wide(r.t1) - wide(r.t0);
        const double error = double(std::abs(wide(deep_shadow_share(r, z)) - passed * duration) / rounding<T>);
        if (duration > 0) worst = std::max(worst, error / double(duration));
    }
    CHECK_MESSAGE(worst <= 4, worst);
}

TEST_CASE_TEMPLATE("deep shadows: one occluder gives the static receiver within one sample", T, float, double)
{
    bit_source bits(23);
    for (const std::size_t samples : {4u, 16u, 128u, 1024u}) {
        double worst = 0;
        for (std::int64_t i = 0; i < effort(20'000) * 4 / std::int64_t(samples) + 40; ++i) {
            const T a = T(bits.uniform(0, 1)), b = T(bits.uniform(0, 1));
            const depth_time_range<T> r{std::min(a, b), std::max(a, b), T(bits.uniform(-0.9, 0.5)),
                                        T(bits.uniform(-0.9, 0.5)), T(1)};
            const T jitter = T(bits.uniform(0, 1)); // of all strata, so that times are evenly apart
            std::vector<T> depths;
            for (std::size_t k = 0; k < samples; ++k) {
                const T t = (T(k) + jitter) / T(samples);
                depths.push_back(r.t0 <= t && t < r.t1 ? range_depth(r, t) : T(1));
            }
            const auto layers = compressed(polyline_of_samples(depths), T(0));
            for (const T z : {r.z0, r.z1, (r.z0 + r.z1) / 2, T(bits.uniform(-1, 1)), T(1)})
                worst = std::max(worst, std::abs(double(shadow_at(layers, z)) - double(static_shadow<T>({r}, z))));
        }
        CHECK(worst * double(samples) <= 1 + 1e-3);
        CHECK(worst * double(samples) > 0.5);
    }
}

TEST_CASE_TEMPLATE("deep shadows: layers of a resolved list are the static receiver that samples converge to", T, float,
                   double)
{
    bit_source bits(24);
    for (std::int64_t i = 0; i < effort(2'000); ++i) {
        const auto list = resolved_list<T>(bits);
        const auto line = polyline_of_ranges(list);
        const T tolerance = T(bits.chance(0.5) ? 0 : bits.uniform(0, 0.1));
        const auto layers = compressed(line, tolerance);
        CHECK(layers.size() <= 2 * 2 * list.size());
        for (int k = 0; k < 20; ++k) {
            const T z = T(bits.uniform(-1, 1));
            CHECK(std::abs(double(shadow_at(layers, z)) - double(static_shadow(list, z))) <=
                  double(tolerance) + 400 * double(rounding<T>));
        }
    }
}

TEST_CASE("deep shadows: even motion in depth is one layer, nothing is none, and what is unknown is left out")
{
    std::vector<float> depths;
    for (int k = 0; k < 128; ++k) depths.push_back(-0.5f + float(k) / 512);
    CHECK(compressed(polyline_of_samples(depths), 0.f).size() == 128);
    const auto layers = compressed(polyline_of_samples(depths), 1.5f / 128);
    REQUIRE(layers.size() <= 2);
    CHECK(layers[0].z0 == -0.5f);
    CHECK(shadow_at(layers, -0.5f) == 0);
    CHECK(compressed<float>({}, 0).empty());
    CHECK(compressed<float>({{0, 1}, {1, 1}}, 0).empty());

    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const auto known = compressed<float>({{0, 1}, {0, 0.5f}, {0.5f, 0.5f}, {0.5f, 0}}, 0);
    const auto with_unknown =
        compressed<float>({{0, 1}, {nan, 0}, {0, 0.5f}, {0.25f, nan}, {0.5f, 0.5f}, {0.5f, 0}, {0x1p61f, 0}}, 0);
    REQUIRE(known.size() == 2);
    REQUIRE(with_unknown.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(known[i].z0 == with_unknown[i].z0);
        CHECK(known[i].z1 == with_unknown[i].z1);
        CHECK(known[i].opacity == with_unknown[i].opacity);
    }
    CHECK(deep_shadow_end(deep_shadow_add(1.f, {nan, 0.f, 1.f}, 0.5f)) == 0);
    CHECK(deep_shadow_share({0.f, 1.f, nan, 0.f, 1.f}, 0.5f) == 0);
}
