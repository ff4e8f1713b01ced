// Summed-area tables never darken: for any distribution on [-1, 1] under a rectangle and any receiver,
//     intensity <= Z(z < z_f) + the stated weight,
// with every rounding on the way: channels in float, a resolve of four samples, codes, sums that have wrapped around,
// conversions to float, and a mean of three kinds of rectangles, whole ones and those at edges and corners, whose texels have a
// part of the weight. A hill climber searches for the largest darkness.
#include "support/climber.hpp"
#include "support/contacts.hpp"
#include "support/documented.hpp"

#include <gnomon/storage/moments4_summed.hpp>
#include <gnomon/storage/moments6_summed.hpp>
#include <gnomon/storage/variance_summed.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr std::size_t region_dimensions = sight_dimensions + 4;
constexpr std::int64_t evaluations = 200'000;

/// A rectangle of a table as a look-up in float sees it, and the truth below it.
template <class Table> struct region {
    format_channels<Table> c;
    std::vector<double> depths, weights;
    [[nodiscard]] double below(double z_f) const
    {
        double sum = 0;
        for (std::size_t i = 0; i < depths.size(); ++i) sum += depths[i] < z_f ? weights[i] : 0;
        return sum;
    }
};

/// The texels of one kind of rectangle: running sums of codes, from anywhere in the integers.
template <class Table> class texel_sums {
  public:
    explicit texel_sums(float scale) : scale_(scale) {}

    /// Adds count texels of four samples each.
    void add(const std::array<float, 4>& samples, std::uint32_t count)
    {
        channel_array<Table> mean{};
        for (const float z : samples) {
            const auto c = gnomon_bit_cast<channel_array<Table>>(Table::from_depth(z));
            for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += c[k];
        }
        for (float& x : mean) x *= 0.25f;
        const auto codes =
            gnomon_bit_cast<channel_array<Table>>(Table::codes(gnomon_bit_cast<format_channels<Table>>(mean), scale_));
        for (std::size_t k = 0; k < codes.size(); ++k) sums_[k] += count * std::uint32_t(codes[k]);
    }
    /// What a look-up gets from the difference of its corners.
    [[nodiscard]] channel_array<Table> converted() const
    {
        channel_array<Table> r{};
        for (std::size_t k = 0; k < r.size(); ++k) r[k] = float(std::uint32_t(sums_[k] - begin));
        return r;
    }

  private:
    static constexpr std::uint32_t begin = 0xfedcba98;
    float scale_;
    std::array<std::uint32_t, channel_count<Table>> sums_ = [] {
        std::array<std::uint32_t, channel_count<Table>> s;
        s.fill(begin);
        return s;
    }();
};

/// The region of a sight in a table for most_texels, of any size; texels may hold two depths, and those at edges and corners
/// have parts of the weight.
template <class Table> region<Table> region_at(const sight& s, std::uint32_t most_texels, const double* x)
{
    const float scale = summed_area_scale(float(most_texels));
    const std::uint32_t whole = std::max(1u, std::uint32_t(most_texels * std::min(1.0, 2 * x[0])));
    const double mix = std::max(0.0, 2 * x[1] - 1);
    const float u = float(std::min(1.0, 1.5 * x[2])), v = float(std::min(1.0, 1.5 * x[3]));
    const std::array<float, 3> weights{1, u, u * v};
    std::array<texel_sums<Table>, 3> kinds{texel_sums<Table>(scale), texel_sums<Table>(scale),
                                           texel_sums<Table>(scale)};
    std::array<std::uint32_t, 3> texels{};
    region<Table> r{{}, s.seen.depths, std::vector<double>(s.seen.depths.size())};
    std::uint32_t left = whole;
    const std::size_t depths = r.depths.size();
    for (std::size_t i = 0; i < depths; ++i) {
        const auto share = std::uint32_t(std::lround(s.seen.weights[i] * whole));
        const std::uint32_t count = i + 1 == depths ? left : std::min(left, share);
        left -= count;
        const std::size_t next = (i + 1) % depths;
        const float z = float(r.depths[i]), other = float(r.depths[next]);
        const std::uint32_t corners = u < 1 ? count / 16 : 0, edges = u < 1 ? count / 4 : 0;
        const std::array<std::uint32_t, 3> parts{count - edges - corners, edges, corners};
        for (std::size_t kind = 0; kind < 3; ++kind) {
            const auto mixed = std::uint32_t(mix * parts[kind]);
            kinds[kind].add({z, z, z, z}, parts[kind] - mixed);
            kinds[kind].add({z, other, z, z}, mixed);
            texels[kind] += parts[kind];
            r.weights[i] += double(weights[kind]) * (parts[kind] - 0.25 * mixed);
            r.weights[next] += double(weights[kind]) * 0.25 * mixed;
        }
    }
    channel_array<Table> sum{};
    float area = 0;
    for (std::size_t kind = 3; kind-- > 0;) { // from the corners inwards
        const auto part = kinds[kind].converted();
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weights[kind] * part[k];
        area += weights[kind] * float(texels[kind]);
    }
    r.c = Table::mean(gnomon_bit_cast<format_channels<Table>>(sum), area, scale);
    double total = 0;
    for (const double w : r.weights) total += w;
    for (double& w : r.weights) w /= total;
    return r;
}

template <class Table, class Intensity>
double darkest(std::uint32_t most_texels, std::uint64_t seed, Intensity intensity)
{
    return climb(region_dimensions, evaluations, seed,
                 [&](const std::vector<double>& place) {
                     const sight s = sight_at(place);
                     const auto r = region_at<Table>(s, most_texels, place.data() + sight_dimensions);
                     return double(intensity(r.c, float(most_texels), float(s.receiver))) - r.below(s.receiver);
                 })
        .score;
}

constexpr std::array<std::uint32_t, 6> sizes{9, 49, 100, 400, 784, 4096};

} // namespace

TEST_CASE_TEMPLATE("a lit surface is never darkened", Table, moments4_summed, moments6_summed, variance_summed)
{
    for (const std::uint32_t most : sizes) {
        const double darkness =
            darkest<Table>(most, most, [](const auto& c, float n, float z_f) { return Table::intensity(c, n, z_f); });
        std::printf("%s, %u texels: darkness %.3g of %.3g\n", std::string(Table::id).c_str(), most, darkness,
                    Table::darkening(most));
        CHECK(darkness <= Table::darkening(most));
    }
}

TEST_CASE("the matrix for both bounds darkens by its weight at most")
{
    for (const std::uint32_t most : sizes) {
        const double weight = moments4_summed_bias_ratio * summed_area_noise(double(most)) + stored4_arithmetic_weight;
        const double darkness = darkest<moments4_summed>(most, most, [](const auto& c, float n, float z_f) {
            return hamburger4_lower(hankel4_from_summed(c, n), z_f);
        });
        std::printf("constant bias, %u texels: darkness %.3g of %.3g\n", most, darkness, weight);
        CHECK(darkness <= weight);
    }
}

TEST_CASE("the climber finds that the paper's bias darkens, and half of the noise")
{
    const auto paper = [](const auto& c, float, float z_f) {
        const auto b =
            moments4_add_bias(theta4_inverse(c), float(bias4_theta_paper_b2), float(bias4_theta_paper_b4), 6e-7f);
        return hamburger4_lower(hankel4_from_moments(b), z_f);
    };
    const auto half = [](const auto& c, float n, float z_f) {
        return certified4_theta_constant_bias_lower(
            hankel4_from_summed_theta(c, float(bias4_theta_b2), float(bias4_theta_b4),
                                      float(moments4_summed_node_ratio) * summed_area_noise(n)),
            0.5f * summed_area_noise(n), float(bias4_theta_b2), float(bias4_theta_b4),
            float(moments4_summed_node_ratio) * summed_area_noise(n), z_f);
    };
    if (draws_few()) return;
    CHECK(darkest<moments4_summed>(784, 1, paper) > 0.05);
    CHECK(darkest<moments4_summed>(784, 1, half) > 1e-4);
}

TEST_CASE("784 texels leak no more than with the paper's bias, and no shadow has lit specks")
{
    distribution_source source(5);
    std::array<double, 3> ours{}, paper{};
    int specks = 0, count = 0;
    for (int f = 0; f < family_count; ++f)
        for (int i = 0; i < 1000; ++i) {
            sight s{source.draw(family(f)), 0};
            const std::array middle{1.0, 0.0, 1.0, 1.0};
            const auto r = region_at<moments4_summed>(s, 784, middle.data());
            const double on = r.depths[std::size_t(source.uniform(0, double(r.depths.size()) * 0.9999999))];
            const std::array receivers{source.receiver(s.seen), on, source.uniform(-1, 1)};
            for (std::size_t k = 0; k < 3; ++k) {
                const float z_f = float(receivers[k]);
                const double truth = r.below(double(z_f));
                const float shown = moments4_summed_intensity(r.c, 784, z_f);
                const auto h = hankel4_constant_bias(theta4_inverse(r.c), float(bias4_theta_paper_b2),
                                                     float(bias4_theta_paper_b4), 6e-7f);
                ours[k] += truth - double(shown);
                paper[k] += truth - double(hamburger4_lower(h, z_f));
                specks += shown < hamburger4_lower(hankel4_from_summed(r.c, 784), z_f) - 0.2f;
                ++count;
            }
        }
    for (std::size_t k = 0; k < 3; ++k) {
        std::printf("leak %.4g, with the paper's bias %.4g\n", 3 * ours[k] / count, 3 * paper[k] / count);
        CHECK(ours[k] <= paper[k]);
    }
    CHECK(specks == 0);
}
