#include "soft_comparison.hpp"

#include "evaluation/core/insets.hpp"
#include "evaluation/core/timed_look_ups.hpp"
#include "renderer/output/image.hpp"
#include "renderer/shade/shading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

const registered<receiver_kind> plane_biased{
    receiver_facts{.id = "plane_biased",
                   .label = "points, with a depth bias by their plane and the width of the filter",
                   .order = 20}};

struct known_visibility {
    std::vector<float> biased, unbiased; // the second only of the reference that filters
    image<float> picture;
};

class comparison {
  public:
    comparison(const scene_facts& scene, const stage& scenery, const settings& how, const std::filesystem::path& folder,
               steps& all)
        : all_(all),
          stage_(scenery, how),
          places_(scenery.interests, scenery.eye, how.width, how.height),
          folder_(folder),
          timed_(runs_to_time(stage_.where))
    {
        const soft_widths<float> texels = stage_.light(1e6f).penumbra(1.f, -1.f);
        found_ = {scene, how, stage_.where.size(), double(std::max(texels.x, texels.y)), {}, {}, {}};
        for (std::size_t i = 0; i < scenery.interests.size(); ++i)
            found_.parts.push_back({scenery.interests[i].id, scenery.interests[i].name, places_.colour(i)});
        begin(soft_references[0].label);
        add({filtered_visibility(stage_, stage_.where, usual_search),
             filtered_visibility(stage_, stage_.unbiased, usual_search),
             {}});
        begin(soft_references[1].label);
        add({traced_visibility(stage_, usual_rays), {}, {}});
    }

    void add(const soft_method& m, bool without_bias)
    {
        begin(m.label);
        std::unique_ptr<soft_shadow_map> map;
        const double build_ms =
            1e3 * least_seconds([&] { map = m.build(stage_.depths(), stage_.light(m.widest_search)); });
        const std::vector<float> visibility = visible(*map, stage_.where), unbiased = visible(*map, stage_.unbiased);
        std::vector<float> scratch(timed_.size());
        std::vector<measured_time> times;
        for (const timed_look_up& t : map->timed(timed_))
            times.push_back({t.lanes, nanoseconds(t.kernel, scratch, 0.02), nanoseconds(t.look_up, scratch, 0.02)});
        const image<float> estimate = image_of(visibility);
        soft_row_set result{&m, file(m.id), {}, {}, {}, map->skipped(stage_.where)};
        write_png(folder_ / result.picture, figure(shaded(estimate)));
        if (without_bias) {
            result.unbiased = file(m.id + "-without-bias");
            write_png(folder_ / result.unbiased, figure(shaded(image_of(unbiased))));
        }
        for (std::size_t k = 0; k < known_.size(); ++k) {
            result.errors.push_back(file(fmt::format("{}-{}-error", m.id, soft_references[k].id)));
            const picture colours =
                error_picture(reduced(estimate, found_.how.supersampling),
                              reduced(known_[k].picture, found_.how.supersampling), soft_error_scale);
            write_png(folder_ / result.errors.back(), figure(colours));
        }
        report_row row = row_of(m);
        row.scene = found_.scene.id;
        row.receiver = plane_biased->id;
        row.parameters["search"] = double(m.widest_search);
        row.map_bytes = double(map->bytes());
        row.build_ms = build_ms;
        add_rows(result, row, visibility, unbiased, times, {}, {0, 0, found_.how.width, found_.how.height});
        for (std::size_t i = 0; i < places_.size(); ++i)
            add_rows(result, row, visibility, unbiased, times, found_.parts[i].id, places_.crop(i));
        found_.methods.push_back(std::move(result));
    }

    compared_soft_scene take() { return std::move(found_); }

  private:
    void begin(std::string_view what) { all_.begin(fmt::format("{}: {}", found_.scene.label, what)); }

    std::string file(std::string_view what) const { return fmt::format("{}-{}.png", found_.scene.id, what); }

    void add(known_visibility known)
    {
        known.picture = image_of(known.biased);
        found_.pictures.push_back(file(soft_references[known_.size()].id));
        write_png(folder_ / found_.pictures.back(), figure(shaded(known.picture)));
        known_.push_back(std::move(known));
    }

    static std::vector<float> visible(const soft_shadow_map& map, std::span<const soft_receiver> where)
    {
        std::vector<float> result(where.size());
        map.intensities(where, result);
        for (float& x : result) x = 1 - x;
        return result;
    }

    image<float> image_of(std::span<const float> visibility) const
    {
        image<float> result(stage_.seen.width, stage_.seen.height, 1);
        for (std::size_t i = 0; i < visibility.size(); ++i) result.pixels[stage_.pixels[i]] = visibility[i];
        return result;
    }

    picture shaded(const image<float>& visibility) const
    {
        return reduced(shade(stage_.scenery.world, stage_.scenery.light, stage_.seen, visibility),
                       found_.how.supersampling);
    }

    picture figure(const picture& whole) const { return places_.figure(whole); }

    // Indices of the receivers within a rectangle of the picture.
    std::vector<std::size_t> receivers_within(const rectangle& part) const
    {
        std::vector<std::size_t> result;
        const int samples = found_.how.supersampling;
        for (std::size_t i = 0; i < stage_.pixels.size(); ++i) {
            const int pixel = static_cast<int>(stage_.pixels[i]);
            const int x = pixel % stage_.seen.width / samples, y = pixel / stage_.seen.width / samples;
            if (x >= part.x && x < part.x + part.width && y >= part.y && y < part.y + part.height) result.push_back(i);
        }
        return result;
    }

    void add_rows(soft_row_set& to, report_row row, const std::vector<float>& visibility,
                  const std::vector<float>& unbiased, const std::vector<measured_time>& times, const std::string& part,
                  const rectangle& where) const
    {
        const std::vector<std::size_t> chosen = receivers_within(where);
        const auto errors = [&](const std::vector<float>& estimate, const std::vector<float>& expected) {
            std::vector<float> a, b;
            for (const std::size_t i : chosen) a.push_back(estimate[i]), b.push_back(expected[i]);
            return compare(a, b);
        };
        row.part = part;
        row.receivers = static_cast<long long>(chosen.size());
        for (std::size_t k = 0; k < known_.size(); ++k) {
            row.reference = soft_references[k].id;
            row.errors = errors(visibility, known_[k].biased);
            row.acne_unbiased.reset();
            if (!known_[k].unbiased.empty()) row.acne_unbiased = errors(unbiased, known_[k].unbiased).acne;
            for (const measured_time& t : times) {
                row.lanes = t.lanes;
                row.ns_kernel = t.ns_kernel;
                row.ns_per_receiver = t.ns_per_receiver;
                to.rows.push_back(row);
            }
        }
    }

    steps& all_;
    soft_stage stage_;
    magnified_places places_;
    std::filesystem::path folder_;
    std::vector<soft_receiver> timed_;
    std::vector<known_visibility> known_; // of each reference
    compared_soft_scene found_;
};

} // namespace

const report_row& soft_row_set::row(std::string_view reference, std::string_view part, bool by_packs) const
{
    const report_row* found = nullptr;
    for (const report_row& r : rows)
        if (r.reference == reference && r.part == part &&
            (found == nullptr || (by_packs ? r.lanes > found->lanes : r.lanes < found->lanes)))
            found = &r;
    if (found == nullptr) throw std::logic_error(fmt::format("no row of {} against {}", of->id, reference));
    return *found;
}

const soft_row_set& compared_soft_scene::method(std::string_view id) const
{
    const auto found = std::ranges::find(methods, id, [](const soft_row_set& m) { return std::string_view(m.of->id); });
    if (found == methods.end()) throw std::logic_error(fmt::format("no method {} in {}", id, scene.id));
    return *found;
}

std::vector<const soft_method*> soft_methods()
{
    std::vector<const soft_method*> result;
    for (const method* m : methods_in_order())
        if (const auto* one = dynamic_cast<const soft_method*>(m)) result.push_back(one);
    return result;
}

std::size_t steps_of_comparison() { return soft_references.size() + soft_methods().size(); }

compared_soft_scene compare_soft_methods(const scene_facts& scene, const stage& scenery, const settings& how,
                                         const std::filesystem::path& folder, steps& all,
                                         const std::vector<std::string>& without_bias)
{
    comparison c(scene, scenery, how, folder, all);
    for (const soft_method* m : soft_methods()) c.add(*m, std::ranges::count(without_bias, m->id) > 0);
    return c.take();
}

} // namespace gnomon::evaluation
