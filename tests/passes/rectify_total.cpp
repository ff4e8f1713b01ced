// Rectified maps of what is no occluder, of any numbers in every argument, and of shapes that do not fit.
#include "support/effort.hpp"
#include "support/formats.hpp"

#include <gnomon/passes/rectify.hpp>

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

using view_bounds = rectified_frustum<float>;

TEST_CASE("nothing beside the map, on its far plane or without a number is an occluder")
{
    using format = moments4_unorm16;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float depth : {1.0f, 1.5f, HUGE_VALF, nan}) {
        const std::vector<float> depths(16, depth);
        std::vector<format::texel> moments(mip_texels(4, 4), texel_of_depth<format>(depth));
        for (const rectified_depth measure : {rectified_depth::polar, rectified_depth::cosine}) {
            const rectified_frame frame{8, 0, 1, measure};
            std::vector<rectified_row> rows(3);
            rectified_rows(frame, view_bounds{8, 0, 1, 0.5f, 1.5f}, 0.1f, 5, rows);
            for (const light_map& light : {light_map{2, 2, 0, 1, 1, 1}, {-90, 2, 0, 1, 1, 1}, {nan, 2, 0, 1, 1, 1}}) {
                std::vector<format::texel> texels(15), filtered(15), of_moments(15);
                rectify<format>({depths, 4, 4}, light, frame, rows, {texels, 5, 3}, {0, 3});
                rectify_filtered<format>({depths, 4, 4}, light, frame, rows, {filtered, 5, 3}, {0, 3});
                rectify_moments<format, format>({moments, 4, 4}, light, frame, rows, {of_moments, 5, 3}, {0, 3});
                for (const auto& map : {texels, filtered, of_moments})
                    for (const format::texel& t : map) REQUIRE(t == format::clear());
            }
        }
    }
}

TEST_CASE_TEMPLATE("any numbers give texels that shadow between nothing and all", Format, moments4_unorm16,
                   moments6_unorm10, moments4_float)
{
    hostile_source<float> source(4);
    bit_source bits(4);
    std::vector<float> depths(64);
    std::vector<moments4_float::texel> moments(mip_texels(8, 8));
    std::vector<format_texel<Format>> texels(12 * 3);
    std::vector<rectified_row> rows(3);
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const auto a = source.draw(), b = source.draw();
        depths[bits.below(64)] = a[6];
        moments[bits.below(moments.size())] = {a[0], a[1], a[2], a[3]};
        const light_map light{b[0], b[1], b[2], b[3], b[4], b[5]};
        const rectified_frame frame{b[6], a[4], a[5], i % 2 ? rectified_depth::polar : rectified_depth::cosine};
        rectified_rows(frame, view_bounds{b[6], a[4], a[5], a[2], a[3]}, a[1], 12, rows);
        rows[bits.below(3)].range.scale = a[0];
        const map_view<format_texel<Format>> map(texels, 12, 3);
        const auto check = [&] {
            for (const auto& t : texels) {
                const float shadow = Format::filtered_intensity(Format::decode(t), b[std::size_t(i) % 7]);
                REQUIRE((0 <= shadow && shadow <= 1));
                REQUIRE(are_known(Format::decode(t)));
            }
        };
        rectify<Format>({depths, 8, 8}, light, frame, rows, map, {0, 3});
        check();
        rectify_filtered<Format>({depths, 8, 8}, light, frame, rows, map, {0, 3});
        check();
        rectify_moments<Format, moments4_float>({moments, 8, 8}, light, frame, rows, map, {0, 3});
        check();
    }
}

#if defined(__cpp_exceptions)
TEST_CASE("shapes that do not fit are refused before anything is written")
{
    using format = moments4_float;
    std::vector<float> depths(48, 0.0f);
    std::vector<format::texel> texels(12, {1, 2, 3, 4}), moments(mip_texels(4, 3));
    const auto before = texels;
    const std::vector<rectified_row> rows(3);
    const light_map light;
    const rectified_frame frame{1, 0, 1};
    const auto refused = [&](map_view<const float> source, std::span<const rectified_row> r, map_view<format::texel> to,
                             row_range band) {
        CHECK_THROWS_AS(rectify<format>(source, light, frame, r, to, band), std::invalid_argument);
        CHECK_THROWS_AS(rectify_filtered<format>(source, light, frame, r, to, band), std::invalid_argument);
        CHECK(texels == before);
    };
    refused({depths, 4, 13}, rows, {texels, 4, 3}, {0, 3});
    refused({depths, 4, 3}, std::span(rows).first(2), {texels, 4, 3}, {0, 2});
    refused({depths, 4, 3}, rows, {texels, 4, 3}, {0, 4});
    refused({depths, 4, 3}, rows, {texels, 5, 3}, {0, 3});
    refused({std::span(texels[0].data(), 12), 4, 3}, rows, {texels, 4, 3}, {0, 3});
    const auto from_moments = [&](mip_view<const format::texel> source, std::span<const rectified_row> r) {
        CHECK_THROWS_AS((rectify_moments<format, format>(source, light, frame, r, {texels, 4, 3}, {0, 3})),
                        std::invalid_argument);
        CHECK(texels == before);
    };
    from_moments({std::span(moments).first(14), 4, 3}, rows);
    from_moments({moments, 4, 0}, rows);
    from_moments({texels, 2, 3}, rows);
    from_moments({moments, 4, 3}, std::span(rows).first(2));
    std::vector<float> numbers(48, 5.0f);
    CHECK_THROWS_AS(rectify_depths({numbers, 4, 3}, light, frame, rows, {std::span(numbers).subspan(8), 4, 3}, {0, 3}),
                    std::invalid_argument);
    CHECK_THROWS_AS(rectified_rows(frame, view_bounds{}, 0, 0, {}), std::invalid_argument);
}
#endif
