#include "range_device_map.hpp"

#include "renderer/raster/tile_bins.hpp"
#include "renderer/vulkan/exact_arithmetic.hpp"
#include "renderer/vulkan/scene.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

constexpr std::uint32_t group_size = 64; // invocations of a workgroup

struct fill_push {
    std::uint32_t texels, fills;
    float tolerance;
};
struct resolve_push {
    std::uint32_t texels, fills;
};
struct look_up_push {
    std::uint32_t begin, end, size, moves;
};

vk::Extent3D groups(std::uint32_t count) { return {(count + group_size - 1) / group_size, 1, 1}; }

// The triangles of a tile, and for each of its blocks the places of those that touch the block, one block after the other.
struct tile_triangles {
    std::vector<shading::tile_record> records;
    std::vector<std::uint32_t> counts, members;
};

int bits_of(const moving_setup& s)
{
    using namespace shading;
    return (s.positive ? side_positive : 0) | (s.negative ? side_negative : 0) | (s.linear ? depth_linear : 0) |
           (s.linear_edges.x ? edge_a_linear : 0) | (s.linear_edges.y ? edge_b_linear : 0) |
           (s.linear_edges.z ? edge_c_linear : 0);
}

shading::tile_record record_of(const moving_setup& s, const moving_tile& where)
{
    if (!s.between_planes)
        throw std::invalid_argument("range_device_map: triangle " + std::to_string(s.number) +
                                    " is not between the light's planes all of the time");
    constexpr double half = 0.5 * moving_tile_size;
    const auto equations = triangle_setup_make(s.corners, double(where.corner.x) + half, double(where.corner.y) + half);
    const auto exact = rounded_to<float>(equations);
    const edge_errors margins(exact, s.linear_edges, glm::vec2(float(half)));
    return {widen(exact, margins, 1),
            rounded_to<float>(depth_setup_make(equations, s.corners)),
            margins.a,
            margins.b,
            margins.c,
            float(s.number),
            bits_of(s)};
}

tile_triangles triangles_of(const tiled_triangles& scenery, std::size_t tile)
{
    tile_triangles result;
    scenery.for_each(tile, [&](const moving_setup& s) { result.records.push_back(record_of(s, scenery.tile(tile))); });
    tile_bins bins;
    bins.assign(scenery, tile);
    for (std::size_t block = 0; block < std::size_t(moving_blocks * moving_blocks); ++block) {
        const std::size_t before = result.members.size();
        bins.for_each(block, [&](const tile_triangle& t) {
            result.members.push_back(static_cast<std::uint32_t>(bins.index_of(t)));
        });
        result.counts.push_back(static_cast<std::uint32_t>(result.members.size() - before));
    }
    return result;
}

// A buffer with these values, or with one of no meaning where there are none.
template <class T> vulkan::buffer buffer_of(const vulkan::device& gpu, std::vector<T> values)
{
    if (values.empty()) values.emplace_back();
    return vulkan::filled<T>(gpu, values);
}

vulkan::buffer room_for(const vulkan::device& gpu, std::size_t ranges)
{
    return {gpu, std::max<std::size_t>(ranges, 1) * sizeof(depth_time_range<float>)};
}

std::size_t checked(int resolution)
{
    if (resolution < 1 || resolution % moving_tile_size != 0)
        throw std::invalid_argument("range_device_map: a map of " + std::to_string(resolution) +
                                    " texels along a side, not of whole tiles of " + std::to_string(moving_tile_size));
    return (std::size_t(resolution) * std::size_t(resolution) + 1) * sizeof(std::uint32_t);
}

} // namespace

range_device_map::range_device_map(const vulkan::device& gpu, const range_shaders& texts, const moving_scene& world,
                                   const moving_camera& light, int resolution, float depth_tolerance)
    : gpu_(gpu),
      resolution_(resolution),
      depth_tolerance_(depth_tolerance),
      first_(gpu, checked(resolution)),
      resolved_first_(gpu, checked(resolution))
{
    const tiled_triangles scenery(world, light, resolution, resolution, faces::both);
    std::vector<tile_triangles> tiles(scenery.tiles());
    tbb::parallel_for(std::size_t(0), tiles.size(), [&](std::size_t i) { tiles[i] = triangles_of(scenery, i); });
    std::vector<shading::tile_record> records;
    std::vector<std::uint32_t> blocks{0}, members;
    for (const tile_triangles& tile : tiles) {
        for (const std::uint32_t member : tile.members)
            members.push_back(static_cast<std::uint32_t>(records.size()) + member);
        for (const std::uint32_t count : tile.counts) blocks.push_back(blocks.back() + count);
        records.insert(records.end(), tile.records.begin(), tile.records.end());
    }
    records_.emplace(buffer_of(gpu, std::move(records)));
    blocks_.emplace(buffer_of(gpu, std::move(blocks)));
    members_.emplace(buffer_of(gpu, std::move(members)));
    scan_.emplace(gpu, vulkan::shader{vulkan::exact_arithmetic(texts.scan)}, std::vector<vulkan::resource>{first_},
                  sizeof(std::uint32_t));
    scan_resolved_.emplace(gpu, vulkan::shader{vulkan::exact_arithmetic(texts.scan)},
                           std::vector<vulkan::resource>{resolved_first_}, sizeof(std::uint32_t));

    // Counts say how much memory the ranges need, then those in front.
    const auto run = [&](std::size_t begin, std::size_t end) {
        const std::vector<named_pass> all = passes();
        gpu.run([&](const vk::raii::CommandBuffer& commands) {
            for (std::size_t i = begin; i < end; ++i) all[i].record(commands);
        });
    };
    const auto prepare = [&](std::size_t ranges, std::size_t resolved) {
        ranges_.emplace(room_for(gpu, ranges));
        resolved_.emplace(room_for(gpu, resolved));
        fill_.emplace(gpu, vulkan::shader{vulkan::exact_arithmetic(texts.fill)},
                      std::vector<vulkan::resource>{*records_, *blocks_, *members_, first_, *ranges_},
                      sizeof(fill_push));
        resolve_.emplace(gpu, vulkan::shader{vulkan::exact_arithmetic(texts.resolve)},
                         std::vector<vulkan::resource>{first_, *ranges_, resolved_first_, *resolved_},
                         sizeof(resolve_push));
    };
    prepare(0, 0);
    run(0, 2);
    const std::size_t ranges = first_.mapped<std::uint32_t>().back();
    prepare(ranges, 0);
    run(2, 5);
    prepare(ranges, resolved_first_.mapped<std::uint32_t>().back());
    run(2, 6);
}

std::vector<named_pass> range_device_map::passes() const
{
    const auto fills = [this](std::uint32_t writes) {
        return [this, writes](const vk::raii::CommandBuffer& commands) {
            fill_->record(commands, groups(texels()), vulkan::bytes_of(fill_push{texels(), writes, depth_tolerance_}));
        };
    };
    const auto resolves = [this](std::uint32_t writes) {
        return [this, writes](const vk::raii::CommandBuffer& commands) {
            resolve_->record(commands, groups(texels()), vulkan::bytes_of(resolve_push{texels(), writes}));
        };
    };
    const auto scans = [this](const std::optional<vulkan::compute_pass>& scan) {
        return [this, &scan](const vk::raii::CommandBuffer& commands) {
            scan->record(commands, {1, 1, 1}, vulkan::bytes_of(texels()));
        };
    };
    return {{"count", fills(0)},
            {"scan", scans(scan_)},
            {"fill", fills(1)},
            {"resolve_count", resolves(0)},
            {"resolve_scan", scans(scan_resolved_)},
            {"resolve", resolves(1)}};
}

range_map<float> range_device_map::view(const vulkan::buffer& first, const vulkan::buffer& ranges) const
{
    const auto side = std::size_t(resolution_);
    return {side, side, first.mapped<const std::uint32_t>(), ranges.mapped<const depth_time_range<float>>()};
}

range_look_up::range_look_up(const range_device_map& map, const range_shaders& texts,
                             std::span<const receiver_path<float>> receivers, std::size_t static_ones)
    : count_(static_cast<std::uint32_t>(receivers.size())),
      static_(static_cast<std::uint32_t>(static_ones)),
      size_(static_cast<std::uint32_t>(map.resolution())),
      receivers_(vulkan::filled(map.gpu(), receivers)),
      intensities_(map.gpu(), receivers.size() * sizeof(float)),
      look_up_(map.gpu(), {vulkan::exact_arithmetic(texts.look_up)},
               {map.resolved_first(), map.resolved_ranges(), receivers_, intensities_}, sizeof(look_up_push))
{}

named_pass range_look_up::pass() const
{
    return {"look_up", [this](const vk::raii::CommandBuffer& commands) {
                const auto some = [&](std::uint32_t begin, std::uint32_t end, std::uint32_t moves) {
                    if (begin < end)
                        look_up_.record(commands, groups(end - begin),
                                        vulkan::bytes_of(look_up_push{begin, end, size_, moves}));
                };
                some(0, static_, 0);
                some(static_, count_, 1);
            }};
}

} // namespace gnomon::evaluation
