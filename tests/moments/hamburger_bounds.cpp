// Properties of the bounds. Depths and weights are multiples of powers of two with so few bits that six moments are
// exact in double. Bounds then hold for degenerate distributions and for receivers on a depth as well.
#include "support/effort.hpp"

#include <gnomon/moments/hamburger4.h>
#include <gnomon/moments/hamburger6.h>

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <ostream>
#include <set>
#include <vector>

using namespace gnomon;

namespace {

constexpr int depth_steps = 64;
constexpr int weight_steps = 256;

/// A distribution with depths in multiples of 1/64 and weights in multiples of 1/256: b6 needs 36 + 8 bits.
struct dyadic {
    std::vector<int> depths, weights;

    [[nodiscard]] double depth(std::size_t i) const { return double(depths[i]) / depth_steps; }
    [[nodiscard]] std::array<double, 7> moments() const
    {
        std::array<double, 7> b{};
        for (std::size_t i = 0; i < depths.size(); ++i) {
            double p = double(weights[i]) / weight_steps;
            for (double& x : b) x += p, p *= depth(i);
        }
        return b;
    }
    [[nodiscard]] double below(double z_f, bool inclusive) const
    {
        double sum = 0;
        for (std::size_t i = 0; i < depths.size(); ++i)
            if (depth(i) < z_f || (inclusive && depth(i) <= z_f)) sum += weights[i];
        return sum / weight_steps;
    }
    /// The number of different depths with a weight.
    [[nodiscard]] std::size_t support() const
    {
        std::set<int> different;
        for (std::size_t i = 0; i < depths.size(); ++i)
            if (weights[i] > 0) different.insert(depths[i]);
        return different.size();
    }
    /// True if z_f is beside a depth, but so near that their canonical nodes cannot be told apart.
    [[nodiscard]] bool touches(double z_f) const
    {
        return std::any_of(depths.begin(), depths.end(), [&](int z) {
            const double distance = std::abs(z_f - double(z) / depth_steps);
            return distance > 0 && distance < 0x1p-12;
        });
    }
    [[nodiscard]] dyadic mirrored() const
    {
        dyadic d = *this;
        for (int& z : d.depths) z = -z;
        return d;
    }
    /// Receivers on, next to and far from depths.
    [[nodiscard]] std::vector<double> receivers() const
    {
        std::vector<double> z{-1, 1, 0};
        for (std::size_t i = 0; i < depths.size(); ++i)
            for (const double distance : {0.0, 0x1p-40, 0x1p-20, 0x1p-8})
                for (const double side : {-distance, distance}) z.push_back(std::clamp(depth(i) + side, -1.0, 1.0));
        for (int i = -16; i < 16; ++i) z.push_back((i + 0.37) / 16);
        std::sort(z.begin(), z.end());
        return z;
    }
    friend std::ostream& operator<<(std::ostream& out, const dyadic& d)
    {
        for (std::size_t i = 0; i < d.depths.size(); ++i) out << d.depths[i] << "/64: " << d.weights[i] << "/256  ";
        return out;
    }
};

} // namespace

template <> struct rc::Arbitrary<dyadic> {
    static Gen<dyadic> arbitrary()
    {
        return gen::mapcat(gen::inRange(1, 7), [](int count) {
            const auto depth = gen::weightedOneOf<int>(
                {{4, gen::inRange(-depth_steps, depth_steps + 1)}, {1, gen::element(-depth_steps, depth_steps)}});
            const auto size = std::size_t(count);
            return gen::apply(
                [](std::vector<int> depths, std::vector<int> cuts) {
                    // The distances of cuts of the unit interval are weights that sum to 1; a weight may be 0.
                    std::sort(cuts.begin(), cuts.end());
                    cuts.push_back(weight_steps);
                    std::adjacent_difference(cuts.begin(), cuts.end(), cuts.begin());
                    return dyadic{std::move(depths), std::move(cuts)};
                },
                gen::container<std::vector<int>>(size, depth),
                gen::container<std::vector<int>>(size - 1, gen::inRange(0, weight_steps + 1)));
        });
    }
};

namespace {

hankel4<double> factor4(const std::array<double, 7>& b)
{
    return hankel4_constant_bias(moments4<double>{b[1], b[2], b[3], b[4]}, 0, 0, 0);
}
hankel6<double> factor6(const std::array<double, 7>& b)
{
    return hankel6_constant_bias(moments6<double>{b[1], b[2], b[3], b[4], b[5], b[6]}, 0, 0, 0, 0);
}

// A pivot is 0, and then at the floor F = 2^-66, or at least about 2^-34 = (1/256)^2 (1/64)^3. P_k at a node is off by
// about 2^-53, which changes the weight of the node by 2^-106 / F = 2^-40, or moves a root beyond a node by sqrt(F) =
// 2^-33 of the distance between two nodes: 1e-9 in all.
constexpr double tolerance = 1e-9;

// The floor does not scale with the depth range, and differs for another number of moments. Its effect is F /
// P_3(z_f)^2. For z_f at 0.37 of a step from three depths 1/64 apart, that is 2^-27 for each node.
constexpr double floor_shows = 3e-8;

// For all nodes at once. Two nodes that the deflation of the cubic leaves may lie close together, where their error is
// the square root of rounding.
constexpr double node_tolerance = 1e-6;

// If the distribution has m / 2 depths, the moments determine them. The last node then depends only on the floor of the
// pivot and on rounding, and reduces the accuracy of its neighbours. With fewer depths there are two such nodes.
constexpr double determined_tolerance = 1e-3;

struct node {
    double depth, weight;
};
std::vector<node> nodes(const distribution3<double>& d)
{
    return {{d.depth0, d.weight0}, {d.depth1, d.weight1}, {d.depth2, d.weight2}};
}
std::vector<node> nodes(const distribution4<double>& d)
{
    return {{d.depth0, d.weight0}, {d.depth1, d.weight1}, {d.depth2, d.weight2}, {d.depth3, d.weight3}};
}

/// Checks that the canonical distribution is a distribution, attains both bounds and has the moments. Nodes far
/// outside [-1, 1] have almost no weight, but their depth enters with the power m, so the accuracy of moments is
/// relative to that.
template <int m>
void check_canonical(const dyadic& d, double z_f, const hamburger_bounds<double>& bounds,
                     const std::vector<node>& canonical)
{
    const auto b = d.moments();
    const bool determined = d.support() <= m / 2;
    if (determined && d.support() < m / 2) return;
    const double accuracy = determined ? determined_tolerance : node_tolerance;
    double total = 0, lower = 0, farthest = 0;
    std::array<double, m + 1> moments{}, scale{};
    for (const node& n : canonical) {
        RC_ASSERT(std::isfinite(n.depth));
        RC_ASSERT(n.weight >= 0.0);
        RC_ASSERT(n.weight <= 1.0);
        total += n.weight;
        farthest = std::max(farthest, std::abs(n.depth));
        if (&n != &canonical.front() && n.depth < z_f) lower += n.weight;
        for (int j = 0; j <= m; ++j) {
            moments[std::size_t(j)] += n.weight * std::pow(n.depth, j);
            scale[std::size_t(j)] += n.weight * std::pow(std::max(std::abs(n.depth), 1.0), j);
        }
    }
    RC_ASSERT(std::abs(canonical.front().depth - z_f) <= std::numeric_limits<double>::epsilon());
    RC_ASSERT(std::abs(total - 1) <= 4 * std::numeric_limits<double>::epsilon());
    RC_ASSERT(std::abs(canonical.front().weight - bounds.weight) <= accuracy);
    RC_ASSERT(std::abs(lower - bounds.lower) <= accuracy);
    // A node that would be at infinity is clamped to about 1024, which affects only the two highest moments.
    const std::size_t known = farthest < 512 ? m : m - 2;
    for (std::size_t j = 1; j <= known; ++j) RC_ASSERT(std::abs(moments[j] - b[j]) <= accuracy * scale[j]);
}

} // namespace

TEST_CASE("the generator covers signs, ends, coincident depths, faint and zero weights")
{
    int seen[7] = {}, negative = 0, ends = 0, coincident = 0, faint = 0, absent = 0;
    rc::Random random(1);
    for (int i = 0; i < 500; ++i) {
        const dyadic d = rc::gen::arbitrary<dyadic>()(random.split(), rc::kNominalSize).value();
        ++seen[d.depths.size()];
        CHECK(std::accumulate(d.weights.begin(), d.weights.end(), 0) == weight_steps);
        for (std::size_t k = 0; k < d.depths.size(); ++k) {
            negative += d.depths[k] < 0;
            ends += std::abs(d.depths[k]) == depth_steps;
            coincident += std::count(d.depths.begin(), d.depths.end(), d.depths[k]) > 1;
            faint += d.weights[k] == 1;
            absent += d.weights[k] == 0;
        }
    }
    CHECK(*std::min_element(seen + 1, seen + 7) > 20);
    for (const int count : {negative, ends, coincident, faint, absent}) CHECK(count > 10);
}

TEST_CASE("bounds hold, canonical distributions attain them, six moments are never looser than four")
{
    CHECK(rc::check("lower <= Z(z < z_f), Z(z <= z_f) <= upper", [](const dyadic& d) {
        const auto b = d.moments();
        for (const double z_f : d.receivers()) {
            const auto four = hamburger4_bounds(factor4(b), z_f);
            const auto six = hamburger6_bounds(factor6(b), z_f);
            for (const auto& r : {four, six}) {
                RC_ASSERT(r.lower <= d.below(z_f, false) + tolerance);
                RC_ASSERT(r.upper >= d.below(z_f, true) - tolerance);
            }
            RC_ASSERT(six.lower >= four.lower - floor_shows);
            RC_ASSERT(six.upper <= four.upper + floor_shows);
            if (d.touches(z_f)) continue;
            check_canonical<4>(d, z_f, four, nodes(hamburger4_distribution(factor4(b), z_f)));
            check_canonical<6>(d, z_f, six, nodes(hamburger6_distribution(factor6(b), z_f)));
        }
    }));
}

TEST_CASE("bounds are monotone in the receiver, symmetric, and independent of the depth range")
{
    CHECK(rc::check("lower and upper never fall as the receiver recedes", [](const dyadic& d) {
        const auto b = d.moments();
        hamburger_bounds<double> four{}, six{};
        for (const double z_f : d.receivers()) {
            const auto next4 = hamburger4_bounds(factor4(b), z_f);
            const auto next6 = hamburger6_bounds(factor6(b), z_f);
            RC_ASSERT(next4.lower >= four.lower - tolerance);
            RC_ASSERT(next4.upper >= four.upper - tolerance);
            RC_ASSERT(next6.lower >= six.lower - tolerance);
            RC_ASSERT(next6.upper >= six.upper - tolerance);
            four = next4, six = next6;
        }
    }));
    CHECK(rc::check("mirrored depths exchange and complement the bounds", [](const dyadic& d) {
        const auto b = d.moments(), mirrored = d.mirrored().moments();
        for (const double z_f : d.receivers()) {
            RC_ASSERT(std::abs(hamburger4_bounds(factor4(b), z_f).lower -
                               (1 - hamburger4_bounds(factor4(mirrored), -z_f).upper)) <= tolerance);
            RC_ASSERT(std::abs(hamburger6_bounds(factor6(b), z_f).lower -
                               (1 - hamburger6_bounds(factor6(mirrored), -z_f).upper)) <= tolerance);
        }
    }));
    CHECK(rc::check("a change of depth range does not change the lower bound", [](dyadic d) {
        const int shift = *rc::gen::inRange(-depth_steps / 2, depth_steps / 2 + 1);
        for (int& z : d.depths) z -= z & 1;
        dyadic moved = d;
        for (int& z : moved.depths) z = z / 2 + shift;
        const auto b = d.moments(), b_moved = moved.moments();
        for (int i = -depth_steps; i < depth_steps; ++i) {
            const double z_f = (i + 0.37) / depth_steps, z_moved = z_f / 2 + double(shift) / depth_steps;
            RC_ASSERT(std::abs(hamburger4_lower(factor4(b), z_f) - hamburger4_lower(factor4(b_moved), z_moved)) <=
                      floor_shows);
            RC_ASSERT(std::abs(hamburger6_lower(factor6(b), z_f) - hamburger6_lower(factor6(b_moved), z_moved)) <=
                      floor_shows);
        }
    }));
}
