#include "study.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

namespace gnomon::evaluation {

namespace {

const registered<receiver_kind> layers{
    receiver_facts{.id = "layers", .label = "surfaces and layers of smoke, with a depth bias by slope", .order = 15}};

struct answers {
    numbers estimate, expected;

    void add(const numbers& estimated, const numbers& known, const std::vector<std::size_t>& receivers)
    {
        for (const std::size_t i : receivers) estimate.push_back(estimated[i]), expected.push_back(known[i]);
    }
};

// Standard deviation over seeds, and mean error. Answers of a seed are a run of the same length.
void set_noise(report_row& row, const answers& all)
{
    const auto seeds = static_cast<std::size_t>(row.seeds), count = all.estimate.size() / seeds;
    double variance = 0, error = 0;
    for (std::size_t i = 0; i < count; ++i) {
        double sum = 0, squares = 0;
        for (std::size_t s = 0; s < seeds; ++s) {
            const auto value = double(all.estimate[s * count + i]);
            sum += value, squares += value * value, error += value - double(all.expected[s * count + i]);
        }
        variance += std::max(0.0, squares - sum * sum / double(seeds)) / double(seeds - 1);
    }
    row.noise = std::sqrt(variance / double(count));
    row.bias = error / double(all.estimate.size());
}

} // namespace

std::vector<view_part> parts_of(const translucent_view& view, std::span<const view_inset> insets)
{
    const auto receivers_where = [&](const std::function<bool(const seen_receiver&)>& wanted) {
        std::vector<std::size_t> result;
        for (std::size_t i = 0; i < view.size(); ++i)
            if (wanted(view.receivers[i])) result.push_back(i);
        return result;
    };
    const auto mesh = [&](const seen_receiver& r) -> const renderer::mesh& {
        return view.scenery.world.meshes[static_cast<std::size_t>(r.mesh)];
    };
    const auto of_material = [&](material kind) {
        return receivers_where([&](const seen_receiver& r) { return material_of(mesh(r)) == kind; });
    };
    std::vector<view_part> result{
        {"", "all receivers", {}, receivers_where([](const seen_receiver&) { return true; })},
        {"surfaces", "opaque surfaces", {}, of_material(material::opaque)},
        {"pipes", "pipes", {}, receivers_where([&](const seen_receiver& r) { return mesh(r).name.ends_with("pipe"); })},
        {"pane", "panes of glass", {}, of_material(material::pane)},
        {"smoke", "layers of smoke", {}, of_material(material::smoke)}};
    const int width = view.seen.opaque.width;
    for (const view_inset& inset : insets)
        result.push_back({inset.id, inset.label, inset.colour, receivers_where([&](const seen_receiver& r) {
                              const int x = static_cast<int>(r.pixel) % width - inset.crop.x,
                                        y = static_cast<int>(r.pixel) / width - inset.crop.y;
                              return (material_of(mesh(r)) == material::smoke) == inset.of_smoke && x >= 0 &&
                                     x < inset.crop.width && y >= 0 && y < inset.crop.height;
                          })});
    std::erase_if(result, [](const view_part& p) { return p.receivers.empty(); });
    return result;
}

view_part behind_translucent_ones(const translucent_view& view, const known_visibility& traced)
{
    view_part result{"behind", "surfaces behind smoke or glass", {}, {}};
    for (std::size_t i = 0; i < view.size(); ++i) {
        const auto mesh = static_cast<std::size_t>(view.receivers[i].mesh);
        const float left = traced[colour::grey][i];
        if (view.scenery.world.meshes[mesh].opaque() && 0.001f < left && left < 0.999f) result.receivers.push_back(i);
    }
    return result;
}

std::vector<report_row> rows_of(const translucent_method& m, const translucent_view& view,
                                std::span<const view_part> parts, std::span<const known_visibility> references,
                                std::span<const shadows> by_seed, const showing& how)
{
    const std::span<const colour> colours = colours_of(m);
    std::vector<std::vector<numbers>> visibility; // of each seed, of each colour
    for (const shadows& one : by_seed) {
        visibility.emplace_back();
        for (std::size_t c = 0; c < colours.size(); ++c) visibility.back().push_back(one.visibility(view, c, how));
    }
    std::vector<report_row> result(parts.size() * references.size(), row_of(m));
    tbb::parallel_for(std::size_t(0), result.size(), [&](std::size_t k) {
        const view_part& part = parts[k / references.size()];
        const known_visibility& known = references[k % references.size()];
        answers all;
        for (const std::vector<numbers>& of_seed : visibility)
            for (std::size_t c = 0; c < colours.size(); ++c) all.add(of_seed[c], known[colours[c]], part.receivers);
        report_row& row = result[k];
        row.scene = view.scenery.world.name;
        row.part = part.id;
        row.receiver = layers->id;
        row.reference = known.reference;
        row.parameters.merge(how.parameters());
        row.receivers = static_cast<long long>(part.receivers.size());
        row.errors = compare(all.estimate, all.expected);
        row.seeds = static_cast<int>(by_seed.size());
        if (row.seeds > 1) set_noise(row, all);
    });
    return result;
}

} // namespace gnomon::evaluation
