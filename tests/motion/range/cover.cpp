// Covers of texels: by fragments and by ranges, against who is in front at many times; ranges that may be left out,
// against the shadow test on the whole list.
#include "motion/triangle/coverage_check.hpp"
#include "support/climber.hpp"
#include "support/effort.hpp"
#include "support/moving_triangles.hpp"
#include "support/prisms.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> using list = std::vector<depth_time_range<T>>;
template <class T> using fragments = std::vector<timed_fragment<T>>;

/// Surfaces of one or two ranges each, which do not overlap in time; every other time of few depths, many of them
/// equal.
template <class T> list<T> any_list(bit_source& bits)
{
    list<T> ranges;
    const bool coarse = bits.chance(0.5);
    const auto depth = [&](double centre) {
        return T(coarse ? std::round(4 * centre) / 4 : std::clamp(centre + bits.uniform(-0.2, 0.2), -1.0, 1.0));
    };
    const std::size_t surfaces = 1 + bits.below(5);
    for (std::size_t id = 0; id < surfaces; ++id) {
        const double centre = bits.uniform(-1, 1);
        std::array<double, 4> t{0, 1, 2, 2};
        if (bits.chance(0.6)) {
            for (double& x : t) x = bits.chance(0.3) ? double(bits.below(5)) / 4 : bits.uniform(0, 1);
            std::sort(t.begin(), t.end());
            if (bits.chance(0.3)) t[0] = 0, t[3] = 1; // away in between
        }
        ranges.push_back({T(t[0]), T(t[1]), depth(centre), depth(centre), T(id)});
        if (t[1] < t[2] && t[3] <= 1) ranges.push_back({T(t[2]), T(t[3]), depth(centre), depth(centre), T(id)});
    }
    return ranges;
}

template <class T> fragments<T> ends_of(const list<T>& ranges)
{
    fragments<T> all;
    for (const auto& r : ranges) all.push_back({r.t0, r.z0, r.id}), all.push_back({r.t1, r.z1, r.id});
    return all;
}

template <class T> depth_time_range<T> cover_of(const list<T>& ranges)
{
    range_cover<T> state = range_cover_begin(T(1));
    for (const auto& r : ranges) state = range_cover_add(state, r);
    return range_cover_end(state);
}

template <class T> depth_time_range<T> cover_of(const fragments<T>& all)
{
    timed_fragment<T> nearest = nearest_fragment_begin(T(1));
    for (const auto& f : all) nearest = nearest_fragment_add(nearest, f);
    fragment_cover<T> state = fragment_cover_begin(nearest);
    for (const auto& f : all) state = fragment_cover_add(state, f);
    return fragment_cover_end(state);
}

/// What the rules say of a list: the cover's id, or -1.
template <class T> T rules_on(const list<T>& ranges)
{
    T id = -1;
    for (std::size_t k = 0; k < ranges.size() && id < 0; ++k) {
        const auto& r = ranges[k];
        if (r.t0 > 0 || r.t1 < 1 || r.z0 > 1 || r.z1 > 1) continue;
        id = r.id;
        for (std::size_t j = 0; j < ranges.size(); ++j)
            if (j != k && std::min(ranges[j].z0, ranges[j].z1) < std::max(r.z0, r.z1)) id = -1;
    }
    return id;
}

/// The linear depth of a range at a time, in extended precision.
template <class T> exact depth_at(const depth_time_range<T>& r, exact t)
{
    const exact t0 = exact(r.t0), t1 = exact(r.t1), z0 = exact(r.z0), z1 = exact(r.z1);
    return t0 == t1 ? std::min(z0, z1) : z0 + (t - t0) / (t1 - t0) * (z1 - z0);
}

/// Whether a surface is there at 257 times and at the ends of all ranges, and nothing else in front of it.
template <class T> bool front_most(const list<T>& ranges, T id)
{
    std::vector<exact> times;
    for (int i = 0; i <= 256; ++i) times.push_back(exact(i) / 256);
    for (const auto& r : ranges) times.push_back(exact(r.t0)), times.push_back(exact(r.t1));
    return std::all_of(times.begin(), times.end(), [&](exact t) {
        exact own = 2, others = 2;
        for (const auto& r : ranges)
            if (exact(r.t0) <= t && t <= exact(r.t1)) {
                exact& z = r.id == id ? own : others;
                z = std::min(z, depth_at(r, t));
            }
        return own <= 1 && own <= others + 1e-15L;
    });
}

template <class T> bool equal(const depth_time_range<T>& a, const depth_time_range<T>& b)
{
    return a.t0 == b.t0 && a.t1 == b.t1 && a.z0 == b.z0 && a.z1 == b.z1 && a.id == b.id;
}

template <class Item> std::vector<Item> shuffled(std::vector<Item> items, bit_source& bits)
{
    for (std::size_t k = items.size(); k > 1; --k) std::swap(items[k - 1], items[bits.below(k)]);
    return items;
}

template <class T> T shadow(const list<T>& ranges, T t, T z, T id, T bias)
{
    T most = 0;
    for (const auto& r : ranges) most = std::max(most, range_intensity(r, t, z, id, bias));
    return most;
}

} // namespace

TEST_CASE_TEMPLATE("a cover is there and in front at all times; from ranges wherever from fragments, in any order", T,
                   float, double)
{
    bit_source bits(1);
    std::int64_t by_fragments = 0, by_ranges = 0, missed = 0;
    for (std::int64_t i = 0; i < effort(60'000); ++i) {
        const list<T> ranges = any_list<T>(bits);
        const fragments<T> all = ends_of(ranges);
        const auto from_ranges = cover_of(ranges), from_fragments = cover_of(all);
        REQUIRE(equal(from_ranges, cover_of(shuffled(ranges, bits))));
        REQUIRE(equal(from_fragments, cover_of(shuffled(all, bits))));
        for (const auto& cover : {from_ranges, from_fragments}) {
            if (cover.id < 0) {
                REQUIRE(cover.id == -1);
                REQUIRE(cover.t0 > cover.t1);
                continue;
            }
            REQUIRE((cover.t0 == 0 && cover.t1 == 1));
            REQUIRE(front_most(ranges, cover.id));
        }
        REQUIRE((rules_on(ranges) >= 0) == (from_ranges.id >= 0));
        if (from_fragments.id >= 0) {
            REQUIRE(from_ranges.id >= 0);
            const T farthest = std::max(from_fragments.z0, from_fragments.z1);
            REQUIRE(std::max(from_ranges.z0, from_ranges.z1) <= farthest);
        }
        by_fragments += from_fragments.id >= 0;
        by_ranges += from_ranges.id >= 0;
        for (T id = 0; id < 5 && from_ranges.id < 0; ++id)
            if (front_most(ranges, id)) {
                ++missed;
                break;
            }
    }
    CHECK(5 * by_ranges > effort(60'000));
    CHECK(by_fragments <= by_ranges);
    CHECK(by_fragments > 0);
    MESSAGE("covered by ranges " << by_ranges << ", by fragments " << by_fragments
                                 << "; in front at all times, but for a moment not of the cover's farther end "
                                 << missed);
}

// The same seen from geometry: triangles carried past a sample, by prisms and by exact times, and who of them is in
// front by the static triangle at each time. Depths of T within 1e-5 of one another are not told apart.
TEST_CASE("covers of carried triangles, from prisms and from covered times")
{
    bit_source bits(2);
    std::int64_t from_prisms = 0, from_times = 0;
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        std::array<moving_triangle<double>, 4> m;
        fragments<double> all;
        list<double> ranges;
        for (std::size_t k = 0; k < 4; ++k) {
            std::array<moving_vertex<double>, 3> v;
            const double size = bits.chance(0.5) ? 4 : 1, x = bits.uniform(-1, 1), y = bits.uniform(-1, 1);
            const double centre = bits.uniform(-0.8, 0.8), z = bits.uniform(-0.1, 0.1);
            for (auto& p : v) {
                p = {size * bits.uniform(-1, 1),
                     size * bits.uniform(-1, 1),
                     centre + bits.uniform(-0.1, 0.1),
                     1,
                     0,
                     0,
                     0,
                     1};
                p.x1 = p.x0 + x, p.y1 = p.y0 + y, p.z1 = p.z0 + z;
            }
            m[k] = {v[0], v[1], v[2]};
            const prism<double> p = prism_make(m[k], 1.0);
            for (int j = 0; j < 14; ++j) {
                const auto f = prism_fragment_at(prism_triangle_make(p, double(j)), 0.0, 0.0, 1.0);
                if (f.covered > 0) all.push_back({f.time, f.depth, double(k)});
            }
            const moving_edges<double> e = moving_triangle_edges(m[k], 0.0, 0.0);
            for (const double facing : {1.0, -1.0}) {
                const auto c = moving_coverage(e, facing);
                for (std::size_t j = 0; j < std::size_t(c.count); ++j) {
                    const interval t = intervals_of(c)[j];
                    ranges.push_back(range_between(t.begin, moving_depth_at(m[k], e, t.begin, 1), t.end,
                                                   moving_depth_at(m[k], e, t.end, 1), double(k)));
                }
            }
        }
        const auto by_prisms = cover_of(all), by_times = cover_of(ranges);
        from_prisms += by_prisms.id >= 0;
        from_times += by_times.id >= 0;
        for (const auto& cover : {by_prisms, by_times})
            for (int j = 0; j <= 64 && cover.id >= 0; ++j) {
                const double t = j / 64.0;
                double own = 2, others = 2;
                for (std::size_t k = 0; k < 4; ++k) {
                    const moving_edges<double> e = moving_triangle_edges(m[k], 0.0, 0.0);
                    const double a = moving_edge_at(e.a, t), b = moving_edge_at(e.b, t), c = moving_edge_at(e.c, t);
                    const bool there = (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
                    double& z = double(k) == cover.id ? own : others;
                    if (there) z = std::min(z, moving_depth_at(m[k], e, t, 1));
                }
                REQUIRE(own <= others + 1e-9);
                REQUIRE(own <= 1);
            }
    }
    CHECK(from_prisms > 0);
    CHECK(from_times >= from_prisms);
}

TEST_CASE_TEMPLATE("leaving out what the cover hides changes no shadow test, bit for bit", T, float, double)
{
    bit_source bits(3);
    std::int64_t covered = 0, left_out = 0, of = 0, shadowed = 0, decided = 0, asked = 0;
    for (std::int64_t i = 0; i < effort(40'000); ++i) {
        list<T> ranges = any_list<T>(bits);
        const auto cover = cover_of(ranges);
        list<T> kept;
        for (const auto& r : ranges)
            if (range_cover_occludes(cover, r) == 0) kept.push_back(r);
        if (cover.id < 0) REQUIRE(kept.size() == ranges.size());
        else REQUIRE(std::any_of(kept.begin(), kept.end(), [&](const auto& r) { return equal(r, cover); }));
        covered += cover.id >= 0;
        of += std::int64_t(ranges.size());
        left_out += std::int64_t(ranges.size() - kept.size());
        for (int j = 0; j < 20; ++j) {
            const T t = T(bits.chance(0.3) ? double(bits.below(5)) / 4 : bits.uniform(0, 1));
            const T id = T(bits.below(7)) - 1, bias = T(bits.chance(0.5) ? 0 : bits.uniform(0, 0.01));
            const auto& near_one = ranges[bits.below(ranges.size())];
            T z = T(bits.uniform(-1.1, 1.1));
            if (bits.chance(0.5)) z = range_depth(near_one, t) + bias;
            if (bits.chance(0.3)) z = std::nextafter(z, T(2));
            // The cover's own surface is where the cover is, and no further.
            if (id == cover.id) z = std::min(z, range_depth(cover, t));
            const T whole = shadow(ranges, t, z, id, bias);
            REQUIRE(shadow(kept, t, z, id, bias) == whole);
            ++asked;
            shadowed += whole > 0;
            const auto answer = range_cover_answer(cover, t, z, id, bias);
            if (answer.decided > 0) REQUIRE(answer.intensity == whole);
            else REQUIRE(answer.intensity == 0);
            if (cover.id < 0) REQUIRE(answer.decided == 0);
            decided += answer.decided > 0;
        }
    }
    CHECK(5 * covered > effort(40'000));
    CHECK(5 * left_out > of);
    CHECK(5 * shadowed > asked);
    CHECK(10 * decided > 3 * asked);
}

// Just behind what touches the cover's farther end, by what range_depth makes of it: the list's answer is dark.
TEST_CASE_TEMPLATE("range_cover_answer: what it decides is the answer of the list, bit for bit", T, float, double)
{
    const summit found = climb(10, 200'000, 1, [](const std::vector<double>& p) {
        const T far_depth = T(1.5 * p[0] - 1), t = T(p[1]), bias = T(std::max(p[2] - 0.5, 0.0));
        const T near_depth = far_depth - T(p[3] * p[3] * 0x1p-10);
        const depth_time_range<T> cover{0, 1, p[4] < 0.5 ? far_depth : near_depth, p[4] < 0.5 ? near_depth : far_depth,
                                        0};
        const auto beside = [&](double x) {
            return far_depth + (x < 0.5 ? T(0) : T(std::exp2(-30 * (2 * x - 1)) / 4));
        };
        const depth_time_range<T> r =
            range_between(T(p[5]), beside(p[6]), T(p[7]), beside(p[8]), T(1)); // not in front of it
        const T z = std::nextafter(range_depth(r, t) + bias, T(2)), id = T(p[9] < 0.5 ? 2 : 0);
        const auto answer = range_cover_answer(cover_of<T>({cover, r}), t, z, id, bias);
        const T whole = shadow<T>({cover, r}, t, z, id, bias);
        if (answer.decided > 0 && answer.intensity != whole) return 1.0;
        return whole > 0 ? -double(z - (far_depth + bias)) : -9.0; // to where it is decided lit
    });
    CHECK(found.score <= 0x1p-20);
    CHECK(found.score > -0x1p-18);
}

// Ranges that are all but level, a few roundings behind a cover that is, and receivers just behind them. Now and then
// range_depth puts the range in front: what the margin is for.
TEST_CASE_TEMPLATE("a range that rounding puts in front of the cover is not left out", T, float, double)
{
    bit_source bits(6);
    std::int64_t reversed = 0; // rare, so the count does not depend on effort
    for (std::int64_t i = 0; i < 1'000'000; ++i) {
        const T far_depth = T(bits.uniform(-1, 1)), begin = T(bits.uniform(0, 0.7)), end = begin + T(0.25);
        T z = far_depth;
        for (std::size_t n = bits.below(4); n > 0; --n) z = std::nextafter(z, T(2));
        const depth_time_range<T> cover{0, 1, far_depth, std::nextafter(far_depth, T(-2)), 0};
        const depth_time_range<T> r{begin, end, z, std::nextafter(z, T(2)), 1};
        const T t = begin + T(bits.uniform(0, 0.25)), behind = std::nextafter(range_depth(r, t), T(2));
        const T whole = shadow<T>({cover, r}, t, behind, T(2), T(0));
        const bool kept = range_cover_occludes(cover, r) == 0;
        REQUIRE(shadow<T>(kept ? list<T>{cover, r} : list<T>{cover}, t, behind, T(2), T(0)) == whole);
        reversed += z > far_depth && range_depth(r, t) < range_depth(cover, t);
    }
    CHECK(reversed > 0);
}

TEST_CASE("the passes of the paper, one by one")
{
    const auto cover = [](const fragments<double>& all) { return cover_of(all); };
    const timed_fragment<double> open{0, -0.5, 3}, close{1, -0.25, 3};
    CHECK(equal(cover({open, close}), {0, 1, -0.5, -0.25, 3}));
    CHECK(equal(cover({close, open}), {0, 1, -0.5, -0.25, 3}));
    CHECK(cover({}).id == -1);
    CHECK(cover({open}).id == -1);
    CHECK(cover({open, {0.75, -0.25, 3}}).id == -1);                        // leaves early
    CHECK(cover({open, close, {0.5, 0, 4}}).id == 3);                       // something behind
    CHECK(cover({open, close, {0.5, -0.25, 4}}).id == 3);                   // LESS
    CHECK(cover({open, close, {0.5, -0.3, 4}}).id == -1);                   // nearer than the farther end
    CHECK(cover({open, close, {0.5, -0.75, 4}}).id == -1);                  // the nearest at a moment
    CHECK(cover({open, close, {0.25, -0.5, 3}, {0.75, -0.5, 3}}).id == -1); // left and returned: the paper covers it
    CHECK(cover({open, close, {0.5, 0, -1}}).id == 3);                      // no triangle

    const depth_time_range<double> c{0, 1, -0.5, -0.25, 3};
    CHECK(range_cover_answer(c, 0.5, 0.0, 4.0, 0.0).intensity == 1);
    CHECK(range_cover_answer(c, 0.5, 0.0, 3.0, 0.0).intensity == 0);
    CHECK(range_cover_answer(c, 0.5, 0.0, 3.0, 0.0).decided == 0); // where its surface is not
    CHECK(range_cover_answer(c, 0.5, -0.3, 3.0, 0.0).decided == 1);
    CHECK(range_cover_answer(c, 0.5, -0.45, 4.0, 0.0).intensity == 0); // in front of it
    CHECK(range_cover_answer(range_empty(-1.0), 0.5, 0.0, 4.0, 0.0).decided == 0);
    CHECK(range_cover_occludes(c, {0.5, 0.75, -0.25, 0, 4}) == 0);
    CHECK(range_cover_occludes(c, {0.5, 0.75, -0.24, 0, 4}) == 1);
    CHECK(range_cover_occludes(c, {0.75, 0.5, -1, -1, 4}) == 1); // empty
    CHECK(range_cover_occludes(range_empty(-1.0), {0.5, 0.75, 1, 1, 4}) == 0);
}

TEST_CASE_TEMPLATE("anything in: a cover within the limits or none, and NaN hides nothing", T, float, double)
{
    hostile_source<T> hostile(4);
    bit_source bits(5);
    const T nan = std::numeric_limits<T>::quiet_NaN();
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        list<T> ranges = any_list<T>(bits);
        const auto clean = cover_of(ranges);
        list<T> dirty = ranges;
        depth_time_range<T> bad = ranges[0];
        (bits.chance(0.5) ? bad.z0 : bits.chance(0.5) ? bad.z1 : bits.chance(0.5) ? bad.t0 : bad.t1) = nan;
        dirty.insert(dirty.begin() + std::ptrdiff_t(bits.below(dirty.size() + 1)), bad);
        REQUIRE(equal(cover_of(dirty), clean));
        REQUIRE(range_cover_occludes(clean, bad) == 1);
        fragments<T> all = ends_of(ranges);
        const auto clean_fragments = cover_of(all);
        timed_fragment<T> worse = all[0];
        (bits.chance(0.3) ? worse.z : bits.chance(0.5) ? worse.t : worse.id) = nan;
        all.insert(all.begin() + std::ptrdiff_t(bits.below(all.size() + 1)), worse);
        REQUIRE(equal(cover_of(all), clean_fragments));

        const bool patterns = bits.chance(0.5);
        const auto any = [&] { return patterns ? hostile.pattern() : hostile.special(); };
        for (auto& r : dirty)
            if (bits.chance(0.7)) r = {any(), any(), any(), any(), any()};
        for (auto& f : all)
            if (bits.chance(0.7)) f = {any(), any(), any()};
        const auto cover = cover_of(dirty), cover_fragments = cover_of(all);
        REQUIRE(equal(cover, cover_of(shuffled(dirty, bits))));
        REQUIRE(equal(cover_fragments, cover_of(shuffled(all, bits))));
        for (const auto& c : {cover, cover_fragments}) {
            REQUIRE((c.id >= 0 || c.id == -1));
            REQUIRE((std::abs(c.z0) <= 1 && std::abs(c.z1) <= 1));
            const auto answer = range_cover_answer(c, any(), any(), any(), any());
            REQUIRE((answer.intensity == 0 || answer.intensity == 1));
            REQUIRE((answer.decided == 0 || answer.decided == 1));
        }
    }
}
