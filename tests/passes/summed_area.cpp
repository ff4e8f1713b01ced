// Summed-area tables of maps: sums of any rectangle are those of its texels, exactly, however often the table has wrapped
// around; averages are those of the area; bands of rows and two passes give the same table; nothing beyond it is read.
#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <gnomon/passes/look_up.hpp>
#include <gnomon/passes/summed_area.hpp>
#include <gnomon/storage/moments4.hpp>
#include <gnomon/storage/moments4_summed.hpp>
#include <gnomon/storage/moments6_summed.hpp>
#include <gnomon/storage/variance_summed.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using depths = std::array<float, 4>;
using area = summed_area_rectangle<float>;

// A bilinear look-up of sums does not compile.
template <class Format> constexpr bool is_filtered = requires(mip_view<const format_texel<Format>> m)
{
    trilinear<Format>(m, 0.0f, 0.0f, 0.0f);
};
static_assert(is_filtered<moments4_unorm16> && !is_filtered<moments4_summed> && !is_filtered<variance_summed>);

template <class Table> using numbers = std::array<double, channel_count<Table>>;

/// The channels of a texel, in double.
template <class Table> numbers<Table> channels_of(const depths& z)
{
    numbers<Table> mean{};
    for (const float d : z) {
        const auto c = gnomon_bit_cast<numbers<Table>>(Table::from_depth(double(d)));
        for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += c[k] / 4;
    }
    return mean;
}

/// A map of random surfaces with its table, which stand in longer rows and between texels that nobody may read.
template <class Table> struct summed_map {
    std::size_t width, height, most_texels;
    std::vector<depths> source;
    std::vector<format_texel<Table>> texels;
    double scale;

    summed_map(std::size_t w, std::size_t h, std::size_t most, std::uint64_t seed)
        : width(w),
          height(h),
          most_texels(most),
          source((w + 3) * h),
          texels((w + 5) * h),
          scale(double(summed_area_scale(float(most))))
    {
        bit_source bits(seed);
        for (depths& d : source)
            for (float& z : d) z = float(bits.chance(0.3) ? 1 : bits.uniform(-1, 1));
        for (auto& t : texels) t.fill(0xdeadbeef);
        build_summed_area<Table>(depth_map(), table_map(), most);
    }
    [[nodiscard]] map_view<const depths> depth_map() const { return {source, width, height, width + 3}; }
    map_view<format_texel<Table>> table_map() { return {texels, width, height, width + 5}; }
    [[nodiscard]] map_view<const format_texel<Table>> table() const { return {texels, width, height, width + 5}; }

    /// The sum of channel k before lines x and y, as the table has it.
    [[nodiscard]] std::uint32_t before(std::size_t x, std::size_t y, std::size_t k) const
    {
        return x > 0 && y > 0 ? table()(x - 1, y - 1)[k] : 0;
    }
    /// The code of channel k of a texel.
    [[nodiscard]] std::uint64_t code(std::size_t x, std::size_t y, std::size_t k) const
    {
        const double c = std::clamp(channels_of<Table>(depth_map()(x, y))[k], 0.0, 1.0);
        return std::uint64_t(std::floor(c * scale + 0.5));
    }
};

template <class Table> numbers<Table> in_double(const format_channels<Table>& c)
{
    const auto array = gnomon_bit_cast<channel_array<Table>>(c);
    numbers<Table> r{};
    for (std::size_t k = 0; k < r.size(); ++k) r[k] = double(array[k]);
    return r;
}

template <class T> constexpr T nan_of = std::numeric_limits<T>::quiet_NaN();

} // namespace

TEST_CASE_TEMPLATE("any rectangle's sum is that of its texels, at every offset, after many wraps", Table,
                   moments4_summed, moments6_summed, variance_summed)
{
    for (const std::size_t most : {4u, 9u, 16u, 100u}) {
        const summed_map<Table> map(37, 23, most, most);
        for (std::size_t k = 0; k < channel_count<Table>; ++k)
            for (const auto& [w, h] :
                 {std::pair<std::size_t, std::size_t>{1, 1}, {2, 2}, {most / 2, 2}, {1, most / 4}, {3, 3}})
                for (std::size_t y = 0; w * h <= most && y + h <= map.height; ++y)
                    for (std::size_t x = 0; x + w <= map.width; ++x) {
                        std::uint64_t sum = 0;
                        for (std::size_t j = y; j < y + h; ++j)
                            for (std::size_t i = x; i < x + w; ++i) sum += map.code(i, j, k);
                        REQUIRE(sum <= 0xffffffffu);
                        REQUIRE(std::uint32_t(map.before(x + w, y + h, k) - map.before(x, y + h, k) -
                                              map.before(x + w, y, k) + map.before(x, y, k)) == sum);
                        const area r{float(x), float(y), float(x + w), float(y + h)};
                        const double mean = double(sum) / (double(w * h) * map.scale);
                        REQUIRE(std::abs(in_double<Table>(grid_average<Table>(map.table(), most, r))[k] - mean) <=
                                0x1p-25);
                    }
    }
}

TEST_CASE("no sum over a cleared map wraps, for any most_texels up to 4096")
{
    using table = moments4_summed;
    const std::size_t width = 4096;
    const std::vector<format_channels<table>> source(width * 2, table::from_depth(1.0f));
    std::vector<table::texel> texels(source.size());
    const map_view<table::texel> map{texels, width, 2};
    for (std::size_t most = 4; most <= 4096; most += draws_few() ? 61 : 1) {
        build_summed_area<table>(map_view<const format_channels<table>>{source, width, 2}, map, most);
        const double scale = double(summed_area_scale(float(most)));
        for (const std::size_t x : {std::size_t(0), width - most, (width - most) / 2}) {
            const std::uint32_t last = texels[width + x + most - 1][3] - texels[x + most - 1][3];
            const std::uint32_t before = x > 0 ? texels[width + x - 1][3] - texels[x - 1][3] : 0;
            REQUIRE(double(last - before) == scale * double(most)); // channel 4 of the far plane is 1
            const auto c = grid_average<table>(map, most, area{float(x), 1, float(x + most), 2});
            REQUIRE(c.c4 == 1);
            REQUIRE(double(table::intensity(c, float(most), 1)) <= table::darkening(double(most)));
            REQUIRE(table::blocker(c, float(most), 1) > 0.99f);
        }
    }
}

TEST_CASE_TEMPLATE("the nine-rectangle average is that of the area, within half a code and 2^-23", Table,
                   moments4_summed, moments6_summed, variance_summed)
{
    const std::size_t most = 196;
    const summed_map<Table> map(64, 48, most, 3);
    bit_source bits(1);
    double worst = 0;
    for (std::int64_t n = 0; n < effort(20'000); ++n) {
        const auto place = [&](double extent) {
            return bits.chance(0.2) ? std::floor(bits.uniform(0, extent)) : bits.uniform(0, extent);
        };
        const double width = std::exp2(bits.uniform(-6, 3.58)), height = std::exp2(bits.uniform(-6, 3.58));
        const double x = place(64 - width), y = place(48 - height);
        const area r{float(x), float(y), float(x + width), float(y + height)};
        numbers<Table> sum{};
        double whole = 0;
        const auto overlap = [](double low, double high, std::size_t i) {
            return std::max(0.0, std::min(high, double(i + 1)) - std::max(low, double(i)));
        };
        for (std::size_t j = std::size_t(r.y0); double(j) < double(r.y1); ++j)
            for (std::size_t i = std::size_t(r.x0); double(i) < double(r.x1); ++i) {
                const double share = overlap(double(r.x0), double(r.x1), i) * overlap(double(r.y0), double(r.y1), j);
                const numbers<Table> c = channels_of<Table>(map.depth_map()(i, j));
                for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += share * c[k];
                whole += share;
            }
        const numbers<Table> mean = in_double<Table>(rectangle_average<Table>(map.table(), most, r));
        for (std::size_t k = 0; k < sum.size(); ++k) worst = std::max(worst, std::abs(mean[k] - sum[k] / whole));
    }
    CHECK(worst <= 0.5 / map.scale + 0x1p-23);
    CHECK(worst > 0x1p-30);
}

TEST_CASE_TEMPLATE("bands of rows and two passes give the table of one pass", Table, moments4_summed, moments6_summed,
                   variance_summed)
{
    const summed_map<Table> map(67, 41, 784, 5);
    std::vector<format_texel<Table>> banded(67 * 41), twice(67 * 41), above(67);
    const map_view<format_texel<Table>> b{banded, 67, 41}, t{twice, 67, 41};
    bool first = true;
    for (const row_range rows : {row_range{0, 1}, {1, 17}, {17, 17}, {17, 41}}) {
        std::vector<format_texel<Table>> total(67);
        summed_area_total<Table>(map.depth_map(), 784, rows, std::span(total));
        build_summed_area<Table>(
            map.depth_map(), b, 784, rows,
            first ? std::span<const format_texel<Table>>() : std::span<const format_texel<Table>>(above));
        first = false;
        for (std::size_t x = 0; x < 67; ++x)
            for (std::size_t k = 0; k < channel_count<Table>; ++k) above[x][k] += total[x][k];
    }
    summed_area_along_x<Table>(map.depth_map(), t, 784, {20, 41});
    summed_area_along_x<Table>(map.depth_map(), t, 784, {0, 20});
    summed_area_along_y<Table>(t);
    for (std::size_t y = 0; y < 41; ++y)
        for (std::size_t x = 0; x < 67; ++x) {
            REQUIRE(b(x, y) == map.table()(x, y));
            REQUIRE(t(x, y) == map.table()(x, y));
        }
    for (std::size_t k = 0; k < channel_count<Table>; ++k) CHECK(above.back()[k] == b(66, 40)[k]);
}

TEST_CASE_TEMPLATE("channels are clamped, and a NaN makes a texel of the border", Table, moments4_summed,
                   moments6_summed, variance_summed)
{
    using channels = format_channels<Table>;
    for (std::size_t k = 0; k < channel_count<Table>; ++k)
        for (const float x : {-HUGE_VALF, -1.0f, 2.0f, 3e9f, HUGE_VALF, nan_of<float>}) {
            auto c = gnomon_bit_cast<channel_array<Table>>(Table::from_depth(0.25f));
            c[k] = x;
            std::array<channels, 2> source{gnomon_bit_cast<channels>(c), Table::from_depth(0.25f)};
            std::array<format_texel<Table>, 2> texels{}, want{};
            const double scale = double(summed_area_scale(784.0f));
            const auto codes = in_double<Table>(Table::codes(source[0], float(scale)));
            build_summed_area<Table>(map_view<const channels>{source, 2, 1},
                                     map_view<format_texel<Table>>{texels, 2, 1}, 784);
            for (std::size_t i = 0; i < codes.size(); ++i) want[0][i] = std::uint32_t(codes[i]);
            for (std::size_t i = 0; i < codes.size(); ++i)
                CHECK(std::abs(double(texels[0][i]) - double(want[0][i])) <= 1); // codes by kernels in float
            std::array<depths, 1> missing{depths{nan_of<float>, 2, HUGE_VALF, 1}};
            build_summed_area<Table>(map_view<const depths>{missing, 1, 1}, map_view<format_texel<Table>>{want, 1, 1},
                                     784);
            std::array<format_texel<Table>, 2> total{};
            summed_area_total<Table>(map_view<const channels>{source, 2, 1}, 784, {0, 1}, std::span(total));
            CHECK(total == texels);
            if (std::isnan(x))
                for (std::size_t i = 0; i < codes.size(); ++i)
                    CHECK(std::abs(double(texels[0][i]) - double(want[0][i])) <= 1);
        }
}

TEST_CASE_TEMPLATE("look-ups are total, and lit where nothing is left", Table, moments4_summed, moments6_summed,
                   variance_summed)
{
    const summed_map<Table> map(19, 11, 49, 7);
    hostile_source<float> source(3);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto x = source.draw();
        const float size = i % 2 == 0 ? 1.0f : 20.0f;
        const area r{size * x[0], size * x[1], size * x[2], size * x[3]};
        for (const auto& c : {grid_average<Table>(map.table(), 49, r), rectangle_average<Table>(map.table(), 49, r)}) {
            for (const double value : in_double<Table>(c)) REQUIRE((0 <= value && value <= 1));
            const float shadow = Table::intensity(c, 49, x[4]), z_b = Table::blocker(c, 49, x[4]);
            REQUIRE((0 <= shadow && shadow <= 1));
            REQUIRE((-1 <= z_b && z_b <= 1));
        }
    }
    const float n = nan_of<float>;
    for (const area& r : {area{-5, 2, 0, 4},
                          {19, 2, 25, 4},
                          {3, 11, 5, 40},
                          {3, -9, 5, -1},
                          {4, 4, 4, 9},
                          {9, 4, 3, 8},
                          {n, 1, 2, 3},
                          {1, n, 2, 3},
                          {1, 1, n, 3},
                          {1, 1, 2, n},
                          {n, n, n, n}})
        for (const auto& c : {grid_average<Table>(map.table(), 49, r), rectangle_average<Table>(map.table(), 49, r)}) {
            CHECK(double(Table::intensity(c, 49, 1.0f)) <= Table::darkening(49));
            CHECK(double(Table::intensity(c, 49, 0.9f)) <= Table::darkening(49));
            CHECK(Table::blocker(c, 49, 0.9f) > 0.89f); // the bias blocks a little
        }
}

#if defined(__cpp_exceptions)
TEST_CASE("passes refuse what does not fit before they write")
{
    using table = moments4_summed;
    std::vector<depths> source(12, depths{});
    std::vector<table::texel> texels(12, table::texel{1, 2, 3, 4}), row(4);
    const map_view<const depths> d{source, 4, 3};
    const map_view<table::texel> t{texels, 4, 3};
    CHECK_THROWS_AS(build_summed_area<table>(d, t, 3), std::invalid_argument);
    CHECK_THROWS_AS(build_summed_area<table>(d, t, summed_area_limit + 1), std::invalid_argument);
    CHECK_THROWS_AS(build_summed_area<table>(map_view<const depths>{source, 3, 4}, t, 49), std::invalid_argument);
    CHECK_THROWS_AS(build_summed_area<table>(d, map_view<table::texel>{texels, 4, 4}, 49), std::invalid_argument);
    CHECK_THROWS_AS(build_summed_area<table>(d, t, 49, {2, 4}, {}), std::invalid_argument);
    CHECK_THROWS_AS(build_summed_area<table>(d, t, 49, {1, 2}, std::span(row).first(3)), std::invalid_argument);
    CHECK_THROWS_AS(summed_area_total<table>(d, 49, {0, 3}, std::span(row).first(3)), std::invalid_argument);
    CHECK_THROWS_AS(summed_area_total<table>(d, 49, {0, 4}, std::span(row)), std::invalid_argument);
    for (const auto& texel : texels) CHECK(texel == table::texel{1, 2, 3, 4});
}
#endif
