// Exact ranges without what a cover hides, as the temporal shadow map of Hong & Oh 2017, in one pass over the lists.
#include "covers.hpp"
#include "evaluation/motion/range_method.hpp"

namespace gnomon::evaluation {

namespace {

class covered_ranges final : public range_method {
  public:
    covered_ranges()
        : range_method({.id = "covered_ranges", .family = "covered_ranges", .label = "exact ranges with coverage"},
                       {.variants = {{.receivers = {"stochastic"}}}, .curve = true})
    {}

    range_shadow_map build(map_source& from, const evaluation::parameters&) const override
    {
        range_shadow_map result = unresolved_lists(label, from.resolution);
        cover(*from.map("exact_ranges"), result,
              [&](const uncut_range& found, const auto& list) { add_visible(found.whole, list, result.ranges); });
        return result;
    }
};

const registered<family> covered{
    family{.id = "covered_ranges", .label = "exact ranges with coverage", .order = 140, .colour = "#d62728"}};
const registered<covered_ranges> entry;

} // namespace

} // namespace gnomon::evaluation
