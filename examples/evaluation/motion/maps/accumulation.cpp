// Accumulation: the mean over ordinary shadow maps at the middles of equal parts of the shutter interval.
#include "evaluation/motion/accumulation.hpp"

#include "evaluation/core/timing.hpp"
#include "evaluation/motion/motion_method.hpp"

#include <fmt/format.h>

namespace gnomon::evaluation {

namespace {

const registered<family> accumulation_family{
    family{.id = "accumulation", .label = "accumulation", .order = 100, .colour = "#222222"}};
const registered<map_kind> depths_kind{
    map_kind{.id = "depths_at_times", .label = "shadow maps of some times", .order = 100}};
const registered<receiver_kind> times_of_maps{receiver_facts{
    .id = "at_times_of_maps", .label = "receivers at the times of the maps", .order = 100, .marker = "circle"}};

class accumulation final : public motion_method {
  public:
    accumulation()
        : motion_method({.id = "accumulation",
                         .family = "accumulation",
                         .label = "accumulation",
                         .map = depths_kind->id,
                         .format = {"f32_depth", "32 bit depth"}})
    {}

    void measure(motion_view& view, std::span<const std::string>, const outcome_sink& add) const override
    {
        for (const int count : {8, 16, 32, 64}) {
            accumulated_maps maps;
            map_facts facts = accumulation_facts(count, view.size.map_resolution);
            facts.build_ms = 1e3 * least_seconds([&] {
                                 maps = accumulate(view.stage.world, view.stage.light, view.size.map_resolution,
                                                   middle_times(count));
                             });
            const renderer::seen_motion seen = seen_at_times(view.paths, maps.times);
            const auto receivers = accumulated_receivers_of(seen, view.stage.light, maps);
            std::vector<float> visibility;
            const double spent = least_seconds([&] { accumulated_visibility(maps, receivers, visibility); });
            motion_outcome found{.row = row_of(*this, facts),
                                 .seen = seen,
                                 .visibility = in_order_of_segments(receivers, visibility, seen.segments.size()),
                                 .format = facts.format.label};
            found.row.receiver = times_of_maps->id;
            found.row.ns_per_receiver = view.per_receiver(spent);
            found.row.lanes = int(accumulation_pack::size);
            add(found);
        }
    }
};

const registered<accumulation> entry;

} // namespace

map_facts accumulation_facts(int count, int resolution)
{
    map_facts result;
    result.label = fmt::format("accumulation of {}", count);
    result.kind = entry->map;
    result.format = entry->format;
    result.parameters = {{"times", count}};
    result.resolution = resolution;
    result.bytes = std::size_t(resolution) * std::size_t(resolution) * std::size_t(count) * sizeof(float);
    return result;
}

} // namespace gnomon::evaluation
