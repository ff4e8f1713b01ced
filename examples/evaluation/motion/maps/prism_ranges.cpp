// All ranges by prisms (Hong & Oh). Their formula (2) counts the fragments that are needed to build them, too.
#include "evaluation/core/timing.hpp"
#include "evaluation/motion/range_method.hpp"
#include "loose_ranges.hpp"

namespace gnomon::evaluation {

namespace {

class prism_ranges final : public range_method {
  public:
    prism_ranges()
        : range_method({.id = "prism_ranges", .family = "prism_ranges", .label = "prism ranges"},
                       {.variants = {{.receivers = {"stochastic"}}}, .curve = true})
    {}

    range_shadow_map build(map_source& from, const evaluation::parameters&) const override
    {
        range_shadow_map result = unresolved_lists(label, from.resolution);
        loose_ranges found;
        std::size_t fragments = 0;
        result.build_ms = 1e3 * least_seconds([&] {
                              found.texels.clear(), found.ranges.clear();
                              fragments = add_prism_ranges(
                                  {from.world, from.light, from.resolution}, [](std::uint32_t) { return true; }, found);
                              found.into(result);
                          });
        result.pairs = found.ranges.size();
        result.bytes = list_bytes(result);
        result.building_bytes = std::size_t(
            prism_map_bytes(double(fragments), double(found.ranges.size()), double(texels_of(from.resolution))));
        return result;
    }
};

const registered<family> prisms{
    family{.id = "prism_ranges", .label = "prism ranges", .order = 110, .colour = "#7f7f7f"}};
const registered<prism_ranges> entry;

} // namespace

} // namespace gnomon::evaluation
