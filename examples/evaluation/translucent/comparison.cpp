#include "comparison.hpp"

#include "evaluation/core/driver.hpp"
#include "evaluation/core/insets.hpp"
#include "evaluation/core/scene.hpp"
#include "renderer/output/image.hpp"

#include <gnomon/passes/blur.hpp>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

constexpr std::array<float, 1> no_blur{1};
constexpr int seeds = 4;

stage stage_of(const char* scene, double aspect)
{
    return dynamic_cast<const still_scene&>(registry_of<scene_entry>().at(scene)).stage(aspect);
}

// One of the two places of Figure 6, seen through a long lens, and the methods that are shown there.
struct artifact {
    const char* name;
    bool is_blurred;
    translucent_view view;
    known_visibility known;
    std::vector<view_part> parts;
    const char* part; // whose errors are told
};

const std::array shown_artifacts{
    std::pair("msm4_unorm16_paper_blended", showings[0]), std::pair("msm4_unorm16_paper_blended", showings[1]),
    std::pair("evsm_half_blended", showings[0]),          std::pair("msm4_float_blended", showings[0]),
    std::pair("msm6_float_blended", showings[0]),         std::pair("absorbance4_float", showings[3])};

class comparison {
  public:
    comparison(const settings& how, const stage& scenery, const stage& close, steps& all)
        : steps_(all),
          folder_(how.folder("translucent")),
          samples_(how.supersampling),
          width_(samples_ > 1 ? how.width : how.width * 3 / 4),
          height_(samples_ > 1 ? how.height : how.height * 3 / 4),
          scenery_(scenery),
          occluders_(scenery.world, scenery.light, how.map_resolution),
          opaque_(occluders_.opaque_alone()),
          stacks_(occluders_),
          view_(scenery, scenery.eye, width_ * samples_, height_ * samples_, how.map_resolution),
          close_up_(close, close.eye, width_ / 3, height_ / 3, how.map_resolution),
          insets_(scenery.interests, scenery.eye, width_, height_)
    {
        std::filesystem::create_directories(folder_);
        result_.how = how;
        result_.width = width_, result_.height = height_, result_.map_resolution = how.map_resolution;
        result_.receivers = view_.size(), result_.taps = taps_.size();
        result_.fragments = occluders_.translucent.fragments.size();
        result_.layers = occluders_.fragments(colour::grey).layers;
        result_.close_up_overdraw = double(close_up_.smoke().size()) / double(close_up_.seen.opaque.pixels.size());
        for (std::size_t i = 0; i < insets_.size(); ++i) {
            const point_of_interest& place = scenery.interests[i];
            rectangle crop = insets_.crop(i);
            for (int* one : {&crop.x, &crop.y, &crop.width, &crop.height}) *one *= samples_;
            result_.insets.push_back({"inset_" + place.id, place.name, insets_.colour(i), crop,
                                      place.id == "smoke" || place.id == "silhouette"});
        }
        parts_ = parts_of(view_, result_.insets);
        close_up_parts_ = {parts_of(close_up_).front()};

        steps_.begin("reference: transmittance of the blended stacks");
        known_.push_back(filtered_visibility(view_, stacks_, taps_));
        close_up_known_.push_back(filtered_visibility(close_up_, stacks_, taps_));
        add_artifacts(how);
        steps_.begin("reference: ray tracing");
        known_.push_back(traced_visibility(view_));
        parts_.push_back(behind_translucent_ones(view_, known_.back()));
        for (const known_visibility& known : known_)
            write_png(folder_ / (known.reference + ".png"), shaded(view_, known_colours(known)));
        const known_visibility traced = traced_visibility(close_up_);
        write_png(folder_ / "close-up.png", close_up_.shaded(known_colours(traced)));
    }

    void add(const translucent_method& m)
    {
        steps_.begin(m.label);
        compared_translucent_method added{.of = &m, .opaque_ms = build(m, opaque_, taps_).build_ms};
        measured_map built;
        std::vector<shadows> by_seed;
        for (int seed = m.is.random ? seeds : 1; seed-- > 0;) {
            built = build(m, occluders_, taps_, {.seed = static_cast<std::uint32_t>(seed)});
            by_seed.insert(by_seed.begin(), shadows_of(m, *built.map, view_));
        }
        const auto timed_rows = [&](const translucent_view& view, std::vector<report_row> rows, bool by_packs) {
            const std::vector<measured_time> times = times_of(*built.map, view);
            std::vector<report_row> result;
            for (report_row& row : rows)
                for (const measured_time& t : times) {
                    if (t.lanes > 1 && !(by_packs && row.part.empty())) continue;
                    row.lanes = t.lanes, row.ns_kernel = t.ns_kernel, row.ns_per_receiver = t.ns_per_receiver;
                    row.build_ms = built.build_ms, row.map_bytes = double(built.map->bytes());
                    result.push_back(row);
                }
            return result;
        };
        const auto append = [](std::vector<report_row>& to, const std::vector<report_row>& rows) {
            to.insert(to.end(), rows.begin(), rows.end());
        };
        std::vector<report_row> rows;
        for (const showing& how : showings)
            if (m.is.between_bounds || how.in_smoke == bound::lower)
                append(rows, rows_of(m, view_, parts_, known_, by_seed, how));
        for (const showing& how : pictured) draw(m, by_seed.front(), how);
        for (const artifact& a : artifacts_) draw(m, a);
        added.rows = timed_rows(view_, std::move(rows), true);

        const std::array close{shadows_of(m, *built.map, close_up_)};
        rows = rows_of(m, close_up_, close_up_parts_, close_up_known_, close, showings[0]);
        added.close_up_rows = timed_rows(close_up_, std::move(rows), true);
        if (m.is.blended) append(added.rows, rows_with_alpha_test(m, added.rows.front()));
        result_.methods.push_back(std::move(added));
    }

    void finish() const
    {
        write_page(folder_, translucent_page(result_));
        std::vector<report_row> rows;
        for (const compared_translucent_method& m : result_.methods)
            for (const auto* some : {&m.rows, &m.close_up_rows}) rows.insert(rows.end(), some->begin(), some->end());
        merge_report(result_.how.out / "report.json", rows);
    }

  private:
    using of_primaries = std::array<numbers, 3>;

    static of_primaries known_colours(const known_visibility& known)
    {
        return {known[colour::red], known[colour::green], known[colour::blue]};
    }

    picture shaded(const translucent_view& view, const of_primaries& visibility) const
    {
        return insets_.figure(reduced(view.shaded(visibility), samples_));
    }

    // Visibility of the three colours, of which a grey method has one.
    static of_primaries colours(const translucent_method& m, const shadows& found, const translucent_view& view,
                                const showing& how)
    {
        of_primaries result;
        for (std::size_t c = 0; c < 3; ++c) result[c] = found.visibility(view, m.is.coloured ? c : 0, how);
        return result;
    }

    void draw(const translucent_method& m, const shadows& found, const showing& how) const
    {
        if (!is_drawn(m, how)) return;
        const of_primaries visibility = colours(m, found, view_, how);
        const std::string name = fmt::format("{}-{}", m.id, how.id);
        write_png(folder_ / (name + ".png"), shaded(view_, visibility));
        tbb::parallel_for(std::size_t(0), known_.size(), [&](std::size_t k) {
            // Of green light, where a method knows colours.
            const numbers& expected = known_[k][m.is.coloured ? colour::green : colour::grey];
            const auto seen = [&](const numbers& of) { return reduced(view_.lit(of), samples_); };
            write_png(folder_ / fmt::format("{}-{}-error.png", name, known_[k].reference),
                      insets_.figure(error_picture(seen(visibility[1]), seen(expected), translucent_error_scale)));
        });
    }

    void add_artifacts(const settings& how)
    {
        const auto add = [&](const char* name, const char* place, bool is_blurred, double angle, const char* part) {
            const auto found = std::ranges::find(scenery_.interests, place, &point_of_interest::id);
            if (found == scenery_.interests.end()) throw std::logic_error(fmt::format("no place has the id {}", place));
            const camera eye = perspective_view_from(scenery_.eye.position, found->position,
                                                     bounds_of(scenery_.world).corners(), angle, 4. / 3);
            translucent_view view(scenery_, eye, width_ / 3, width_ / 4, how.map_resolution);
            known_visibility known =
                is_blurred ? filtered_visibility(view, stacks_, taps_) : filtered_visibility(view, stacks_, no_blur);
            for (const known_visibility& one : {known, traced_visibility(view)})
                write_png(folder_ / fmt::format("{}-{}.png", name, one.reference), view.shaded(known_colours(one)));
            std::vector<view_part> parts = parts_of(view);
            artifacts_.push_back({name, is_blurred, std::move(view), std::move(known), std::move(parts), part});
        };
        add("leak-on-surfaces", "pipe", true, 0.22, "surfaces");
        add("leak-in-smoke", "silhouette", false, 0.22, "smoke");
    }

    void draw(const translucent_method& m, const artifact& a)
    {
        for (const auto& [id, how] : shown_artifacts) {
            if (m.id != id) continue;
            const std::span<const float> taps = a.is_blurred ? std::span<const float>(taps_) : no_blur;
            const std::array found{shadows_of(m, *build(m, occluders_, taps).map, a.view)};
            const std::string name = fmt::format("{}-{}-{}", a.name, m.id, how.id);
            const of_primaries visibility = colours(m, found[0], a.view, how);
            write_png(folder_ / (name + ".png"), a.view.shaded(visibility));
            write_png(
                folder_ / (name + "-error.png"),
                error_picture(a.view.lit(visibility[1]), a.view.lit(a.known[colour::grey]), translucent_error_scale));
            const std::span known(&a.known, 1);
            const std::vector<report_row> rows = rows_of(m, a.view, a.parts, known, found, how);
            const auto row = std::ranges::find(rows, a.part, &report_row::part);
            auto& list = a.is_blurred ? result_.on_surfaces : result_.in_smoke;
            list.push_back({name, fmt::format("{}, {}", m.label, how.label), row->errors.leak, row->errors.acne});
        }
    }

    // A map whose fragments below 1% are left out, as surfaces and smoke see it by their lower bounds.
    std::vector<report_row> rows_with_alpha_test(const translucent_method& m, const report_row& like) const
    {
        const float least_alpha = 0.01f;
        const measured_map built = build(m, occluders_, taps_, {.least_alpha = least_alpha});
        const std::array found{shadows_of(m, *built.map, view_)};
        std::vector<report_row> result;
        for (report_row& row : rows_of(m, view_, parts_, known_, found, showings[0])) {
            if (!row.part.empty() && row.part != "surfaces" && row.part != "smoke") continue;
            row.parameters["least_alpha"] = 0.01;
            row.lanes = like.lanes, row.ns_kernel = like.ns_kernel, row.ns_per_receiver = like.ns_per_receiver;
            row.map_bytes = like.map_bytes, row.build_ms = built.build_ms;
            result.push_back(row);
        }
        return result;
    }

    steps& steps_;
    std::filesystem::path folder_;
    int samples_, width_, height_;
    const stage& scenery_;
    const std::array<float, 9> taps_ = gaussian_weights(); // of the blur
    translucent_occluders occluders_, opaque_;             // the second without fragments
    texel_stacks stacks_;
    translucent_view view_, close_up_;
    magnified_places insets_;
    std::vector<view_part> parts_, close_up_parts_;
    std::vector<known_visibility> known_, close_up_known_;
    std::vector<artifact> artifacts_;
    translucent_comparison result_;
};

// Translucent occluders by every method that can hold them, after Figures 5 and 6 of Peters et al. 2017.
void translucent(const settings& how)
{
    progress("translucent", "shadow map, camera image");
    std::vector<const translucent_method*> methods;
    for (const method* m : methods_in_order())
        if (const auto* one = dynamic_cast<const translucent_method*>(m)) methods.push_back(one);
    const double aspect = double(how.width) / how.height;
    const stage scenery = stage_of("translucent", aspect), close = stage_of("smoke_close_up", aspect);
    steps all("translucent", 2 + methods.size());
    comparison c(how, scenery, close, all);
    for (const translucent_method* m : methods) c.add(*m);
    c.finish();
}

const registered<driver> entry{
    driver{.id = "translucent", .label = "Translucent occluders", .order = 14, .run = translucent}};

} // namespace

} // namespace gnomon::evaluation
