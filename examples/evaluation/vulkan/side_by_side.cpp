#include "side_by_side.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

// True if visibility changes by more than a sixteenth from this pixel to one of its neighbours.
bool at_edge(const image<float>& visibility, int x, int y)
{
    const auto [low, high] = [&] {
        std::pair range(visibility(x, y), visibility(x, y));
        for (int j = std::max(y - 1, 0); j <= std::min(y + 1, visibility.height - 1); ++j)
            for (int i = std::max(x - 1, 0); i <= std::min(x + 1, visibility.width - 1); ++i)
                range = {std::min(range.first, visibility(i, j)), std::max(range.second, visibility(i, j))};
        return range;
    }();
    return high - low > 0.0625f;
}

} // namespace

difference_statistics difference_of(const image<float>& device, const image<float>& host,
                                    std::span<const std::size_t> pixels, float tolerance)
{
    std::vector<float> estimates, references, values;
    double beyond = 0, beyond_inside = 0;
    for (const std::size_t pixel : pixels) {
        estimates.push_back(device.pixels[pixel]);
        references.push_back(host.pixels[pixel]);
        values.push_back(std::abs(estimates.back() - references.back()));
        if (values.back() <= tolerance) continue;
        beyond += 1;
        if (!at_edge(host, int(pixel) % host.width, int(pixel) / host.width)) beyond_inside += 1;
    }
    std::ranges::sort(values);
    const auto count = double(values.size());
    const auto percentile = [&](double share) { return double(values[std::size_t(share * (count - 1))]); };
    return {.errors = compare(estimates, references),
            .median = percentile(0.5),
            .p99 = percentile(0.99),
            .p999 = percentile(0.999),
            .beyond = beyond / count,
            .beyond_inside = beyond_inside / count};
}

float tolerance_of(const vulkan::device& gpu, float largest_weight)
{
    constexpr float storage = 0.01f;
    const bool coarse = 1 << gpu.physical().getProperties().limits.subPixelPrecisionBits < subpixels;
    return coarse ? storage + 0.25f * largest_weight : storage;
}

device_comparison::device_comparison(const vulkan::device& gpu, const stage& scenery, const settings& how)
    : tolerance_(tolerance_of(gpu, std::ranges::max(taps_))),
      depths_(rasterize_depth<4>(scenery.world, scenery.light, how.map_resolution, how.map_resolution)),
      seen_(rasterize_surfaces(scenery.world, scenery.eye, how.width * how.supersampling,
                               how.height * how.supersampling)),
      where_(map_receivers_of(seen_, scenery.light, how.map_resolution)),
      renderer_(gpu, scenery, {std::uint32_t(seen_.width), std::uint32_t(seen_.height)}, how.map_resolution, taps_,
                how.hlsl ? shading_language::hlsl : shading_language::glsl)
{}

side_by_side device_comparison::render(const filterable_method& m) const
{
    const std::unique_ptr<shadow_map> map = m.build(depths_, taps_);
    side_by_side result{{seen_.width, seen_.height, 1}, renderer_.render(device_method_of(m)), {}};
    std::vector<float> intensities(where_.size());
    map->intensities(where_.biased, intensities);
    for (std::size_t i = 0; i < where_.size(); ++i) result.host.pixels[where_.pixels[i]] = 1 - intensities[i];
    result.difference = difference(result.device.visibility, result.host, tolerance_);
    return result;
}

} // namespace gnomon::evaluation
