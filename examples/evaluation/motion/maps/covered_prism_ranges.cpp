// The temporal shadow map of Hong & Oh 2017 by prisms, in their three passes: the nearest fragments, covers, and the
// ranges of all texels without one.
#include "evaluation/core/timing.hpp"
#include "evaluation/motion/range_method.hpp"
#include "loose_ranges.hpp"

#include <gnomon/comparators/three_pass_cover.h>

#include <algorithm>
#include <array>
#include <vector>

namespace gnomon::evaluation {

namespace {

// Calls visit(texel, fragment) for each.
template <class Visit> void for_each_fragment(const prism_rasterizer& prisms, const Visit& visit)
{
    using pack = prism_pack;
    prisms.for_each_pack([&](std::uint32_t number, std::uint32_t place, const auto& fragments) {
        for (const prism_fragment<pack>& f : fragments) {
            std::array<float, pack::size> covered, time, depth;
            f.covered.store_unaligned(covered.data());
            f.time.store_unaligned(time.data()), f.depth.store_unaligned(depth.data());
            for (std::uint32_t i = 0; i < pack::size; ++i)
                if (covered[i] > 0)
                    visit(prisms.texel(place + i), timed_fragment<float>{time[i], depth[i], float(number)});
        }
    });
}

class covered_prism_ranges final : public range_method {
  public:
    covered_prism_ranges()
        : range_method(
              {.id = "covered_prism_ranges", .family = "covered_prism_ranges", .label = "prism ranges with coverage"},
              {.variants = {{.receivers = {"stochastic"}}}, .curve = true})
    {}

    range_shadow_map build(map_source& from, const evaluation::parameters&) const override
    {
        range_shadow_map result = unresolved_lists(label, from.resolution);
        const std::size_t texels = texels_of(from.resolution);
        loose_ranges found;
        std::vector<timed_fragment<float>> nearest;
        std::vector<fragment_cover<float>> states;
        std::size_t fragments = 0;
        result.build_ms =
            1e3 * least_seconds([&] {
                const prism_rasterizer prisms(from.world, from.light, from.resolution);
                nearest.assign(texels, nearest_fragment_begin(1.f));
                for_each_fragment(
                    prisms, [&](std::uint32_t i, const auto& f) { nearest[i] = nearest_fragment_add(nearest[i], f); });
                states.resize(texels);
                std::ranges::transform(nearest, states.begin(), [](const auto& f) { return fragment_cover_begin(f); });
                for_each_fragment(
                    prisms, [&](std::uint32_t i, const auto& f) { states[i] = fragment_cover_add(states[i], f); });
                found.texels.clear(), found.ranges.clear(), result.covers = 0;
                std::vector<bool> covered(texels);
                for (std::uint32_t i = 0; i < texels; ++i) {
                    const auto cover = fragment_cover_end(states[i]);
                    covered[i] = cover.id >= 0;
                    if (!covered[i]) continue;
                    ++result.covers;
                    found.texels.push_back(i), found.ranges.push_back(cover);
                }
                fragments = add_prism_ranges(
                    prisms, [&](std::uint32_t i) { return !covered[i]; }, found);
                found.into(result);
            });
        result.pairs = found.ranges.size();
        // A cover is in the coverage map, by its id, and in the nearest map with the depths of its ends.
        constexpr std::size_t cover_bytes = 4 * sizeof(float);
        result.bytes = list_bytes(result);
        result.building_bytes = std::size_t(prism_map_bytes(
                                    double(fragments), double(found.ranges.size() - result.covers), double(texels))) +
                                cover_bytes * texels;
        return result;
    }
};

const registered<family> covered_prisms{
    family{.id = "covered_prism_ranges", .label = "prism ranges with coverage", .order = 120, .colour = "#9467bd"}};
const registered<covered_prism_ranges> entry;

} // namespace

} // namespace gnomon::evaluation
