// The driver of the sweeps: a page with a map of each.
#include "evaluation/core/driver.hpp"
#include "sweep.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

namespace {

map_axis shown(const sweep_axis& a) { return {{.label = a.label, .scale = a.scale}, a.values()}; }

map_block block_of(const sweep& s)
{
    const std::vector<sweep_layer> layers = s.layers();
    map_block result{
        .title = s.label,
        .text = escaped(s.text),
        .name = s.id,
        .alt = fmt::format("A map for each method of its {} over {} and {}; where the method fails is outlined.",
                           s.error_label, s.x.label, s.y.label),
        .caption = fmt::format("A method fails where its {} exceeds {:g}.", s.error_label, s.threshold),
        .x = shown(s.x),
        .y = shown(s.y),
        .threshold = s.threshold,
        .label = s.error_label,
        .maps = std::vector<map_layer>(layers.size())};
    tbb::parallel_for(std::size_t(0), layers.size(), [&](std::size_t i) {
        result.maps[i].label = layers[i].label;
        for (const std::vector<double>& row : errors_of(s, layers[i]))
            result.maps[i].values.emplace_back(row.begin(), row.end());
    });
    return result;
}

void run(const settings& how)
{
    page result{
        .driver = "stability",
        .title = "Where methods fail",
        .family = "stability",
        .summary =
            "Single filter regions with an exact answer: two parameters vary, and the region in which a method is "
            "wrong by more than a threshold is outlined."};
    const std::vector<const sweep*> sweeps = registry_of<sweep>().all();
    steps all(result.driver, sweeps.size());
    for (const sweep* s : sweeps) {
        all.begin(s->id);
        result.blocks.emplace_back(block_of(*s));
    }
    write_page(how.out / "gallery" / result.driver, result);
}

const registered<driver> entry{
    driver{.id = "stability", .label = "where methods fail, by sweeps", .order = 25, .run = run}};

} // namespace

} // namespace gnomon::evaluation
