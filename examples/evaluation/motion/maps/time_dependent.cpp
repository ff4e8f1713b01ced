// Time-dependent shadow maps with the bias for slope and motion: 8 samples for each texel, and receivers at the camera's
// own times. What other numbers of samples and other biases do is a part of the page, parts/time_slices.cpp.
#include "evaluation/motion/motion_method.hpp"
#include "evaluation/motion/slices.hpp"

#include <fmt/format.h>

namespace gnomon::evaluation {

namespace {

constexpr int usual_slices = 8; // as Hong & Oh take for the cubes to the light

struct built_slices {
    map_facts facts;
    time_slices_map<time_dependent_sample<float>> map;
};

class time_dependent final : public motion_method {
  public:
    time_dependent()
        : motion_method({.id = "time_dependent",
                         .family = "time_slices",
                         .label = "time-dependent",
                         .map = slices_kind->id,
                         .format = {"f32_depth_travel", "32 bit depth, time, motion in depth and in texels"}})
    {}

    void measure(motion_view& view, std::span<const std::string>, const outcome_sink& add) const override
    {
        const built_slices built = build(view.maps);
        const slice_receivers receivers = slice_receivers_of(view.samples, view.stage.light, view.size.map_resolution);
        const receiver_kind& at_times = registry_of<receiver_kind>().at("stochastic");
        motion_outcome found{.row = row_of(*this, built.facts),
                             .seen = view.samples,
                             .visibility = std::vector<float>(view.samples.segments.size()),
                             .format = format.label};
        const double spent = least_seconds([&] { slice_visibility(built.map, receivers, 0, found.visibility); });
        found.row.receiver = at_times.id;
        found.row.parameters["times"] = stochastic_samples;
        found.row.label += ", " + at_times.label;
        found.row.ns_per_receiver = view.per_receiver(spent);
        add(found);
    }

    std::optional<map_facts> costs(map_source& from) const override { return build(from).facts; }

  private:
    built_slices build(const map_source& from) const
    {
        renderer::sample_picture samples;
        const double spent = seconds_on_one_core([&] {
            samples = renderer::rasterize_samples(from.world, from.light, from.resolution, from.resolution,
                                                  {.samples = usual_slices, .seed = 1}); // the camera has another
        });
        built_slices result{{}, time_slices_map<time_dependent_sample<float>>(samples)};
        result.facts.label = fmt::format("{} of {}", label, usual_slices);
        result.facts.kind = map;
        result.facts.format = format;
        result.facts.resolution = from.resolution;
        result.facts.parameters = {{"samples", usual_slices}};
        result.facts.bytes = result.map.bytes();
        result.facts.build_ms = 1e3 * spent + result.map.filling_ms;
        return result;
    }
};

const registered<time_dependent> entry;

} // namespace

} // namespace gnomon::evaluation
