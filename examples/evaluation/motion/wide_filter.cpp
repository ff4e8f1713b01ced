#include "wide_filter.hpp"

#include "accumulation.hpp"
#include "evaluation/core/timing.hpp"
#include "light_receivers.hpp"
#include "range_maps.hpp"
#include "renderer/scene/moving_stages.hpp"
#include "shadow_tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

constexpr int look_ups = 3, reference_maps = 256;

class wide_comparison {
  public:
    explicit wide_comparison(const motion_sizes& size)
        : stage_(crossed_quads(double(size.width) / size.height)),
          size_(size),
          seen_(renderer::camera_segments(stage_.world, stage_.eye, size.width, size.height, depth_tolerance)),
          reference_(size.width, size.height, 0)
    {
        image<float> shares(size.width, size.height, 0);
        for (const float time : middle_times(reference_maps)) {
            const accumulated_maps map = accumulate(stage_.world, stage_.light, size.map_resolution, {time});
            const seen_motion at_time = seen_at_times(seen_, map.times);
            const image<float> visibility =
                mean_visibility(at_time, look_up(map, at_time, [](auto&& run) { return seconds(run); }).visibility);
            for (std::size_t i = 0; i < shares.pixels.size(); ++i) {
                const float there = at_time(i).empty() ? 0.f : 1.f;
                shares.pixels[i] += there, reference_.pixels[i] += there * visibility.pixels[i];
            }
        }
        for (std::size_t i = 0; i < shares.pixels.size(); ++i) {
            if (!(shares.pixels[i] > 0) || seen_(i).empty()) continue;
            pixels_.push_back(i);
            reference_.pixels[i] /= shares.pixels[i];
        }
    }

    motion_results results()
    {
        results_.facts = {{"scene", stage_.world.open.name}, {"maps", reference_maps}, {"methods", {}}};
        for (const int count : {16, 64}) add_accumulation(count);
        add_ranges();
        return std::move(results_);
    }

  private:
    struct looked_up {
        std::vector<float> visibility; // per segment
        double seconds;
    };

    // Timed by measure(run).
    template <class Measure>
    looked_up look_up(const accumulated_maps& maps, const seen_motion& at_times, const Measure& measure) const
    {
        const auto receivers = accumulated_receivers_of(at_times, stage_.light, maps);
        std::vector<float> visibility;
        const double spent = measure([&] { accumulated_visibility(maps, receivers, visibility, look_ups); });
        return {in_order_of_segments(receivers, visibility, at_times.segments.size()), spent};
    }

    void add_accumulation(int count)
    {
        accumulated_maps maps;
        const double build = least_seconds(
            [&] { maps = accumulate(stage_.world, stage_.light, size_.map_resolution, middle_times(count)); });
        const seen_motion at_times = seen_at_times(seen_, maps.times);
        const looked_up found = look_up(maps, at_times, [](auto&& run) { return least_seconds(run); });
        const std::size_t texels = std::size_t(size_.map_resolution) * std::size_t(size_.map_resolution);
        add({.method = fmt::format("accumulation of {}", count),
             .format = "32 bit depth",
             .resolution = size_.map_resolution,
             .bytes = texels * std::size_t(count) * sizeof(float),
             .build_ms = 1e3 * build},
            int(accumulation_pack::size), found.seconds, mean_visibility(at_times, found.visibility));
    }

    void add_ranges()
    {
        const range_shadow_map map = resolved_ranges(stage_.world, stage_.light, size_.map_resolution);
        const std::vector<light_receiver> receivers = light_receivers_of(seen_, stage_.light, size_.map_resolution);
        std::vector<float> visibility(receivers.size());
        const double spent = least_seconds([&] {
            for (std::size_t i = 0; i < receivers.size(); ++i) visibility[i] = wide_visibility(map.map(), receivers[i]);
        });
        map_facts asked = map;
        asked.method += ", receivers analytic";
        add(asked, 1, spent, mean_visibility(seen_, visibility));
    }

    void add(const map_facts& map, int lanes, double seconds, const image<float>& estimate)
    {
        std::vector<float> found, expected;
        for (const std::size_t i : pixels_)
            found.push_back(estimate.pixels[i]), expected.push_back(reference_.pixels[i]);
        results_.rows.push_back({.scene = stage_.world.open.name,
                                 .method = map.method + ", 3 x 3",
                                 .format = map.format,
                                 .reference = "filtered",
                                 .receivers = static_cast<long long>(pixels_.size()),
                                 .bytes_per_texel = map.bytes_per_texel(),
                                 .errors = compare(found, expected),
                                 .ns_per_receiver = 1e9 * seconds / double(pixels_.size()),
                                 .build_ms = map.build_ms,
                                 .lanes = lanes});
        results_.facts["methods"].push_back(results_.rows.back().method);
    }

    moving_stage stage_;
    motion_sizes size_;
    seen_motion seen_;
    image<float> reference_;
    std::vector<std::size_t> pixels_; // that see a surface at some time
    motion_results results_;
};

} // namespace

motion_results compare_wide_filters(const motion_sizes& size) { return wide_comparison(size).results(); }

} // namespace gnomon::evaluation
