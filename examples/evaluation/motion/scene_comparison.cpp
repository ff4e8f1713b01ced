#include "scene_comparison.hpp"

#include "evaluation/core/progress.hpp"
#include "motion_method.hpp"
#include "renderer/raster/moving_rasterizer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

constexpr int inset_share = 4; // of a picture's width in that of an inset

class scene_comparison {
  public:
    scene_comparison(const scene_facts& scene, const motion_scene_facts& motion, const moving_stage& stage,
                     const motion_sizes& size, const std::filesystem::path& folder)
        : folder_(folder), view_(stage, size, motion.has("surfaces")), found_{.scene = scene, .motion = motion}
    {
        found_.triangles = triangle_numbers(stage.world.open).count();
        found_.receivers = static_cast<long long>(view_.pixels.size());
        found_.reference = file("reference");
        write_png(folder_ / found_.reference, view_.reference.colour);
        if (motion.has("surfaces")) {
            const auto ids = view_.maps.surface_ids();
            found_.surfaces = std::set(ids.begin(), ids.end()).size();
        }
        if (!motion.figure.empty()) add_close_up("reference", "ray tracing", view_.reference.colour);
    }

    scene_results run()
    {
        for (const method* m : methods_in_order())
            if (const auto* one = dynamic_cast<const motion_method*>(m))
                one->measure(view_, found_.motion.tags, [&](const motion_outcome& o) { add(o); });
        return std::move(found_);
    }

  private:
    std::string file(std::string_view what) const { return fmt::format("{}-{}.png", found_.scene.id, what); }

    static std::string name_of(const report_row& row)
    {
        std::string result = row.method;
        for (const auto& [name, value] : row.parameters) result += fmt::format("-{}_{:g}", name, value);
        return result + "-" + row.receiver;
    }

    void add(const motion_outcome& o)
    {
        scene_row result{o.row, o.format};
        const image<float> estimate = mean_visibility(o.seen, o.visibility);
        report_row& row = result.row;
        row.scene = found_.scene.id;
        row.reference = "traced";
        row.receivers = found_.receivers;
        row.errors = view_.errors_of(estimate);
        if (!o.unbiased.empty()) row.acne_unbiased = view_.errors_of(mean_visibility(o.seen, o.unbiased)).acne;
        if (o.pictured) {
            const picture shaded = shade(view_.stage.world, view_.stage.light, o.seen, o.visibility);
            result.picture = file(name_of(row));
            result.error = file(name_of(row) + "-error");
            write_png(folder_ / result.picture, shaded);
            write_png(folder_ / result.error, error_picture(estimate, view_.reference.visibility, error_scale));
            if (!found_.motion.figure.empty() && row.method == "resolved_ranges" &&
                (row.receiver == "semi_analytic" || row.receiver == "analytic")) {
                const std::string words = row.receiver == "analytic" ? "analytic" : "semi-analytic";
                add_close_up(row.receiver, words, shaded);
                add_close_up(row.receiver + "-error", "errors, " + words,
                             error_picture(estimate, view_.reference.visibility, error_scale / close_up_gain));
            }
        }
        found_.rows.push_back(std::move(result));
    }

    void add_close_up(const std::string& name, const std::string& words, const picture& whole)
    {
        const auto& [stage, size] = std::tie(view_.stage, view_.size);
        const rectangle part =
            inset_around(stage.interests.front(), stage.eye.at(0.5), size.width / inset_share, size.width, size.height);
        const std::string to = file("close-" + name);
        write_png(folder_ / to, magnify(whole, part, 4));
        found_.close_ups.push_back({to, fmt::format("{} from close by: {}", found_.scene.label, words),
                                    fmt::format("{}: {}", found_.motion.figure, words)});
    }

    std::filesystem::path folder_;
    motion_view view_;
    scene_results found_;
};

const scene_row& needed(const scene_row* row, const scene_results& in)
{
    if (!row) throw std::logic_error(in.scene.id + ": a row is missing");
    return *row;
}

} // namespace

scene_results compare_scene(const scene_facts& scene, const motion_scene_facts& motion, const moving_stage& stage,
                            const motion_sizes& size, const std::filesystem::path& folder)
{
    progress(folder.filename().string(),
             fmt::format("{}: ray tracing at {} times", scene.label, size.reference_samples));
    return scene_comparison(scene, motion, stage, size, folder).run();
}

const scene_row* find_row(const scene_results& in, std::string_view method, std::string_view receiver,
                          const parameters& with)
{
    const auto found = std::ranges::find_if(in.rows, [&](const scene_row& one) {
        return one.row.method == method && one.row.receiver == receiver && one.row.parameters == with;
    });
    return found == in.rows.end() ? nullptr : &*found;
}

const scene_row& analytic_row(const scene_results& in)
{
    return needed(find_row(in, "resolved_ranges", "analytic"), in);
}

const scene_row& accumulated_row(const scene_results& in)
{
    return needed(find_row(in, "accumulation", "at_times_of_maps", {{"times", 16}}), in);
}

} // namespace gnomon::evaluation
