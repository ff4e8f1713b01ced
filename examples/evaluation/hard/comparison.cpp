#include "comparison.hpp"

#include "comparison_page.hpp"
#include "evaluation/core/insets.hpp"
#include "measurement.hpp"
#include "renderer/output/image.hpp"
#include "renderer/shade/shading.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

const registered<receiver_kind> slope_biased{
    receiver_facts{.id = "slope_biased", .label = "points, with a depth bias by slope", .order = 10}};

struct known_visibility {
    std::vector<float> biased, unbiased; // the second only where the reference uses depths
    image<float> picture;
};

std::vector<const hard_reference*> hard_references() { return registry_of<reference>().all_of<hard_reference>(); }

class comparison {
  public:
    comparison(const comparison_facts& facts, const settings& how, const stage& scenery, steps& all)
        : steps_(all),
          stage_(scenery, how),
          result_{facts, how, scenery.world.name, stage_.where.size(), stage_.taps.size(), {}, {}, {}},
          folder_(how.folder(facts.driver)),
          insets_(scenery.interests, scenery.eye, how.width, how.height)
    {
        for (std::size_t i = 0; i < insets_.size(); ++i)
            result_.insets.push_back({scenery.interests[i].id, scenery.interests[i].name, insets_.colour(i)});
        for (const hard_reference* r : hard_references()) {
            steps_.begin("reference: " + r->label);
            known_visibility known{r->visibility(stage_, stage_.where.biased), {}, {}};
            if (r->uses_depths) known.unbiased = r->visibility(stage_, stage_.where.unbiased);
            known.picture = image_of(known.biased);
            write_png(folder_ / (r->id + ".png"), insets_.figure(shaded(known.picture)));
            result_.references.push_back(r);
            known_.push_back(std::move(known));
        }
    }

    void add(const shadow_method& m)
    {
        steps_.begin(m.label);
        const measurement found = measure(m, stage_);
        const image<float> estimate = image_of(found.visibility);
        write_png(folder_ / (m.id + ".png"), insets_.figure(shaded(estimate)));
        tbb::parallel_for(std::size_t(0), known_.size(), [&](std::size_t k) {
            write_png(folder_ / fmt::format("{}-{}.png", m.id, result_.references[k]->id),
                      insets_.figure(error(estimate, known_[k].picture)));
        });
        result_.methods.push_back({&m, m.id, {}});
        add_rows(m, found, {}, {0, 0, result_.how.width, result_.how.height});
        for (std::size_t i = 0; i < insets_.size(); ++i) add_rows(m, found, result_.insets[i].id, insets_.crop(i));
    }

    void finish() const
    {
        write_page(folder_, comparison_page(result_));
        std::vector<report_row> rows;
        for (const compared_method& m : result_.methods) rows.insert(rows.end(), m.rows.begin(), m.rows.end());
        merge_report(result_.how.out / "report.json", rows);
    }

  private:
    image<float> image_of(std::span<const float> visibility) const
    {
        image<float> result(stage_.seen.width, stage_.seen.height, 1);
        for (std::size_t i = 0; i < stage_.where.size(); ++i) result.pixels[stage_.where.pixels[i]] = visibility[i];
        return result;
    }

    picture shaded(const image<float>& visibility) const
    {
        return reduced(shade(stage_.scenery.world, stage_.scenery.light, stage_.seen, visibility),
                       result_.how.supersampling);
    }

    picture error(const image<float>& estimate, const image<float>& reference) const
    {
        return error_picture(reduced(estimate, result_.how.supersampling),
                             reduced(reference, result_.how.supersampling), error_scale);
    }

    // Indices of the receivers within a rectangle of the picture.
    std::vector<std::size_t> receivers_within(const rectangle& part) const
    {
        std::vector<std::size_t> result;
        const int samples = result_.how.supersampling;
        for (std::size_t i = 0; i < stage_.where.size(); ++i) {
            const int pixel = static_cast<int>(stage_.where.pixels[i]);
            const int x = pixel % stage_.seen.width / samples, y = pixel / stage_.seen.width / samples;
            if (x >= part.x && x < part.x + part.width && y >= part.y && y < part.y + part.height) result.push_back(i);
        }
        return result;
    }

    void add_rows(const shadow_method& m, const measurement& found, const std::string& part, const rectangle& where)
    {
        const std::vector<std::size_t> chosen = receivers_within(where);
        const auto errors = [&](const std::vector<float>& estimate, const std::vector<float>& expected) {
            std::vector<float> a, b;
            for (const std::size_t i : chosen) a.push_back(estimate[i]), b.push_back(expected[i]);
            return compare(a, b);
        };
        report_row row = row_of(m);
        row.scene = result_.facts.scene;
        row.part = part;
        row.receiver = slope_biased->id;
        row.receivers = static_cast<long long>(chosen.size());
        row.map_bytes = found.map_bytes;
        row.build_ms = found.build_ms;
        for (std::size_t k = 0; k < known_.size(); ++k) {
            row.reference = result_.references[k]->id;
            row.errors = errors(found.visibility, known_[k].biased);
            row.acne_unbiased.reset();
            if (result_.references[k]->uses_depths) row.acne_unbiased = errors(found.unbiased, known_[k].unbiased).acne;
            for (const measured_time& t : found.times) {
                row.lanes = t.lanes;
                row.ns_kernel = t.ns_kernel;
                row.ns_per_receiver = t.ns_per_receiver;
                result_.methods.back().rows.push_back(row);
            }
        }
    }

    steps& steps_;
    shaded_stage stage_;
    compared_stage result_;
    std::filesystem::path folder_;
    magnified_places insets_;
    std::vector<known_visibility> known_; // of each reference
};

} // namespace

void compare_methods(const comparison_facts& facts, const settings& how, const stage& scenery)
{
    progress(facts.driver, "shadow map, camera image");
    std::vector<const shadow_method*> methods;
    for (const method* m : methods_in_order())
        if (const auto* one = dynamic_cast<const shadow_method*>(m)) methods.push_back(one);
    steps all(facts.driver, hard_references().size() + methods.size());
    comparison c(facts, how, scenery, all);
    for (const shadow_method* m : methods) c.add(*m);
    c.finish();
}

void compare_methods(const comparison_facts& facts, const settings& how)
{
    const auto& entry = dynamic_cast<const still_scene&>(registry_of<scene_entry>().at(facts.scene));
    compare_methods(facts, how, entry.stage(double(how.width) / how.height));
}

} // namespace gnomon::evaluation
