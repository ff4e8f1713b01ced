// Clusters of samples by depth: bins and cuts against integers and sorted runs, level surfaces without a cut, ties, the
// background, and samples of NaN.
#include "layer_cases.hpp"
#include "support/climber.hpp"
#include "support/effort.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cstdint>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> constexpr T no_cut = T(layer_no_cut);

/// Depths in up to six clumps of a window.
template <class T> std::vector<T> clumped_depths(bit_source& bits)
{
    std::vector<T> z;
    const double scale = std::exp2(bits.uniform(-13, 1)), offset = bits.uniform(-1, 1) * (2 - scale);
    for (std::size_t clumps = 1 + bits.below(6); clumps > 0; --clumps) {
        const double at = bits.uniform(-1, 1), width = std::exp2(bits.uniform(-12, -1));
        for (std::size_t n = 1 + bits.below(6); n > 0; --n)
            z.push_back(T(std::clamp(offset + scale * (at + width * bits.uniform(-1, 1)), -2.0, 2.0)));
    }
    return z;
}

/// The centres of the longest interior runs of empty bins, at most count, nearer ones first among equals; in order of bins.
std::vector<double> centres_of_runs(const std::array<bool, 64>& bins, std::size_t count)
{
    struct run {
        std::size_t begin, length;
    };
    std::vector<run> runs;
    std::size_t last = 64;
    for (std::size_t i = 0; i < 64; ++i) {
        if (!bins[i]) continue;
        if (last < i && i - last > 1) runs.push_back({last + 1, i - last - 1});
        last = i;
    }
    std::stable_sort(runs.begin(), runs.end(), [](const run& a, const run& b) { return a.length > b.length; });
    runs.resize(std::min(count, runs.size()));
    std::vector<double> centres;
    for (const run& r : runs) centres.push_back(double(r.begin) + double(r.length) / 2);
    std::sort(centres.begin(), centres.end());
    return centres;
}

template <class T> void check_cuts_against_runs(bit_source& bits)
{
    const std::vector<T> z = clumped_depths<T>(bits);
    const layer_window<T> w = window_of(z);
    REQUIRE(w.least == *std::min_element(z.begin(), z.end()));
    REQUIRE(w.greatest == *std::max_element(z.begin(), z.end()));
    const auto occupied = occupied_bins(z, w);
    const std::size_t layers = 1 + bits.below(4);
    const layer_cuts<T> cuts = cuts_at(occupied, w, T(layers));
    std::vector<double> expected = centres_of_runs(occupied, layers - 1);
    const wide extent = wide(w.greatest) - wide(w.least);
    if (w.greatest - w.least < T(layer_least_extent)) expected.clear();
    const auto found = depths_of(cuts);
    for (std::size_t k = 0; k < 3; ++k) {
        if (k >= expected.size()) {
            REQUIRE(found[k] == no_cut<T>);
            continue;
        }
        const wide exact = wide(w.least) + extent * wide(expected[k]) / 64;
        REQUIRE(std::abs(wide(found[k]) - exact) <= 10 * u<T>);
    }
    // Layers take whole bins: no bin is divided, and every layer has a sample.
    std::array<int, 4> samples{};
    for (const T a : z) {
        const T layer = layer_of(a, cuts);
        REQUIRE((layer >= 0 && layer <= 3));
        ++samples[std::size_t(layer)];
        for (const T b : z)
            if (layer_bin_of(a, w) == layer_bin_of(b, w)) REQUIRE(layer == layer_of(b, cuts));
    }
    for (std::size_t k = 0; k <= expected.size(); ++k) REQUIRE(samples[k] > 0);
}

} // namespace

TEST_CASE_TEMPLATE("clusters: cuts in the middle of the longest interior runs of empty bins", T, float, double)
{
    bit_source bits(31);
    for (std::int64_t i = 0; i < effort(40'000); ++i) check_cuts_against_runs<T>(bits);
    CHECK(rc::check("any clumps", [](std::uint64_t seed) {
        bit_source any(seed);
        check_cuts_against_runs<T>(any);
    }));
}

TEST_CASE_TEMPLATE("clusters: bins are whole numbers from 0 to 63, in the order of depths", T, float, double)
{
    bit_source bits(32);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const double a = bits.uniform(-2, 2), b = std::min(a + std::exp2(bits.uniform(-14, 1)), 2.0);
        const layer_window<T> w{T(a), T(b)};
        const double x = std::clamp(bits.uniform(a - 0.1, b + 0.1), -2.0, 2.0),
                     y = bits.uniform(x, std::min(b + 0.1, 2.0));
        const T at_x = layer_bin_of(T(x), w), at_y = layer_bin_of(T(y), w);
        REQUIRE((at_x >= 0 && at_x <= at_y && at_y <= 63));
        REQUIRE(at_x == std::floor(at_x));
        REQUIRE(layer_bin_of(w.least, w) == 0);
        REQUIRE(layer_bin_of(w.greatest, w) == 63);
        const wide share = (wide(T(x)) - wide(w.least)) / (wide(w.greatest) - wide(w.least));
        const wide exact = std::clamp<wide>(64 * share, 0, 63.5L);
        REQUIRE((wide(at_x) <= exact * (1 + 4 * wide(u<T>)) && exact * (1 - 4 * wide(u<T>)) < wide(at_x) + 1));
    }
    CHECK(layer_bin_of(T(0.5), layer_window<T>{T(0.5), T(0.5)}) == 0);
}

TEST_CASE_TEMPLATE("clusters: a level surface, a single sample and the background have no cut", T, float, double)
{
    const T nan = std::numeric_limits<T>::quiet_NaN();
    const auto uncut = [](const std::vector<T>& z) { return depths_of(cuts_of(z, T(4))); };
    const std::array<T, 3> none{no_cut<T>, no_cut<T>, no_cut<T>};
    CHECK(uncut({}) == none);
    CHECK(uncut({T(0.25)}) == none);
    CHECK(uncut(std::vector<T>(16, T(0.25))) == none);
    CHECK(uncut({T(0.25), T(0.25) + T(0x1p-15)}) == none);
    CHECK(uncut(std::vector<T>(16, T(layer_background_depth))) == none);
    CHECK(uncut({nan, T(0.5), T(layer_background_depth), T(0.5), T(layer_unknown_depth)}) == none);
    CHECK(uncut({T(0), T(1), T(layer_background_depth), nan})[0] == T(0.5));
    const layer_window<T> empty = window_of(std::vector<T>{nan, T(layer_background_depth)});
    CHECK(empty.least > empty.greatest);
    // Bins that the caller fills at random are not cut either, in any window.
    for (const layer_window<T> w : {layer_window<T>{nan, nan}, layer_window<T>{T(-INFINITY), T(INFINITY)}, empty}) {
        layer_runs<T> state = layer_cuts_begin(w);
        for (int k = 0; k < 64; ++k) state = layer_cuts_add(state, T(k % 5 == 0));
        CHECK(depths_of(layer_cuts_end(state, T(4))) == none);
    }
}

TEST_CASE_TEMPLATE("clusters: of equal runs the nearer is cut first, and a number of layers is a limit", T, float,
                   double)
{
    const std::vector<T> z{0, T(0.25), T(0.5), T(0.75), 1};
    CHECK(depths_of(cuts_of(z, T(1))) == std::array<T, 3>{no_cut<T>, no_cut<T>, no_cut<T>});
    CHECK(cuts_of(z, T(2)).c0 < T(0.25));
    CHECK(cuts_of(z, T(2)).c1 == no_cut<T>);
    const auto three = depths_of(cuts_of(z, T(3)));
    CHECK((three[0] < T(0.25) && three[1] > T(0.25) && three[1] < T(0.5) && three[2] == no_cut<T>));
    const auto four = depths_of(cuts_of(z, T(4)));
    CHECK((four[1] == three[1] && four[2] > T(0.5) && four[2] < T(0.75)));
    CHECK(depths_of(cuts_of(z, T(100))) == four);
    for (const T odd : {T(0), T(-3), std::numeric_limits<T>::quiet_NaN()}) CHECK(cuts_of(z, odd).c0 == no_cut<T>);
}

TEST_CASE_TEMPLATE("clusters: layers are numbered from near to far, before the background and behind NaN", T, float,
                   double)
{
    const layer_cuts<T> cuts{T(-0.5), T(0.25), no_cut<T>};
    CHECK(layer_of(T(-1), cuts) == 0);
    CHECK(layer_of(T(-0.5), cuts) == 1);
    CHECK(layer_of(T(0.25), cuts) == 2);
    CHECK(layer_of(T(layer_depth_limit), cuts) == 2);
    CHECK(layer_of(T(layer_background_depth), cuts) == 4);
    CHECK(layer_of(T(layer_unknown_depth), cuts) == -1);
    CHECK(layer_of(std::numeric_limits<T>::quiet_NaN(), cuts) == -1);
    const auto middle = [](T z, T t, T d_z, T id) {
        return layer_middle_depth(stochastic_sample<T>{0, 0, t, z, 0, 0, d_z, id});
    };
    CHECK(middle(T(0.5), T(0.25), T(1), 0) == T(0.75));
    CHECK(middle(T(1), T(0), T(8), 0) == T(layer_depth_limit));
    CHECK(middle(T(-1), T(0), T(-8), 0) == T(-layer_depth_limit));
    CHECK(middle(T(1), T(0.3), T(0), T(stochastic_nothing)) == T(layer_background_depth));
    hostile_source<T> hostile(33);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const stochastic_sample<T> s{hostile.special(), hostile.pattern(), hostile.special(), hostile.pattern(),
                                     hostile.special(), hostile.pattern(), hostile.special(), hostile.special()};
        const T z = layer_middle_depth(s);
        REQUIRE((std::abs(z) <= T(layer_depth_limit) || z == T(layer_background_depth) || z == T(layer_unknown_depth)));
        const bool known = std::abs(s.d_x) + std::abs(s.d_y) + std::abs(s.d_z) <= T(texel_limit) && std::isfinite(s.z);
        if (!known) REQUIRE((s.id < 0 || z == T(layer_unknown_depth)));
    }
}

TEST_CASE_TEMPLATE("clusters: middle depths and cuts err within the stated bounds", T, float, double)
{
    const auto of_cut = [](const std::vector<double>& p) {
        const T least = T(4 * p[0] - 2), greatest = T(std::min(double(least) + std::exp2(-13 * p[1]) * 4, 2.0));
        const T centre = T(std::floor(p[2] * 127) / 2);
        const layer_cuts<T> cuts =
            layer_cuts_end(layer_runs<T>{least, greatest, 64, 1, 0, 1, 0, 0, centre, 0, 0}, T(2));
        if (greatest - least < T(layer_least_extent)) return 0.0;
        const wide exact = wide(least) + (wide(greatest) - wide(least)) * wide(centre) / 64;
        return double(std::abs(wide(cuts.c0) - exact) / wide(u<T>));
    };
    const summit farthest = climb(3, 100'000, 35, of_cut);
    CHECK(farthest.score <= 10);
    CHECK(farthest.score > 2.5);
    const auto error = [](const std::vector<double>& p) {
        const stochastic_sample<T> s{0, 0, T(p[0]), T(2 * p[1] - 1), 0, 0, T(4 * p[2] - 2), 1};
        const wide exact = wide(s.z) + (0.5L - wide(s.t)) * wide(s.d_z);
        return double(std::abs(wide(layer_middle_depth(s)) - exact) / wide(u<T>));
    };
    const summit worst = climb(3, 100'000, 34, error);
    CHECK(worst.score <= 4);
    CHECK(worst.score > 1);
}
