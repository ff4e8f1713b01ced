#include "range_comparison.hpp"

#include "evaluation/motion/receivers/while_facing.hpp"

#include <gnomon/motion/range/range_front.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <span>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

using range = depth_time_range<float>;

// The look-up with this shutter is the general one, of any shutter.
struct box_by_kernels : box_shutter {};

// Parts of paths while they face the light, the static ones first.
class receiver_parts {
  public:
    explicit receiver_parts(std::span<const light_receiver> receivers) : receivers_(receivers)
    {
        std::vector<receiver_path<float>> parts;
        visit([&](std::size_t, const receiver_path<float>& path) {
            parts.push_back(path);
            return 0.f;
        });
        std::vector<std::size_t> order(parts.size());
        std::iota(order.begin(), order.end(), std::size_t(0));
        const auto moving =
            std::stable_partition(order.begin(), order.end(), [&](std::size_t i) { return is_static(parts[i]); });
        static_ = std::size_t(moving - order.begin());
        place_.resize(order.size());
        for (std::size_t k = 0; k < order.size(); ++k) {
            place_[order[k]] = k;
            paths_.push_back(parts[order[k]]);
        }
    }

    std::span<const receiver_path<float>> paths() const { return paths_; }
    std::size_t static_ones() const { return static_; }

    // The visibility of each receiver, from the intensities of the paths.
    std::vector<float> visibilities(std::span<const float> intensities) const
    {
        return visit([&](std::size_t i, const receiver_path<float>&) { return 1 - intensities[place_[i]]; });
    }

  private:
    static bool is_static(const receiver_path<float>& path)
    {
        return path.depth.z0 == path.depth.z1 && receiver_path_length(path) <= 1e-4f;
    }

    template <class Visit> std::vector<float> visit(const Visit& lit) const
    {
        std::size_t i = 0;
        std::vector<float> result;
        for (const light_receiver& r : receivers_)
            result.push_back(while_facing(r, [&](const receiver_path<float>& path) { return lit(i++, path); }));
        return result;
    }

    std::span<const light_receiver> receivers_;
    std::vector<receiver_path<float>> paths_;
    std::vector<std::size_t> place_;
    std::size_t static_ = 0;
};

template <class T> bool same_bits(const T& a, const T& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// Counts the ranges of each list that are none of the expected ones, or too few.
template <class Expected> bit_difference differences(const range_map<float>& lists, const Expected& expected_of)
{
    bit_difference result;
    for (std::size_t i = 0; i + 1 < lists.first.size(); ++i) {
        const std::span<const range> found = lists[i], expected = expected_of(i);
        result.all += expected.size();
        for (std::size_t k = 0; k < std::max(found.size(), expected.size()); ++k)
            result.differing += k >= found.size() || k >= expected.size() || !same_bits(found[k], expected[k]);
    }
    return result;
}

std::vector<range> walk(std::span<const range> list)
{
    std::vector<range> spans;
    for (float t = 0; !list.empty() && t < 1;) {
        range_front<float> state = range_front_begin(t);
        for (const range& r : list) state = range_front_compare(state, r);
        for (const range& r : list) state = range_front_limit(state, r);
        const range span = range_front_span(state);
        if (float(range_nothing) < span.id) spans.push_back(span);
        t = span.t1;
    }
    return spans;
}

float static_shadow(const range_map<float>& map, const receiver_path<float>& path)
{
    const texel_position<float> at = receiver_path_at(path, path.depth.t0);
    return static_intensity(map, at.x, at.y,
                            static_receiver_begin(path.depth.z0, path.depth.id, path.depth.t0, path.depth.t1));
}

template <class Shutter = box_shutter>
std::vector<float> intensities_in(const range_map<float>& map, const receiver_parts& parts)
{
    std::vector<float> result(parts.paths().size());
    tbb::parallel_for(std::size_t(0), result.size(), [&](std::size_t i) {
        const receiver_path<float>& path = parts.paths()[i];
        result[i] = i < parts.static_ones() ? static_shadow(map, path)
                                            : moving_intensity(map, path, path.depth.t0, path.depth.t1, 1, Shutter());
    });
    return result;
}

bit_difference differences(std::span<const float> found, std::span<const float> expected)
{
    bit_difference result{expected.size(), 0};
    for (std::size_t i = 0; i < expected.size(); ++i) result.differing += !same_bits(found[i], expected[i]);
    return result;
}

} // namespace

range_comparison compare_ranges(const vulkan::device& gpu, const range_shaders& texts, const moving_stage& stage,
                                const motion_sizes& size)
{
    range_comparison result;
    const int resolution = size.map_resolution;
    result.seen = camera_segments(stage.world, stage.eye, size.width, size.height, depth_tolerance);
    const std::vector<light_receiver> receivers = light_receivers_of(result.seen, stage.light, resolution);
    const receiver_parts parts(receivers);
    const range_device_map map(gpu, texts, stage.world, stage.light, resolution, depth_tolerance);
    const range_look_up look_up(map, texts, parts.paths(), parts.static_ones());
    std::vector<named_pass> passes = map.passes();
    passes.push_back(look_up.pass());
    result.device.passes = timed(gpu, passes);
    result.receivers = parts.paths().size();
    result.static_receivers = parts.static_ones();
    const range_map<float> lists = map.lists(), resolved = map.resolved();
    result.texels = std::size_t(resolution) * std::size_t(resolution);
    result.bytes = resolved.first.size_bytes() + resolved.ranges.size_bytes();

    const auto found = look_up.intensities();
    const std::vector<float> by_kernels = intensities_in<box_by_kernels>(resolved, parts);
    range_rasterizer rasterize;
    const range_lists& exact =
        rasterize(stage.world, stage.light, resolution, resolution, {.depth_tolerance = depth_tolerance});
    result.lists = differences(lists, [&](std::size_t i) { return exact.map()[i]; });
    std::vector<range> spans;
    result.resolved = differences(resolved, [&](std::size_t i) {
        spans = walk(lists[i]);
        return std::span<const range>(spans);
    });
    const std::size_t statics = parts.static_ones();
    result.static_look_ups = differences(found.first(statics), std::span(by_kernels).first(statics));
    result.moving_look_ups = differences(found.subspan(statics), std::span(by_kernels).subspan(statics));

    const range_lists& own = rasterize(stage.world, stage.light, resolution, resolution,
                                       {.resolved = true, .depth_tolerance = depth_tolerance});
    result.host_visibility = parts.visibilities(intensities_in(own.map(), parts));
    result.host = mean_visibility(result.seen, result.host_visibility);
    const std::vector<float> visibility = parts.visibilities(found);
    result.device.visibility = mean_visibility(result.seen, visibility);
    result.device.colour = shade(stage.world, stage.light, result.seen, visibility);
    std::vector<std::size_t> pixels;
    for (std::size_t pixel = 0; pixel < result.host.pixels.size(); ++pixel)
        if (!result.seen(pixel).empty()) pixels.push_back(pixel);
    result.of_whole = difference_of(result.device.visibility, result.host, pixels, range_tolerance);
    return result;
}

} // namespace gnomon::evaluation
