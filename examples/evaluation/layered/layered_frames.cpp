#include "layered_frames.hpp"

#include "evaluation/core/timing.hpp"
#include "evaluation/motion/scene_blocks.hpp"
#include "layered_view.hpp"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

constexpr float change_scale = 0.25f; // of visibility, at which colours of changes saturate
constexpr float shutter = 0.5f;       // of a frame, in the scene's

// The scene from time t0 to time t1.
moving_stage exposed(const moving_stage& all, float t0, float t1)
{
    moving_stage result = all;
    for (std::size_t m = 0; m < all.world.open.meshes.size(); ++m) {
        if (!all.world.moves(m)) continue;
        const auto& open = all.world.open.meshes[m].positions;
        for (std::size_t i = 0; i < open.size(); ++i) {
            result.world.open.meshes[m].positions[i] = glm::mix(open[i], all.world.closing[m][i], t0);
            result.world.closing[m][i] = glm::mix(open[i], all.world.closing[m][i], t1);
        }
        result.world.open.meshes[m].normals.clear();
    }
    const auto part = [&](moving_camera whole) {
        return moving_camera{whole.at(double(t0)), double(t1 - t0) * whole.motion};
    };
    result.light = part(all.light), result.eye = part({all.eye});
    return result;
}

struct cost {
    double bytes, texels, look_up_ns; // of the map, and of one look-up
};

struct frame {
    std::map<std::size_t, float> reference; // of pixels that see a surface all of the time
    std::vector<image<float>> estimates;    // one for each method
    std::vector<cost> costs;
};

// Changes of pixels that two successive frames see, pair after pair.
std::vector<float> changes(std::span<const frame> frames, const std::function<float(const frame&, std::size_t)>& value)
{
    std::vector<float> result;
    for (std::size_t f = 0; f + 1 < frames.size(); ++f)
        for (const auto& [pixel, unused] : frames[f].reference)
            if (frames[f + 1].reference.contains(pixel))
                result.push_back(value(frames[f + 1], pixel) - value(frames[f], pixel));
    return result;
}

double mean_size(const std::vector<float>& some)
{
    double sum = 0;
    for (const float x : some) sum += double(std::abs(x));
    return some.empty() ? 0 : sum / double(some.size());
}

} // namespace

compared_frames compare_frames(const motion_scene& scene, const layered_sizes& size, int frames,
                               const std::filesystem::path& folder)
{
    const moving_stage whole = scene.stage(double(size.width) / size.height, size.full);
    std::vector<const layered_method*> methods;
    for (const method* m : methods_in_order())
        if (const auto* one = dynamic_cast<const layered_method*>(m);
            one && std::ranges::count(one->variants.front().comparisons, equal_input) > 0)
            methods.push_back(one);
    std::vector<frame> all;
    const float step = (1 - shutter) / float(frames - 1);
    for (int f = 0; f < frames; ++f) {
        const moving_stage stage = exposed(whole, step * float(f), step * float(f) + shutter);
        layered_view view(stage, {size.width, size.height, size.camera_samples, size.reference_times});
        view.reseed(std::uint32_t(2 * f + 1));
        layered_input input(stage, size.map_resolution, std::uint32_t(2 * f));
        frame& now = all.emplace_back();
        for (std::size_t i = 0; i < view.pixels.size(); ++i) now.reference[view.pixels[i]] = view.expected[i];
        for (const layered_method* m : methods) {
            const auto map = m->build(input, m->variants.front().parameters);
            const stochastic_receivers& r =
                view.now().receivers(map->resolution > 0 ? map->resolution : size.map_resolution);
            std::vector<float> found(r.where.size());
            const double spent = seconds_on_one_core([&] { map->visibilities(r.where, found); });
            now.costs.push_back({double(map->bytes()), double(map->resolution) * double(map->resolution),
                                 1e9 * spent / double(std::max<std::size_t>(found.size(), 1))});
            now.estimates.push_back(mean_visibility(view.now().of.seen, of_segments(r, found)));
        }
    }
    const std::vector<float> expected = changes(all, [](const frame& f, std::size_t i) { return f.reference.at(i); });
    compared_frames result{.scene = scene, .frames = frames, .reference_change = mean_size(expected)};
    for (std::size_t m = 0; m < methods.size(); ++m) {
        const std::vector<float> found =
            changes(all, [m](const frame& f, std::size_t i) { return f.estimates[m].pixels[i]; });
        report_row row = row_of(*methods[m]);
        row.scene = scene.id, row.part = "change", row.receiver = camera_samples_kind->id, row.reference = "traced";
        row.parameters = methods[m]->variants.front().parameters;
        row.parameters["camera_samples"] = size.camera_samples, row.parameters["frames"] = frames;
        row.parameters["reference_times"] = size.reference_times;
        row.label = methods[m]->label;
        row.receivers = static_cast<long long>(found.size());
        row.errors = compare(found, expected);
        row.seeds = frames;
        const cost& last = all.back().costs[m];
        row.map_bytes = last.bytes, row.bytes_per_texel = last.texels > 0 ? last.bytes / last.texels : 0;
        row.ns_per_receiver = last.look_up_ns;
        result.methods.push_back({methods[m], methods[m]->label, mean_size(found), row.errors.rmse});
        result.rows.push_back(std::move(row));
        image<float> change(size.width, size.height), traced(size.width, size.height);
        const frame &one = all[all.size() / 2 - 1], &next = all[all.size() / 2];
        for (const auto& [pixel, v] : one.reference) {
            const auto later = next.reference.find(pixel);
            if (later == next.reference.end()) continue;
            change.pixels[pixel] = next.estimates[m].pixels[pixel] - one.estimates[m].pixels[pixel];
            traced.pixels[pixel] = later->second - v;
        }
        const std::string file = fmt::format("{}-{}-change-difference.png", scene.id, methods[m]->id);
        write_png(folder / file, error_picture(change, traced, change_scale));
        result.pictures.push_back({file,
                                   fmt::format("change between two frames of {} by {}", scene.label, methods[m]->label),
                                   methods[m]->label});
    }
    return result;
}

std::vector<block> blocks_of(const compared_frames& found)
{
    table_block table{
        .title = fmt::format("From frame to frame: {}", found.scene.label),
        .text = fmt::format("{} frames, each with seeds of its own, whose shutter opens later from frame to frame. The "
                            "visibility of a pixel of the reference changes by {:.1f} thousandths in the mean. What a "
                            "method changes beyond that is seen as flicker.",
                            found.frames, 1e3 * found.reference_change),
        .columns = {{.key = "method", .label = "method"},
                    error_column("change", "mean change", 1),
                    error_column("more", "beyond the reference's mean", 1),
                    error_column("beyond", "RMS difference from the reference's", 1)},
        .rows = {}};
    table.columns[1].best = best::none;
    for (const method_change& m : found.methods)
        table.rows.push_back({.cells = {{"method", m.label},
                                        {"change", m.change},
                                        {"more", m.change - found.reference_change},
                                        {"beyond", m.beyond}},
                              .colour = m.method->its_family().colour});
    return {std::move(table),
            pictures_block{.title = "Changes beyond the reference's, between two frames",
                           .columns = 3,
                           .pictures = found.pictures,
                           .is_folded = true,
                           .key = {{"#2a62cc", "brighter than in the reference"}, {"#c8232c", "darker"}}}};
}

} // namespace gnomon::evaluation
