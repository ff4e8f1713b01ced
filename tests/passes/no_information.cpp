// NaN is no information, and lit: in a channel, a texel, a map, a position, a level and a depth, for every storage format,
// pass and look-up. A NaN darkens nothing, and changes no texel and no look-up in which it has no weight.
#include "support/climber.hpp"
#include "support/effort.hpp"
#include "support/formats.hpp"

#include <gnomon/passes/blur.hpp>
#include <gnomon/passes/look_up.hpp>
#include <gnomon/passes/range/look_up.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();

/// The first is NaN; others are numbers that no depth gives.
constexpr std::array hostile_numbers{nan_value, infinity, -infinity, 3e38f, -3e38f, 1e-42f, -1.0f, 65520.0f};

/// A map with one hostile texel, and the same map with the border in its place.
template <class Format> struct hostile_map {
    using texel = format_texel<Format>;
    std::size_t width, height, x, y;
    float number;
    std::vector<texel> texels, lit;
    bool all_channels;

    explicit hostile_map(bit_source& bits) : width(1 + bits.below(12)), height(1 + bits.below(12))
    {
        x = bits.below(width), y = bits.below(height);
        number = hostile_numbers[bits.chance(0.5) ? 0 : bits.below(hostile_numbers.size())];
        all_channels = bits.chance(0.5);
        texels.resize(mip_texels(width, height));
        for (std::size_t i = 0; i < width * height; ++i) texels[i] = texel_of_depth<Format>(float(bits.uniform(-1, 1)));
        lit = texels;
        lit[y * width + x] = Format::clear();
        texels[y * width + x] =
            texel_with<Format>(float(bits.uniform(-1, 1)), number, bits.below(channel_count<Format>), all_channels);
    }
    [[nodiscard]] bool is_nan() const { return std::isnan(number); }
    mip_view<texel> mips() { return {texels, width, height}; }
    mip_view<texel> lit_mips() { return {lit, width, height}; }
};

double distance(std::size_t a, std::size_t b) { return std::abs(double(a) - double(b)); }

template <class Format> void check_unit(const format_channels<Format>& c, bit_source& bits)
{
    for (const float z_f : {float(bits.uniform(-1.5, 1.5)), 1.0f, infinity, nan_value})
        for (const float intensity : {Format::intensity(c, z_f), Format::filtered_intensity(c, z_f)})
            REQUIRE((0 <= intensity && intensity <= 1));
}

template <class Format> void check_lit(const format_channels<Format>& c, bit_source& bits)
{
    for (const float z_f : {float(bits.uniform(-1, 1)), 1.0f, infinity, nan_value})
        REQUIRE(larger_intensity<Format>(c, z_f) <= larger_darkening<Format>());
}

} // namespace

TEST_CASE("channels with a NaN are stored as the border")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        bit_source bits(1);
        for (std::int64_t i = 0; i < effort(2'000); ++i) {
            auto c = gnomon_bit_cast<channel_array<Format>>(Format::from_depth(float(bits.uniform(-1, 1))));
            const std::uint32_t sign = bits.chance(0.5) ? 0x80000000 : 0;
            const float x = gnomon_bit_cast<float>(sign | (0x7f800001 + std::uint32_t(bits.below(0x7fffff))));
            if (bits.chance(0.2)) c.fill(x);
            else c[bits.below(c.size())] = x;
            REQUIRE(same_bytes(store_channels<Format>(c), Format::clear()));
            check_unit<Format>(gnomon_bit_cast<format_channels<Format>>(c), bits);
        }
        channel_array<Format> none;
        none.fill(nan_value);
        check_lit<Format>(gnomon_bit_cast<format_channels<Format>>(none), bits);
        check_lit<Format>(Format::decode(Format::clear()), bits);
        CHECK(same_bytes(texel_of_depth<Format>(nan_value), Format::clear()));
    });
}

TEST_CASE("a blur changes texels within its radius of a hostile one alone; a NaN becomes the border")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        bit_source bits(2);
        for (std::int64_t i = 0; i < effort(300); ++i) {
            hostile_map<Format> map(bits);
            const std::size_t width = map.width, height = map.height, radius = bits.below(4);
            std::vector<float> weights(2 * radius + 1, 1 / float(2 * radius + 1));
            const bool middle_alone = bits.chance(0.2); // 0 times NaN is NaN, but no weight is none
            if (middle_alone)
                for (std::size_t k = 0; k < weights.size(); ++k) weights[k] = k == radius ? 1 : 0;
            const double reach = middle_alone ? 0 : double(radius);
            const border_mode mode = bits.chance(0.5) ? border_mode::lit : border_mode::clamp;
            std::vector<format_texel<Format>> scratch(width * height), hostile(scratch), lit(scratch);
            const auto compare = [&](double reach_x, double reach_y, const auto& filter) {
                filter(map.mips().level(0), hostile), filter(map.lit_mips().level(0), lit);
                for (std::size_t k = 0; k < hostile.size(); ++k) {
                    check_unit<Format>(Format::decode(hostile[k]), bits);
                    const double away_x = distance(k % width, map.x), away_y = distance(k / width, map.y);
                    if (!(away_x <= reach_x && away_y <= reach_y)) REQUIRE(same_bytes(hostile[k], lit[k]));
                    else if (map.is_nan() && !holds_nan<Format>()) REQUIRE(same_bytes(hostile[k], lit[k]));
                    else if (map.is_nan() && !(reach_x * reach_y > 0)) REQUIRE(same_bytes(hostile[k], Format::clear()));
                }
            };
            using texels = std::vector<format_texel<Format>>;
            const auto view = [&](texels& t) { return map_view<format_texel<Format>>(t, width, height); };
            compare(reach, 0, [&](const auto& m, texels& t) {
                blur_along_x<Format>(m, view(t), weights, {0, height}, mode);
            });
            compare(0, reach, [&](const auto& m, texels& t) {
                blur_along_y<Format>(m, view(t), weights, {0, height}, mode);
            });
            compare(reach, reach,
                    [&](const auto& m, texels& t) { blur<Format>(m, view(scratch), view(t), weights, mode); });
        }
    });
}

TEST_CASE("mips and look-ups in which a hostile texel has no weight are unchanged; NaN gives lit")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        bit_source bits(3);
        for (std::int64_t i = 0; i < effort(300); ++i) {
            hostile_map<Format> map(bits);
            build_mips<Format>(map.mips()), build_mips<Format>(map.lit_mips());
            std::vector<bool> touched(map.texels.size());
            for (std::size_t k = 0; k < touched.size(); ++k) {
                touched[k] = !same_bytes(map.texels[k], map.lit[k]);
                check_unit<Format>(Format::decode(map.texels[k]), bits);
            }
            // A level's texel covers at most the texels 2 i to 2 i + 2 of the level below.
            for (std::size_t level = 1, x = map.x, y = map.y; level < map.mips().levels(); ++level) {
                const auto here = map.mips().level(level);
                const auto offset = std::size_t(here.texels.data() - map.texels.data());
                for (std::size_t k = 0; k < here.texels.size(); ++k)
                    if (touched[offset + k]) {
                        const double scale = std::ldexp(1, int(level));
                        const double reach = 2 * scale; // odd extents cover a texel more at each level
                        REQUIRE(std::abs(double(k % here.width) * scale - double(x)) <= reach);
                        REQUIRE(std::abs(double(k / here.width) * scale - double(y)) <= reach);
                        if (level == 1 && map.is_nan() && holds_nan<Format>())
                            REQUIRE(same_bytes(here.texels[k], Format::clear()));
                    }
            }
            const border_mode mode = bits.chance(0.5) ? border_mode::lit : border_mode::clamp;
            for (int n = 0; n < 8; ++n) {
                const double steps = bits.chance(0.5) ? 2 : 1024; // often on a texel's centre
                const auto place = [&](std::size_t extent) {
                    return float(std::floor(bits.uniform(-1, double(extent) + 1) * steps) / steps);
                };
                const float x = place(map.width), y = place(map.height), level = float(bits.uniform(0, 5));
                const auto weight = [&](float at, std::size_t texel, std::size_t extent) {
                    const double margin = mode == border_mode::lit ? 1 : 0;
                    const double centre = std::clamp(double(at) - 0.5, -margin, double(extent) - 1 + margin);
                    return std::max(0.0, 1 - std::abs(centre - double(texel)));
                };
                const auto c = bilinear<Format>(map.mips().level(0), x, y, mode);
                const auto lit = bilinear<Format>(map.lit_mips().level(0), x, y, mode);
                check_unit<Format>(c, bits);
                check_unit<Format>(trilinear<Format>(map.mips(), x, y, level, mode), bits);
                const double share = weight(x, map.x, map.width) * weight(y, map.y, map.height);
                if (!(share > 0)) REQUIRE(same_bytes(c, lit));
                else if (map.is_nan() && (map.all_channels || !holds_nan<Format>())) {
                    if (!holds_nan<Format>()) REQUIRE(same_bytes(c, lit));
                    else check_lit<Format>(c, bits);
                }
            }
        }
    });
}

TEST_CASE("a position or level of NaN, and a map without texels, are lit")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        std::vector<format_texel<Format>> texels(mip_texels(4, 4), texel_of_depth<Format>(-1));
        const mip_view<format_texel<Format>> mips{texels, 4, 4}, none{};
        const auto border = stored_border<Format>();
        for (const border_mode mode : {border_mode::clamp, border_mode::lit}) {
            CHECK(same_bytes(bilinear<Format>(mips.level(0), nan_value, 2, mode), border));
            CHECK(same_bytes(bilinear<Format>(mips.level(0), 2, nan_value, mode), border));
            CHECK(same_bytes(bilinear<Format>({}, 2, 2, mode), border));
            CHECK(same_bytes(trilinear<Format>(mips, nan_value, 2, 0, mode), border));
            CHECK(same_bytes(trilinear<Format>(mips, 2, nan_value, 0, mode), border));
            CHECK(same_bytes(trilinear<Format>(mips, 2, 2, nan_value, mode), border));
            CHECK(same_bytes(trilinear<Format>(none, 2, 2, 0, mode), border));
            for (const float level : {-infinity, -1.0f, 3e38f, infinity})
                CHECK(larger_intensity<Format>(trilinear<Format>(mips, 2, 2, level, mode), 1.0f) >= 0.94);
        }
    });
}

// Four texels, of which one has a NaN, at any place and before any receiver.
TEST_CASE("no search finds a NaN that darkens a lit surface")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        const summit found = climb(10, 20'000, 4, [](const std::vector<double>& p) {
            std::array<format_texel<Format>, 4> texels;
            std::array<float, 4> depths;
            for (std::size_t k = 0; k < 4; ++k) {
                depths[k] = float(2 * p[k] - 1);
                texels[k] = texel_of_depth<Format>(depths[k]);
            }
            const auto bad = std::min<std::size_t>(std::size_t(4 * p[4]), 3);
            const auto channel = std::min(std::size_t(double(channel_count<Format>) * p[5]), channel_count<Format> - 1);
            // Channels that are valid beside the NaN may bound the intensity from below, as those of another warp do.
            texels[bad] = texel_with<Format>(depths[bad], nan_value, channel, p[6] < 0.5);
            const float x = float(0.5 + p[7]), y = float(0.5 + p[8]);
            const std::array weights{(1.5f - x) * (1.5f - y), (x - 0.5f) * (1.5f - y), (1.5f - x) * (y - 0.5f),
                                     (x - 0.5f) * (y - 0.5f)};
            const float z_f = float(2.2 * p[9] - 1.1);
            double truth = 0;
            for (std::size_t k = 0; k < 4; ++k)
                if ((k != bad || p[6] >= 0.5) && depths[k] < z_f) truth += double(weights[k]);
            // Moments alone are honest in half shadows; all formats are where nothing is in front.
            if (!requires { Format::bias; } && truth > 0) return -1.0;
            const auto c = bilinear<Format>({texels, 2, 2}, x, y);
            return double(Format::filtered_intensity(c, z_f)) - truth - double(Format::filtered_darkening);
        });
        // Weights in float sum to 1 within four roundings.
        CHECK_MESSAGE(found.score <= 0x1p-22, found.score);
    });
}

TEST_CASE("ranges with a NaN take no light from a receiver in a map of ranges")
{
    bit_source bits(5);
    for (std::int64_t i = 0; i < effort(2'000); ++i) {
        depth_time_range<float> r{0, 1, -0.5f, -0.5f, 3};
        for (float* x : {&r.t0, &r.t1, &r.z0, &r.z1})
            if (bits.chance(0.4)) *x = nan_value;
        const bool known = r.t0 + r.t1 + r.z0 + r.z1 <= infinity;
        std::vector<std::uint32_t> first(range_map<float>::texels(1, 1) + 1, 1);
        first[0] = 0;
        const std::array ranges{r};
        std::vector<range_summary<float>> summaries(first.size() - 1);
        range_map<float> map{1, 1, first, ranges};
        if (bits.chance(0.5)) {
            set_summaries(map, std::span(summaries), range_ids::any);
            map.summaries = summaries;
        }
        const float static_one = static_intensity(map, 0.5f, 0.5f, static_receiver_begin(0.f, 1.f, 0.f, 1.f));
        const receiver_path<float> path{{0, 1, 0, 0, 1}, 0.5f, 0.5f, 1, 0.5f, 0.5f, 1};
        for (const float intensity :
             {static_one, moving_intensity(map, path, 0.f, 1.f), intensity_at(map, path, 0.5f, 0.f)}) {
            REQUIRE(intensity >= 0);
            REQUIRE(intensity <= (known ? 1 : 0));
            if (known) REQUIRE(intensity == 1);
        }
    }
}
