#include "blend_comparison.hpp"

#include "renderer/raster/rasterizer.hpp"

#include <gnomon/passes/blur.hpp>
#include <gnomon/passes/look_up.hpp>
#include <gnomon/passes/mips.hpp>
#include <gnomon/storage/moments4_blended.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

// What one blend may add to the difference, in codes.
double codes_per_blend(const vulkan::device& gpu)
{
    const int steps = 1 << gpu.physical().getProperties().limits.subPixelPrecisionBits;
    return 4 + 2 * std::max(1., double(subpixels) / steps);
}

// True if a neighbour has another number of layers.
bool at_edge(const image<std::size_t>& layers, int x, int y)
{
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, layers.height - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, layers.width - 1); ++i)
            if (layers(i, j) != layers(x, y)) return true;
    return false;
}

} // namespace

blend_difference compare_blend(const vulkan::device& gpu, const blended_frame& device,
                               std::span<const translucent_fragment> back_to_front)
{
    if (back_to_front.empty()) throw std::invalid_argument("compare_blend: no fragments");
    using texel = moments4_unorm16::texel;
    image<texel> host = device.opaque;
    const auto width = std::size_t(host.width), height = std::size_t(host.height);
    blend<moments4_unorm16>(map_view<texel>{host.pixels, width, height}, back_to_front);

    const double added = codes_per_blend(gpu);
    std::vector<double> allowed(host.pixels.size());
    image<std::size_t> layers(host.width, host.height);
    for (const translucent_fragment& f : back_to_front) {
        const std::size_t i = f.y * width + f.x;
        allowed[i] = (1 - double(f.alpha)) * allowed[i] + added;
        ++layers.pixels[i];
    }
    blend_difference result;
    double beyond = 0, beyond_inside = 0;
    for (std::size_t i = 0; i < host.pixels.size(); ++i) {
        if (layers.pixels[i] == 0) continue;
        double largest = 0;
        for (std::size_t k = 0; k < texel{}.size(); ++k) {
            const double difference = std::abs(double(device.blended.pixels[i][k]) - double(host.pixels[i][k]));
            result.mean += difference / double(texel{}.size());
            result.change +=
                std::abs(double(host.pixels[i][k]) - double(device.opaque.pixels[i][k])) / double(texel{}.size());
            largest = std::max(largest, difference);
        }
        ++result.texels;
        result.layers = std::max(result.layers, layers.pixels[i]);
        result.largest = std::max(result.largest, largest);
        result.mean_allowed += allowed[i];
        result.most_allowed = std::max(result.most_allowed, allowed[i]);
        if (largest <= allowed[i]) continue;
        beyond += 1;
        if (!at_edge(layers, int(i % width), int(i / width))) beyond_inside += 1;
    }
    const auto count = double(result.texels);
    result.mean /= count;
    result.change /= count;
    result.mean_allowed /= count;
    result.beyond = beyond / count;
    result.beyond_inside = beyond_inside / count;
    return result;
}

image<float> blended_visibility(const device_comparison& comparison,
                                std::span<const translucent_fragment> back_to_front, std::span<const float> taps)
{
    using format = moments4_unorm16;
    const depth_map& depths = comparison.depths();
    const auto width = std::size_t(depths.width), height = std::size_t(depths.height);
    std::vector<format::texel> texels(mip_texels(width, height));
    for (std::size_t i = 0; i < depths.pixels.size(); ++i) {
        channel_array<format> mean{};
        for (const float z : depths.pixels[i]) {
            const auto c = std::bit_cast<channel_array<format>>(format::from_depth(z));
            for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += 0.25f * c[k];
        }
        texels[i] = store_channels<format>(mean);
    }
    const mip_view<format::texel> mips{texels, width, height};
    const map_view<format::texel> map = mips.level(0);
    blend<format>(map, back_to_front);
    std::vector<format::texel> scratch(map.texels.size());
    blur<format>(map, {scratch, width, height}, map, taps);
    build_mips<format>(mips);

    image<float> result(comparison.seen().width, comparison.seen().height, 1);
    const map_receivers& where = comparison.where();
    for (std::size_t i = 0; i < where.size(); ++i) {
        const map_receiver& r = where.biased[i];
        const auto c = trilinear<format>({texels, width, height}, r.u * float(width), r.v * float(height), r.level);
        result.pixels[where.pixels[i]] = 1 - moments4_unorm16_blended_intensity(c, roundings, r.depth);
    }
    return result;
}

} // namespace gnomon::evaluation
