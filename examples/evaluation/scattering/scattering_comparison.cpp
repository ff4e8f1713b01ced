#include "scattering_comparison.hpp"

#include "evaluation/core/timed_look_ups.hpp"
#include "renderer/output/image.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <future>
#include <map>
#include <stdexcept>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

const registered<receiver_kind> view_rays_kind{
    receiver_facts{.id = "view_rays", .label = "view rays from the camera to surfaces", .order = 30}};

class comparison {
  public:
    comparison(const scene_facts& scene, const scattering_view& view, const settings& how,
               const std::filesystem::path& folder, steps& all)
        : all_(all),
          view_(view),
          places_(view.stage.interests, view.stage.eye, how.width, how.height),
          folder_(folder),
          timed_(runs_to_time(view.where))
    {
        found_ = {scene, how, view.where.size(), {}, {}, {}};
        for (std::size_t i = 0; i < view.stage.interests.size(); ++i) {
            const point_of_interest& place = view.stage.interests[i];
            found_.parts.push_back({place.id, place.name, places_.colour(i)});
        }
        begin(scattering_references[1].label);
        traced_ = view.traced(view.where);
        const picture scattered = reduced(view_.scattered(traced_), how.supersampling);
        for (std::size_t i = 0; i < places_.size(); ++i) middles_.push_back(mean(scattered, places_.crop(i)));
        found_.picture = file("traced");
        write_png(folder_ / found_.picture, figure(traced_));
    }

    void add(const scattering_method& m)
    {
        begin(m.label);
        const std::unique_ptr<scattering_map> map = m.build(view_.scene());
        const std::vector<float> visibility = visibilities_of(*map, view_.where);
        std::vector<float> scratch(timed_.size());
        std::vector<measured_time> times;
        for (const timed_look_up& t : map->timed(timed_))
            times.push_back({t.lanes, nanoseconds(t.kernel, scratch, 0.005), nanoseconds(t.look_up, scratch, 0.005)});
        scattering_row_set result{&m, file(m.id), file(m.id + "-error"), {}, map->passes()};
        report_row row = row_of(m);
        row.scene = found_.scene.id;
        row.receiver = view_rays_kind->id;
        row.map_bytes = double(map->bytes());
        for (const build_pass& p : result.passes) {
            row.passes.emplace_back(p.name, p.milliseconds);
            row.build_ms += p.milliseconds;
        }
        const std::vector<float>* exact = exact_of(m, *map);
        const auto add_part = [&](const std::string& id, const rectangle& where) {
            row.part = id;
            if (exact != nullptr) add_rows(result, row, scattering_references[0], visibility, *exact, times, where);
            add_rows(result, row, scattering_references[1], visibility, traced_, times, where);
        };
        add_part({}, {0, 0, found_.how.width, found_.how.height});
        for (std::size_t i = 0; i < places_.size(); ++i) add_part(found_.parts[i].id, places_.crop(i));
        draw(result, visibility);
        found_.methods.push_back(std::move(result));
    }

    compared_scattering_scene take()
    {
        if (drawing_.valid()) drawing_.get();
        return std::move(found_);
    }

  private:
    void begin(std::string_view what) { all_.begin(fmt::format("{}: {}", found_.scene.label, what)); }

    std::string file(std::string_view what) const { return fmt::format("{}-{}.png", found_.scene.id, what); }

    // Pictures are compressed while the next method is measured.
    void draw(const scattering_row_set& of, const std::vector<float>& visibility)
    {
        if (drawing_.valid()) drawing_.get();
        drawing_ = std::async(std::launch::async, [this, visibility, shaded = of.picture, error = of.error] {
            write_png(folder_ / shaded, figure(visibility));
            const picture colours = error_picture(pixels(visibility), pixels(traced_), scattering_error_scale);
            write_png(folder_ / error, places_.figure(colours));
        });
    }

    // The exact answer of the map's filters. Methods that filter alike share one.
    const std::vector<float>* exact_of(const scattering_method& m, const scattering_map& map)
    {
        if (m.filter.empty()) return nullptr;
        const auto known = exact_.find(m.filter);
        if (known != exact_.end()) return &known->second;
        return &exact_.emplace(m.filter, map.exact(view_.where).value()).first->second;
    }

    image<float> pixels(std::span<const float> visibility) const
    {
        image<float> result(view_.seen.width, view_.seen.height);
        std::ranges::copy(visibility, result.pixels.begin());
        return reduced(result, found_.how.supersampling);
    }

    // Magnified places show the light from the air alone.
    picture figure(std::span<const float> visibility) const
    {
        const auto small = [&](const picture& whole) { return reduced(whole, found_.how.supersampling); };
        return places_.figure(small(view_.shown(visibility)), small(view_.scattered(visibility)), inset_contrast,
                              middles_);
    }

    static glm::vec3 mean(const picture& whole, const rectangle& where)
    {
        glm::vec3 sum(0);
        for (int y = where.y; y < where.y + where.height; ++y)
            for (int x = where.x; x < where.x + where.width; ++x) sum += whole(x, y);
        return sum / float(where.width * where.height);
    }

    void add_rows(scattering_row_set& to, report_row row, const scattering_reference& reference,
                  std::span<const float> visibility, std::span<const float> expected,
                  const std::vector<measured_time>& times, const rectangle& part) const
    {
        const int samples = found_.how.supersampling;
        std::vector<float> a, b;
        for (int y = part.y * samples; y < (part.y + part.height) * samples; ++y)
            for (int x = part.x * samples; x < (part.x + part.width) * samples; ++x) {
                const std::size_t i = std::size_t(y) * std::size_t(view_.seen.width) + std::size_t(x);
                a.push_back(visibility[i]), b.push_back(expected[i]);
            }
        row.receivers = static_cast<long long>(a.size());
        row.reference = reference.id;
        row.errors = compare(a, b);
        for (const measured_time& t : times) {
            row.lanes = t.lanes;
            row.ns_kernel = t.ns_kernel;
            row.ns_per_receiver = t.ns_per_receiver;
            to.rows.push_back(row);
        }
    }

    steps& all_;
    const scattering_view& view_;
    magnified_places places_;
    std::filesystem::path folder_;
    std::vector<view_segment> timed_;
    std::vector<float> traced_;
    std::vector<glm::vec3> middles_; // of magnified places
    std::map<std::string, std::vector<float>> exact_;
    std::future<void> drawing_;
    compared_scattering_scene found_;
};

} // namespace

const report_row* scattering_row_set::find(std::string_view reference, std::string_view part, bool by_packs) const
{
    const report_row* found = nullptr;
    for (const report_row& r : rows)
        if (r.reference == reference && r.part == part &&
            (found == nullptr || (by_packs ? r.lanes > found->lanes : r.lanes < found->lanes)))
            found = &r;
    return found;
}

const report_row& scattering_row_set::traced(std::string_view part, bool by_packs) const
{
    const report_row* found = find(scattering_references[1].id, part, by_packs);
    if (found == nullptr) throw std::logic_error(fmt::format("no traced row of {}", of->id));
    return *found;
}

const scattering_row_set& compared_scattering_scene::method(std::string_view id) const
{
    const auto found =
        std::ranges::find(methods, id, [](const scattering_row_set& m) { return std::string_view(m.of->id); });
    if (found == methods.end()) throw std::logic_error(fmt::format("no method {} in {}", id, scene.id));
    return *found;
}

std::vector<const scattering_method*> scattering_methods(std::string_view scene)
{
    std::vector<const scattering_method*> result;
    for (const method* m : methods_in_order())
        if (const auto* one = dynamic_cast<const scattering_method*>(m))
            if (one->scenes.empty() || std::ranges::count(one->scenes, scene) > 0) result.push_back(one);
    return result;
}

std::size_t steps_of_comparison(std::string_view scene) { return 1 + scattering_methods(scene).size(); }

compared_scattering_scene compare_scattering_methods(const scene_facts& scene, const scattering_view& view,
                                                     const settings& how, const std::filesystem::path& folder,
                                                     steps& all)
{
    comparison c(scene, view, how, folder, all);
    for (const scattering_method* m : scattering_methods(scene.id)) c.add(*m);
    return c.take();
}

std::vector<float> visibilities_of(const scattering_map& map, std::span<const view_segment> where)
{
    std::vector<float> result(where.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, where.size(), 1024), [&](const auto& r) {
        map.visibilities(where.subspan(r.begin(), r.size()), std::span(result).subspan(r.begin(), r.size()));
    });
    return result;
}

} // namespace gnomon::evaluation
