// Two occluders with a penumbra each, in one dimension: a pillar near the light and a wall near the receivers, as in
// Figure 10 of Peters et al. 2017. The reference is the share of a light's width that is seen, by intersecting intervals.
#include "support/hostile.hpp"

#include <gnomon/soft/fusion.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr int texels = 512;

/// An occluder from begin to end, in texels, at a depth.
struct slab {
    double depth, begin, end;
};

/// A pillar before a wall, over receivers at depth floor. The light is seen from a depth z below under penumbra * z texels.
struct scene_1d {
    slab pillar, wall;
    double floor, penumbra;

    [[nodiscard]] double depth_at(int x) const
    {
        for (const slab& s : {pillar, wall})
            if (x + 0.5 >= s.begin && x + 0.5 < s.end) return s.depth;
        return floor;
    }
    [[nodiscard]] double width(double occluder) const { return std::max(1.0, penumbra * (floor - occluder)); }

    /// The share of the light that the receiver at x sees.
    [[nodiscard]] double visibility(double x) const
    {
        const auto shadow = [&](const slab& s) {
            const double scale = 1 / (penumbra * (floor - s.depth));
            const auto on_light = [&](double at) { return std::clamp((at - x) * scale + 0.5, 0.0, 1.0); };
            return std::pair(on_light(s.begin), on_light(s.end));
        };
        const auto [a0, a1] = shadow(pillar);
        const auto [b0, b1] = shadow(wall);
        const double common = std::max(0.0, std::min(a1, b1) - std::max(a0, b0));
        return 1 - ((a1 - a0) + (b1 - b0) - common);
    }
};

/// Averages over intervals of the map, in double.
class averages {
  public:
    explicit averages(const scene_1d& s)
    {
        for (int x = 0; x < texels; ++x) depths_.push_back(s.depth_at(x));
    }
    /// The mean of f(depth) over width texels about x.
    template <class F> [[nodiscard]] auto mean(double x, double width, F f) const
    {
        const double begin = std::max(0.0, x - width / 2), end = std::min(double(texels), x + width / 2);
        decltype(f(0.0)) sum{};
        for (int i = int(begin); i < std::min(texels, int(end) + 1); ++i) {
            const double share = std::max(0.0, std::min(end, i + 1.0) - std::max(begin, double(i))) / (end - begin);
            sum = sum + share * f(depths_[std::size_t(i)]);
        }
        return sum;
    }
    [[nodiscard]] hankel4<double> moments(double x, double width) const
    {
        moments4<double> b{mean(x, width, [](double z) { return z; }), mean(x, width, [](double z) { return z * z; }),
                           mean(x, width, [](double z) { return z * z * z; }),
                           mean(x, width, [](double z) { return z * z * z * z; })};
        return hankel4_constant_bias(b, 0.41, 0.41, 6e-7);
    }
    [[nodiscard]] double below(double x, double width, double z_f) const
    {
        return mean(x, width, [z_f](double z) { return z < z_f ? 1.0 : 0.0; });
    }

  private:
    std::vector<double> depths_;
};

enum estimate { percentage_closer, moments, fused_filters, fused };
constexpr std::size_t estimates = 4;

std::array<double, estimates> shown(const scene_1d& s, const averages& map, double x)
{
    const double search = s.penumbra * (s.floor + 1), z_f = s.floor - 1e-4;
    const distribution3<double> d = hamburger4_distribution(map.moments(x, search), z_f);
    double blocker = 0, weight = 1e-3;
    for (const auto& [z, w] : {std::pair(d.depth1, d.weight1), std::pair(d.depth2, d.weight2)})
        if (z < z_f) blocker += w * (z_f - std::max(z, -1.0)), weight += w;
    const double width = s.width(s.floor - blocker / weight);
    const occluder_pair<double> two = fusion_occluders(d);
    const double k1 = s.width(two.first), k2 = s.width(two.second);
    const auto bound = [&](double k, double z) { return hamburger4_lower(map.moments(x, k), z); };
    const double near = map.below(x, search, z_f);
    const double mean = near > 0 ? map.mean(x, search, [&](double z) { return z < z_f ? z : 0.0; }) / near : z_f;
    const double exact = map.below(x, s.width(mean), z_f);
    std::array<double, estimates> r{exact, bound(width, z_f), bound(width, z_f), bound(width, z_f)};
    if (two.between > -1) {
        r[fused_filters] =
            fusion_intensity(map.below(x, k1, two.between), map.below(x, k2, two.between), map.below(x, k2, z_f));
        r[fused] = fusion_intensity(bound(k1, two.between), bound(k2, two.between), bound(k2, z_f));
    }
    for (double& i : r) i = 1 - i;
    return r;
}

/// The sum of squared errors over the receivers on the floor near both occluders, and their number last.
std::array<double, estimates + 1> squares(const scene_1d& s)
{
    const averages map(s);
    std::array<double, estimates + 1> sum{};
    for (int x = 0; x < texels; ++x) {
        const bool between = x > s.pillar.end - 20 && x < s.wall.begin + 20;
        const bool beside = x > s.pillar.begin - 20 && x < s.pillar.begin;
        if (s.depth_at(x) < s.floor || !(s.pillar.end < s.wall.begin ? between : beside)) continue;
        const auto v = shown(s, map, x + 0.5);
        for (std::size_t k = 0; k < estimates; ++k) sum[k] += std::pow(v[k] - s.visibility(x + 0.5), 2);
        sum[estimates] += 1;
    }
    return sum;
}

/// Root mean square errors over random scenes, in which the wall begins overlap texels inside the pillar.
std::array<double, estimates> errors(const char* name, double overlap_from, double overlap_to)
{
    bit_source bits(3);
    std::array<double, estimates + 1> sum{};
    for (int i = 0; i < 40; ++i) {
        const double begin = bits.uniform(120, 180), end = begin + bits.uniform(20, 80);
        const double wall = end - bits.uniform(overlap_from, overlap_to);
        const slab pillar{bits.uniform(-0.9, -0.3), begin, end};
        const slab brick{bits.uniform(0.3, 0.6), wall, wall + bits.uniform(80, 150)};
        const auto one = squares({pillar, brick, 0.7, bits.uniform(30, 80)});
        for (std::size_t k = 0; k <= estimates; ++k) sum[k] += one[k];
    }
    std::array<double, estimates> e{};
    std::printf("| %s |", name);
    for (std::size_t k = 0; k < estimates; ++k) std::printf(" %.4f |", e[k] = std::sqrt(sum[k] / sum[estimates]));
    std::printf("\n");
    return e;
}

} // namespace

TEST_CASE("two occluders that the map shows keep a penumbra each")
{
    const auto apart = errors("apart", -100, -10);
    CHECK(apart[moments] > 0.05);
    CHECK(apart[fused_filters] < 0.25 * apart[moments]);
    CHECK(apart[fused] < 0.45 * apart[moments]);
    const auto behind = errors("the wall begins under the pillar", 10, 20);
    CHECK(behind[fused] < 0.5 * behind[moments]);
}

TEST_CASE("occluders before a surface at z_f are found exactly, apart from epsilon")
{
    bit_source bits(5);
    for (int i = 0; i < 2000; ++i) {
        const double z1 = bits.uniform(-1, -0.3), z2 = bits.uniform(-0.2, 0.2), z_f = bits.uniform(0.3, 1);
        const double w1 = bits.uniform(0.1, 0.4), w2 = bits.uniform(0.1, 0.4);
        const auto power = [&](int k) {
            return w1 * std::pow(z1, k) + w2 * std::pow(z2, k) + (1 - w1 - w2) * std::pow(z_f, k);
        };
        const hankel4<double> h = hankel4_from_moments(moments4<double>{power(1), power(2), power(3), power(4)});
        const occluder_pair<double> r = fusion_occluders(hamburger4_distribution(h, z_f));
        CHECK(r.first == doctest::Approx(z_f - (z_f - z1) * w1 / (w1 + blocker_epsilon)).epsilon(1e-4));
        CHECK(r.second == doctest::Approx(z_f - (z_f - z2) * w2 / (w2 + blocker_epsilon)).epsilon(1e-4));
        CHECK(r.between == doctest::Approx((z1 + z2) / 2).epsilon(1e-4));
    }
}

TEST_CASE("one occluder, or none, is no pair")
{
    const auto at = [](double z_f) { return fusion_occluders(distribution3<double>{z_f, -0.5, 0.5, 0.2, 0.4, 0.4}); };
    CHECK(at(0.2).between == -1);
    CHECK(at(0.2).first == at(0.2).second);
    CHECK(at(0.2).second == doctest::Approx(0.2 - 0.7 * 0.4 / 0.401)); // of weight 0.4
    CHECK(at(-0.7).second == -0.7);
    CHECK(at(0.9).between == 0);
}

TEST_CASE("two occluders whose filter regions are alike shadow as one does, and none more than all light")
{
    bit_source bits(7);
    for (int i = 0; i < 10'000; ++i) {
        const double either = bits.uniform(0, 1), covered = either * bits.uniform(0, 1);
        CHECK(std::abs(fusion_intensity(covered, covered, either) - either) < blocker_epsilon);
        CHECK(fusion_intensity(covered, 1 - 1e-6, 1.0) < covered + 2e-3);
        CHECK(fusion_intensity(0.0, 0.0, either) == either);
        CHECK(fusion_intensity(bits.uniform(0, 1), 1.0, 1.0) <= 1);
        CHECK(fusion_intensity(1.0, covered, either) == 1);
    }
}

TEST_CASE("any bits name two depths in [-1, 1] in their order")
{
    hostile_source<float> source(9);
    bit_source bits(10);
    const auto x = [&] { return bits.chance(0.5) ? source.pattern() : source.special(); };
    for (int i = 0; i < 100'000; ++i) {
        const occluder_pair<float> r = fusion_occluders(distribution3<float>{x(), x(), x(), x(), x(), x()});
        CHECK((r.first >= -1 && r.first <= r.second && r.second <= 1));
        CHECK((r.between >= -1 && r.between <= 1));
        const float shown = fusion_intensity(x(), x(), x());
        CHECK((shown >= 0 && shown <= 1));
    }
}
