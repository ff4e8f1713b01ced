// Goals, and what was found.
#include "evaluation/motion/words.hpp"
#include "layered_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

namespace gnomon::evaluation {

namespace {

class goals {
  public:
    explicit goals(compared_scenes scenes) : scenes_(scenes)
    {
        table_ = {.title = "Goals",
                  .text =
                      "What layers were to reach, and what this run found. Time is that of the map and of the "
                      "look-ups, on one core.",
                  .columns = {{.key = "goal", .label = "goal"},
                              {.key = "scene", .label = "scene"},
                              {.key = "found", .label = "found"},
                              {.key = "met", .label = "met"}},
                  .rows = {}};
    }

    table_block all(const static_costs& still)
    {
        for (const compared_layers& scene : scenes_) noise(scene);
        for (const compared_layers& scene : scenes_) time(scene);
        conversion();
        plain(still);
        model();
        return std::move(table_);
    }

  private:
    void add(std::string goal, std::string scene, std::string found, std::string met)
    {
        table_.rows.push_back({.cells = {{"goal", std::move(goal)},
                                         {"scene", std::move(scene)},
                                         {"found", std::move(found)},
                                         {"met", std::move(met)}}});
    }
    static std::string yes(bool met) { return met ? "yes" : "no"; }

    void noise(const compared_layers& scene)
    {
        constexpr std::array figures{"pillars", "crossed_quads", "toward_and_away"};
        if (std::ranges::count(figures, scene.scene.id) == 0) return;
        const layered_result *layers = scene.usual(usual_layers), *slices = best_of(scene, *slices_family, equal_input);
        if (!layers || !slices || !slices->row.noise || !layers->row.noise) return;
        const auto ratio = [](const std::optional<double>& a, const std::optional<double>& b) {
            return *b > 0 ? *a / *b : 0;
        };
        const report_row &a = layers->row, &b = slices->row;
        const double of_map = ratio(a.noise_of_map, b.noise_of_map);
        add("noise of the map at most 1/3 of that of time-dependent shadow maps", scene.scene.label,
            fmt::format(
                "{:.2f} of it ({:.1f} against {:.1f} thousandths); {:.2f} of it with the camera's noise, {:.2f} "
                "beyond exact visibility over the same parts of time, and {:.2f} beyond that at instants",
                of_map, 1e3 * *a.noise_of_map, 1e3 * *b.noise_of_map, ratio(a.noise, b.noise),
                ratio(a.noise_beyond_exact, b.noise_beyond_exact), ratio(a.noise_beyond_camera, b.noise_beyond_camera)),
            yes(of_map <= 1. / 3));
    }

    void time(const compared_layers& scene)
    {
        constexpr std::array rich{"tentacles", "tree"};
        if (std::ranges::none_of(rich, [&](const char* id) { return scene.scene.id.starts_with(id); })) return;
        const layered_result* layers = scene.usual(usual_layers);
        if (!layers) return;
        const auto fits = [&](const layered_result& r) { return r.total_ms() <= 1.1 * layers->total_ms(); };
        const layered_result *one = best_of(scene, *slices_family, equal_time, fits),
                             *usual = best_of(scene, *slices_family, equal_input, fits);
        if (!one || (usual && usual->row.errors.rmse < one->row.errors.rmse)) one = usual;
        if (!one) return;
        const error_statistics &a = layers->row.errors, &b = one->row.errors;
        add("RMSE below that of time-dependent shadow maps of equal time, at their best bias", scene.scene.label,
            fmt::format(
                "{:.1f} thousandths in {} ms, with a leak of {:.1f} and acne of {:.1f}, against {:.1f} in {} ms, "
                "leak {:.1f}, acne {:.1f} ({})",
                1e3 * a.rmse, grouped(layers->total_ms()), 1e3 * a.leak, 1e3 * a.acne, 1e3 * b.rmse,
                grouped(one->total_ms()), 1e3 * b.leak, 1e3 * b.acne, one->label()) +
                (a.leak > 2 * a.acne && a.rmse >= b.rmse
                     ? ": most of it leaks, surfaces of one layer that shadow one another"
                     : ""),
            yes(a.rmse < b.rmse));
    }

    void conversion()
    {
        double most = 0;
        const compared_layers* where = nullptr;
        for (const compared_layers& scene : scenes_)
            if (const layered_result* layers = scene.usual(usual_layers)) {
                const double ns = 1e6 * layers->conversion_ms / double(std::max(scene.samples_of_map, 1LL));
                if (ns > most) most = ns, where = &scene;
            }
        if (where)
            add("conversion in at most 100 ns per sample of the map", "the slowest: " + where->scene.label,
                fmt::format("{:.0f} ns", most), yes(most <= 100));
    }

    void plain(const static_costs& still)
    {
        add("where nothing moves, one layer has at most 1.1 x the memory and the look-up of a plain map",
            "tentacles that do not move",
            fmt::format("{:.2f} x the memory, {:.2f} x the time of a look-up, {:.0f}% of tiles in a plain map",
                        still.bytes_ratio, still.look_up_ratio, 100 * still.plain_tiles),
            yes(still.bytes_ratio <= 1.1 && still.look_up_ratio <= 1.1));
    }

    // The model of depth with the least mean RMSE of all scenes.
    void model()
    {
        const method* best = nullptr;
        double least = 0, usual = 0;
        std::string found;
        for (const method* m : methods_in_order()) {
            if (m->family != layers_family->id) continue;
            double sum = 0;
            int count = 0;
            for (const compared_layers& scene : scenes_)
                if (const layered_result* r = scene.usual(m->id); r && r->is_of(equal_input))
                    sum += r->row.errors.rmse, ++count;
            if (count == 0) continue;
            const double mean = sum / count;
            found += fmt::format("{}{} {:.1f}", found.empty() ? "" : ", ", m->label, 1e3 * mean);
            if (!best || mean < least) best = m, least = mean;
            if (m->id == usual_layers) usual = mean;
        }
        if (best)
            add("the usual model of depth has the least RMSE", "mean of all scenes", found + " thousandths",
                yes(usual <= least));
    }

    compared_scenes scenes_;
    table_block table_;
};

} // namespace

table_block goals_of(compared_scenes scenes, const static_costs& still) { return goals(scenes).all(still); }

} // namespace gnomon::evaluation
