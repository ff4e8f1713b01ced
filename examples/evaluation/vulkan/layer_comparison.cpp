#include "layer_comparison.hpp"

#include <gnomon/passes/layers/layer_accumulate.hpp>
#include <gnomon/passes/layers/layer_cluster.hpp>

#include <tbb/parallel_for.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

using format = layer_variance_float;
using sums = layer_sums<float>;

// Seeds of the light's samples and of the camera's.
constexpr std::uint32_t light_seed = 1, camera_seed = 2;

// The map of the CPU's passes.
struct host_map {
    explicit host_map(const sample_map<float>& samples)
        : clusters(tiles_along(samples.width, device_layers.tile) * tiles_along(samples.height, device_layers.tile)),
          first(clusters.size() + 1),
          blocks(tiles_along(samples.width, layer_block) * tiles_along(samples.height, layer_block))
    {
        const std::size_t rows = tiles_along(samples.height, device_layers.tile);
        const auto for_each_row = [&](const auto& f) {
            tbb::parallel_for(std::size_t(0), rows, [&](std::size_t row) { f(row_range{row, row + 1}); });
        };
        for_each_row([&](row_range some) { layer_cluster(samples, device_layers, clusters, some); });
        const layer_counts counts =
            layer_allocate(device_layers, clusters, samples.width, samples.height, first, blocks);
        grids.resize(counts.layers);
        texels.resize(counts.layers * layer_texels(device_layers));
        plain.resize(counts.blocks * block_texels(device_layers));
        map = {samples.width, samples.height, device_layers, first, blocks, grids, texels, plain};
        for_each_row([&](row_range some) { layer_accumulate<format>(samples, clusters, map, some); });
        for_each_row([&](row_range some) { layer_mips<format>(map, some); });
    }

    std::vector<float> intensities(std::span<const layer_receiver<float>> receivers, layer_tiles tiles) const
    {
        std::vector<float> result(receivers.size());
        tbb::parallel_for(std::size_t(0), result.size(), [&](std::size_t i) {
            result[i] = layer_intensity<format>(map, receivers[i], {.tiles = tiles});
        });
        return result;
    }

    std::vector<tile_clusters> clusters;
    std::vector<std::uint32_t> first, blocks;
    std::vector<layer_grid<float>> grids;
    std::vector<format_texel<format>> texels, plain;
    layer_map<format_texel<format>> map;
};

template <class T, class U> bool same_bits(const T& a, const U& b)
{
    static_assert(sizeof a == sizeof b);
    return std::memcmp(&a, &b, sizeof a) == 0;
}

template <class T, class U> bit_difference differences(std::span<const T> found, std::span<const U> expected)
{
    bit_difference result{expected.size(), 0};
    for (std::size_t i = 0; i < expected.size(); ++i)
        result.differing += i >= found.size() || !same_bits(found[i], expected[i]);
    return result;
}

bit_difference differences(std::span<const shading::tile_layers> found, std::span<const tile_clusters> expected)
{
    bit_difference result{expected.size(), 0};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const tile_clusters& e = expected[i];
        const std::array<float, 3> cuts{found[i].c0, found[i].c1, found[i].c2};
        result.differing +=
            !same_bits(cuts, e.cuts) || found[i].layers != e.layers || (found[i].moves == 0) != e.is_static;
    }
    return result;
}

// Texels of the blocks that are filled on the CPU.
bit_difference plain_differences(const layer_device_map& found, const host_map& expected)
{
    bit_difference result;
    const std::size_t across = expected.map.width / layer_block, size = block_texels(device_layers);
    for (std::size_t i = 0; i < expected.blocks.size(); ++i) {
        const bool is_stored = expected.blocks[i] != layer_no_block;
        result.differing += is_stored != (found.blocks()[i] == 1);
        if (!is_stored) continue;
        std::size_t level_begin = 0;
        for (std::size_t level = 0; level < block_levels(device_layers); ++level) {
            const std::size_t side = layer_block >> level, extent = expected.map.width >> level;
            const std::size_t begin = expected.blocks[i] * size + square_mip_begin(layer_block, level);
            for (std::size_t k = 0; k < side * side; ++k) {
                const std::size_t x = i % across * side + k % side, y = i / across * side + k / side;
                result.differing += !same_bits(found.plain()[level_begin + y * extent + x], expected.plain[begin + k]);
            }
            result.all += side * side;
            level_begin += extent * extent;
        }
    }
    return result;
}

// The second axis of a footprint is the pixel's longer one.
layer_receiver<float> receiver_of(const stochastic_receiver& r)
{
    const bool down = r.right_x * r.right_x + r.right_y * r.right_y < r.down_x * r.down_x + r.down_y * r.down_y;
    return {r.x,
            r.y,
            r.depth,
            r.t,
            r.x0,
            r.y0,
            r.t0,
            r.x1,
            r.y1,
            r.t1,
            down ? r.down_x : r.right_x,
            down ? r.down_y : r.right_y,
            r.slope,
            r.choice_x,
            r.choice_y};
}

// The visibility of each segment, from the intensities of those with receivers.
std::vector<float> visibilities(const stochastic_receivers& receivers, std::span<const float> intensities)
{
    std::vector<float> result = receivers.visibility;
    for (std::size_t i = 0; i < receivers.where.size(); ++i) result[receivers.segments[i]] = 1 - intensities[i];
    return result;
}

} // namespace

layer_comparison compare_layers(const vulkan::device& gpu, const layer_shaders& texts, const moving_stage& stage,
                                const layer_sizes& size)
{
    layer_comparison result;
    result.seen = camera_samples_of(stage, size.width, size.height, size.samples, camera_seed);
    const stochastic_receivers receivers = stochastic_receivers_of(result.seen, stage, size.map_resolution);
    std::vector<layer_receiver<float>> where;
    for (const stochastic_receiver& r : receivers.where) where.push_back(receiver_of(r));
    const sample_picture samples = rasterize_samples(stage.world, stage.light, size.map_resolution, size.map_resolution,
                                                     {size.samples, light_seed});

    const layer_device_map map(gpu, texts, samples.map());
    const layer_device_look_up random(map, texts, where, layer_tiles::random);
    std::vector<named_pass> passes = map.passes();
    passes.push_back(random.pass());
    result.device.passes = timed(gpu, passes);
    const host_map host(samples.map());
    result.clusters = differences(map.tiles(), std::span<const tile_clusters>(host.clusters));
    result.grids = differences(map.grids(), std::span<const layer_grid<float>>(host.grids));
    result.texels = differences(map.texels(), std::span<const format_texel<format>>(host.texels));
    result.plain = plain_differences(map, host);

    const std::vector<float> expected = host.intensities(where, layer_tiles::random);
    result.random = differences(random.intensities(), std::span<const float>(expected));
    const auto look_ups = [&](layer_tiles tiles) {
        const layer_device_look_up look_up(map, texts, where, tiles);
        gpu.run([pass = look_up.pass()](const vk::raii::CommandBuffer& commands) { pass.record(commands); });
        const std::vector<float> on_host = host.intensities(where, tiles);
        return differences(look_up.intensities(), std::span<const float>(on_host));
    };
    result.own = look_ups(layer_tiles::own);
    result.blended = look_ups(layer_tiles::blended);

    result.receivers = where.size();
    result.bytes = map.bytes();
    result.tiles = host.clusters.size();
    result.layers = host.grids.size();
    for (const tile_clusters& tile : host.clusters) result.plain_tiles += is_plain(tile);
    result.host_visibility = visibilities(receivers, expected);
    result.host = mean_visibility(result.seen.seen, result.host_visibility);
    const std::vector<float> visibility = visibilities(receivers, random.intensities());
    result.device.visibility = mean_visibility(result.seen.seen, visibility);
    result.device.colour = shade(stage.world, stage.light, result.seen.seen, visibility);
    std::vector<std::size_t> pixels;
    for (std::size_t pixel = 0; pixel < result.host.pixels.size(); ++pixel)
        if (!result.seen.seen(pixel).empty()) pixels.push_back(pixel);
    result.of_whole = difference_of(result.device.visibility, result.host, pixels, layer_tolerance);
    return result;
}

} // namespace gnomon::evaluation
