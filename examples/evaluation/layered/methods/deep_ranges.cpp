// The deep shadow map that more and more samples converge to, in closed form from resolved ranges.
#include "deep_layers.hpp"
#include "evaluation/core/timing.hpp"

namespace gnomon::evaluation {

namespace {

class layers_of_ranges final : public deep_layers {
  public:
    layers_of_ranges(const range_shadow_map& ranges, float tolerance)
    {
        resolution = ranges.resolution;
        sampling_ms = ranges.build_ms;
        conversion_ms = 1e3 * seconds_on_one_core([&] { compress(ranges.map(), tolerance); });
    }
};

class deep_ranges final : public layered_method {
  public:
    deep_ranges()
        : layered_method({.id = "deep_ranges",
                          .family = "deep",
                          .label = "deep, in closed form",
                          .order = 41,
                          .map = deep_kind->id,
                          .format = {"deep_12b", "12 B layers"}},
                         {{.parameters = {{"tolerance", usual_deep_tolerance}},
                           .comparisons = {equal_input, equal_time, equal_memory},
                           .without = "dense"},
                          {.parameters = {{"tolerance", 0}},
                           .label = "tolerance 0",
                           .comparisons = {of_settings},
                           .without = "settings"},
                          {.parameters = {{"tolerance", 0.05}},
                           .label = "tolerance .05",
                           .comparisons = {of_settings},
                           .without = "settings"}},
                         false)
    {}

    std::unique_ptr<layered_map> build(layered_input& from, const evaluation::parameters& how) const override
    {
        const auto ranges = from.ranges().map("resolved_ranges");
        return std::make_unique<layers_of_ranges>(*ranges, float(how.at("tolerance")));
    }
};

const registered<deep_ranges> entry;

} // namespace

} // namespace gnomon::evaluation
