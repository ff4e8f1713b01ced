#include "soft_comparison.hpp"

#include "renderer/shade/receivers.hpp"

#include <gnomon/filters/depth_bias.h>
#include <gnomon/moments/bounds.h>
#include <gnomon/passes/summed_area.hpp>
#include <gnomon/soft/penumbra.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

using table_texels = image<moments4_summed::texel>;

template <class T> auto view_of(const image<T>& source)
{
    return map_view<const T>{source.pixels, std::size_t(source.width), std::size_t(source.height)};
}

template <class Source> table_texels table_of(const image<Source>& source)
{
    table_texels result(source.width, source.height);
    const map_view<moments4_summed::texel> texels{result.pixels, std::size_t(source.width), std::size_t(source.height)};
    build_summed_area<moments4_summed>(view_of(source), texels, most_searched);
    return result;
}

// The gradient of depth per texel at a receiver, of a plane at 80 degrees at most.
gnomon::depth_gradient<float> gradient_of(const map_receiver& r, const camera& light, float size)
{
    const glm::dvec2 per_uv(r.depth_per_u, r.depth_per_v);
    const double slope = glm::length(0.25 * (light.far_distance - light.near_distance) * per_uv / light.half_extent);
    const glm::vec2 gradient = per_uv * std::min(1., steepest_slope / slope) / double(size);
    return {gradient.x, gradient.y};
}

float intensity_at(const map_receiver& r, const table_texels& table, const camera& light, const glm::vec2& scales)
{
    const auto size = float(table.width);
    const float x = r.u * size, y = r.v * size;
    const auto gradient = gradient_of(r, light, size);
    const auto widths = [&](float z_b) {
        return std::pair(penumbra_directional(r.depth, z_b, scales.x, widest_search),
                         penumbra_directional(r.depth, z_b, scales.y, widest_search));
    };
    constexpr auto most = float(most_searched);
    const auto [search_x, search_y] = widths(-1);
    const auto searched =
        grid_average<moments4_summed>(view_of(table), most_searched, summed_area_around(x, y, search_x, search_y));
    if (1 - umbra_share < moments4_summed::intensity(searched, most, r.depth)) return 1;
    const auto [width_x, width_y] = widths(moments4_summed::blocker(searched, most, r.depth));
    const auto filtered =
        rectangle_average<moments4_summed>(view_of(table), most_searched, summed_area_around(x, y, width_x, width_y));
    const float bias = depth_bias_receiver_plane(gradient, 0.5f * width_x + 1, 0.5f * width_y + 1, 2.f);
    return over_darken(moments4_summed::intensity(filtered, most, r.depth - bias), 1 - umbra_share);
}

image<float> visibility_from(const table_texels& table, const device_comparison& comparison, const camera& light,
                             const glm::vec2& scales)
{
    image<float> result(comparison.seen().width, comparison.seen().height, 1);
    const map_receivers& where = comparison.where();
    for (std::size_t i = 0; i < where.size(); ++i)
        result.pixels[where.pixels[i]] = 1 - intensity_at(where.unbiased[i], table, light, scales);
    return result;
}

} // namespace

std::optional<soft_comparison> compare_soft(const vulkan::device& gpu, const stage& scenery,
                                            const device_comparison& comparison, const settings& how)
{
    const vk::Extent2D extent{std::uint32_t(comparison.seen().width), std::uint32_t(comparison.seen().height)};
    const soft_renderer drawn(gpu, scenery, extent, how.map_resolution,
                              how.hlsl ? shading_language::hlsl : shading_language::glsl);
    if (!drawn.supported()) return {};
    soft_comparison result{.device = drawn.render(),
                           .host = {},
                           .look_up_tolerance = tolerance_of(gpu, 0),
                           .whole_tolerance = tolerance_of(gpu, 1),
                           .of_look_up = {},
                           .of_whole = {}};
    const table_texels exact = table_of(result.device.channels);
    for (std::size_t i = 0; i < exact.pixels.size(); ++i)
        if (exact.pixels[i] != result.device.table.pixels[i]) ++result.wrong_sums;

    const glm::vec2 scales = penumbra_scales(scenery, how.map_resolution);
    const image<float>& seen = result.device.frame.visibility;
    result.of_look_up = comparison.difference(
        seen, visibility_from(result.device.table, comparison, scenery.light, scales), result.look_up_tolerance);
    result.host = visibility_from(table_of(comparison.depths()), comparison, scenery.light, scales);
    result.of_whole = comparison.difference(seen, result.host, result.whole_tolerance);
    return result;
}

stage sunny_fence(double aspect)
{
    stage result = fence_stage(aspect);
    result.light_size = glm::dvec2(glm::radians(3.0));
    return result;
}

} // namespace gnomon::evaluation
