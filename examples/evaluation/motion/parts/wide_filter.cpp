// Percentage-closer filtering of 3 x 3 bilinear look-ups while the shutter is open, against the mean over very many
// shadow maps under the same filter: the errors are those of time alone.
#include "evaluation/core/progress.hpp"
#include "evaluation/core/timing.hpp"
#include "evaluation/motion/accumulation.hpp"
#include "evaluation/motion/motion_method.hpp"
#include "evaluation/motion/motion_part.hpp"
#include "evaluation/motion/receivers/analytic.hpp"
#include "evaluation/motion/scene_blocks.hpp"
#include "renderer/scene/moving_stages.hpp"

#include <fmt/format.h>

#include <memory>
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

    std::vector<report_row> rows()
    {
        for (const int count : {16, 64}) add_accumulation(count);
        add_ranges();
        return std::move(rows_);
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
        map_facts facts = accumulation_facts(count, size_.map_resolution);
        facts.build_ms = 1e3 * least_seconds([&] {
                             maps = accumulate(stage_.world, stage_.light, size_.map_resolution, middle_times(count));
                         });
        const seen_motion at_times = seen_at_times(seen_, maps.times);
        const looked_up found = look_up(maps, at_times, [](auto&& run) { return least_seconds(run); });
        report_row row = row_of(registry_of<method>().at("accumulation"), facts);
        row.lanes = int(accumulation_pack::size);
        add(std::move(row), "at_times_of_maps", found.seconds, mean_visibility(at_times, found.visibility));
    }

    void add_ranges()
    {
        map_source maps(stage_.world, stage_.light, size_.map_resolution);
        const auto& of = registry_of<method>().at("resolved_ranges");
        const auto map = maps.map(of.id);
        const std::vector<light_receiver> receivers = light_receivers_of(seen_, stage_.light, size_.map_resolution);
        std::vector<float> visibility(receivers.size());
        const double spent = least_seconds([&] {
            for (std::size_t i = 0; i < receivers.size(); ++i)
                visibility[i] = wide_visibility(map->map(), receivers[i]);
        });
        add(row_of(of, *map), "analytic", spent, mean_visibility(seen_, visibility));
    }

    void add(report_row row, const char* receiver, double seconds, const image<float>& estimate)
    {
        std::vector<float> found, expected;
        for (const std::size_t i : pixels_)
            found.push_back(estimate.pixels[i]), expected.push_back(reference_.pixels[i]);
        row.scene = "crossed_quads";
        row.receiver = receiver;
        row.parameters["look_ups"] = look_ups;
        row.label += fmt::format(", {}, {} x {}", registry_of<receiver_kind>().at(receiver).label, look_ups, look_ups);
        row.reference = "filtered";
        row.receivers = static_cast<long long>(pixels_.size());
        row.errors = compare(found, expected);
        row.ns_per_receiver = 1e9 * seconds / double(pixels_.size());
        rows_.push_back(std::move(row));
    }

    moving_stage stage_;
    motion_sizes size_;
    seen_motion seen_;
    image<float> reference_;
    std::vector<std::size_t> pixels_; // that see a surface at some time
    std::vector<report_row> rows_;
};

block table_of_filters(const std::vector<report_row>& rows)
{
    table_block table{
        .title = "A wider filter",
        .text = fmt::format(
            "Crossed quads by percentage-closer filtering of {} x {} bilinear look-ups, against the mean over "
            "{} shadow maps under the same filter: the errors are those of time alone, in thousandths of "
            "visibility.",
            look_ups, look_ups, reference_maps),
        .columns = {{.key = "method", .label = "method"},
                    error_column("rmse", "RMSE"),
                    error_column("largest", "largest error", 1),
                    number_column("ns", "ns per receiver", 0, best::low),
                    number_column("build", "map, ms", 1, best::low)},
        .rows = {}};
    for (const report_row& row : rows)
        table.rows.push_back({.cells = {{"method", row.label},
                                        {"rmse", row.errors.rmse},
                                        {"largest", row.errors.max_abs},
                                        {"ns", row.ns_per_receiver},
                                        {"build", row.build_ms}}});
    return table;
}

part_run wide_filter(const motion_settings& how)
{
    const auto found = std::make_shared<std::vector<report_row>>();
    return {.tasks = {[=, size = how.size] { *found = wide_comparison(size).rows(); }},
            .results = [=] { return part_results{.rows = *found, .blocks = {table_of_filters(*found)}}; }};
}

const registered<motion_part> entry{
    motion_part{.id = "wide_filter", .label = "a wider filter", .order = 20, .begin = wide_filter}};

} // namespace

} // namespace gnomon::evaluation
