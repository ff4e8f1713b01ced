#include "motion_comparison.hpp"

#include "accumulation.hpp"
#include "evaluation/core/timing.hpp"
#include "light_receivers.hpp"
#include "range_maps.hpp"
#include "renderer/scene/surface_ids.hpp"
#include "renderer/trace/tracer.hpp"
#include "shadow_tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

constexpr float error_scale = 0.1f;    // visibility at which error colours saturate
constexpr int stochastic_samples = 16; // per pixel
constexpr int inset_share = 4;         // of a picture's width in that of an inset

struct outcome {
    std::string method, format;
    double bytes_per_texel, build_ms, ns_per_receiver;
    const seen_motion* seen;
    std::vector<float> visibility; // per segment
    int lanes = 1;
    std::optional<double> acne_unbiased{};
};

// Courses as receivers, with the depth bias and without.
struct segment_receivers {
    std::vector<light_receiver> biased, unbiased;
};

using shadow_test = float (*)(const range_map<float>&, const light_receiver&);

class motion_comparison {
  public:
    motion_comparison(const motion_scene& listed, const moving_stage& scenery, const motion_sizes& size,
                      const std::filesystem::path& folder)
        : listed_(listed), stage_(scenery), size_(size), folder_(folder)
    {
        progress(folder.filename().string(),
                 fmt::format("{}: ray tracing at {} times", listed.title, size.reference_samples));
        const tracer rays(stage_.world);
        reference_ = rays.photograph(stage_.light, stage_.eye, size.width, size.height, size.reference_samples);
        analytic_ = renderer::camera_segments(stage_.world, stage_.eye, size.width, size.height, depth_tolerance);
        stochastic_ = stochastic_visibility(stage_.world, stage_.eye, size.width, size.height, stochastic_samples);
        by_triangles_.biased = light_receivers_of(analytic_, stage_.light, size.map_resolution);
        if (listed.surfaces)
            by_triangles_.unbiased = light_receivers_of(analytic_, stage_.light, size.map_resolution, 0);
        stochastic_receivers_ = light_receivers_of(stochastic_, stage_.light, size.map_resolution);
        for (std::size_t pixel = 0; pixel < reference_.visibility.pixels.size(); ++pixel)
            if (!analytic_(pixel).empty() && reference_.coverage.pixels[pixel] > 0) pixels_.push_back(pixel);
        facts_ = {{"key", listed.key},
                  {"title", listed.title},
                  {"scene", stage_.world.open.name},
                  {"triangles", triangle_numbers(stage_.world.open).count()},
                  {"receivers", pixels_.size()},
                  {"reference", file("reference")},
                  {"insets", nlohmann::json::array()},
                  {"methods", nlohmann::json::array()},
                  {"unpictured", nlohmann::json::array()}};
        for (const point_of_interest& place : stage_.interests) {
            const rectangle r = inset_around(place, stage_.eye, size.width / inset_share, size.width, size.height);
            facts_["insets"].push_back(
                {{"name", place.name}, {"x", r.x}, {"y", r.y}, {"width", r.width}, {"height", r.height}});
        }
        write_png(folder_ / file("reference"), reference_.colour);
    }

    void run()
    {
        for (const int count : {8, 16, 32, 64}) add_accumulation(count);
        const auto& [world, eye, light, interests] = stage_;
        const int resolution = size_.map_resolution;
        add_stochastic(prism_ranges(world, light, resolution));
        add_stochastic(covered_prism_ranges(world, light, resolution));
        const range_shadow_map exact = exact_ranges(world, light, resolution);
        add_stochastic(exact);
        add_stochastic(covered_ranges(exact));
        const range_shadow_map resolved = resolved_ranges(world, light, resolution);
        add_stochastic(resolved);
        add_segments(resolved, "at rest", resting_visibility);
        add_segments(resolved, "sampled", sampled_visibility);
        add_segments(resolved, "semi-analytic", semi_analytic_visibility);
        add_segments(resolved, "analytic", light_visibility);
        add_segments(with_totals(caster_ranges(world, light, resolution)), "analytic", light_visibility);
        for (const int capacity : {4, 8, 16})
            add_segments(interval_lists(exact, capacity), "analytic", light_visibility);
        if (listed_.surfaces) {
            add_surfaces(exact, resolved);
            add_unpictured(
                by_segments(joined_ranges(world, light, resolution), by_triangles_, "analytic", light_visibility));
        }
        if (listed_.cover_first) add_cover_first(cover_first_ranges(exact));
    }

    motion_results results() && { return {std::move(facts_), std::move(rows_)}; }

  private:
    std::string file(std::string_view what) const { return fmt::format("{}-{}.png", listed_.key, what); }

    double per_receiver(double seconds) const
    {
        return 1e9 * seconds / double(std::max<std::size_t>(pixels_.size(), 1));
    }

    void add_accumulation(int count)
    {
        accumulated_maps maps;
        const double build = least_seconds(
            [&] { maps = accumulate(stage_.world, stage_.light, size_.map_resolution, middle_times(count)); });
        const seen_motion seen = seen_at_times(analytic_, maps.times);
        const auto receivers = accumulated_receivers_of(seen, stage_.light, maps);
        std::vector<float> visibility;
        const double spent = least_seconds([&] { accumulated_visibility(maps, receivers, visibility); });
        add({fmt::format("accumulation of {}", count), "32 bit depth", 4.0 * count, 1e3 * build, per_receiver(spent),
             &seen, in_order_of_segments(receivers, visibility, seen.segments.size()), int(accumulation_pack::size)});
    }

    // Hong & Oh: at one time per camera sample.
    template <class Test> outcome stochastic(const map_facts& map, const Test& test) const
    {
        std::vector<float> visibility(stochastic_receivers_.size());
        const double spent = least_seconds([&] {
            for (std::size_t i = 0; i < visibility.size(); ++i)
                visibility[i] = test(stochastic_receivers_[i], stochastic_receivers_[i].path.depth.t0);
        });
        return {fmt::format("{}, {} times", map.method, stochastic_samples),
                map.format,
                map.bytes_per_texel(),
                map.build_ms,
                per_receiver(spent),
                &stochastic_,
                std::move(visibility)};
    }

    void add_stochastic(const range_shadow_map& map)
    {
        add(stochastic(map, [&](const light_receiver& r, float t) { return visibility_at(map.map(), r, t); }));
    }

    void add_cover_first(const range_shadow_map& map)
    {
        add_unpictured(
            stochastic(map, [&](const light_receiver& r, float t) { return cover_first_visibility_at(map, r, t); }));
    }

    outcome by_segments(const range_shadow_map& map, const segment_receivers& receivers, std::string_view how,
                        shadow_test test) const
    {
        std::vector<float> visibility(receivers.biased.size());
        const auto look_up = [&](const std::vector<light_receiver>& some) {
            for (std::size_t i = 0; i < some.size(); ++i) visibility[i] = test(map.map(), some[i]);
        };
        std::optional<double> acne;
        if (!receivers.unbiased.empty()) {
            look_up(receivers.unbiased);
            acne = errors_of(mean_visibility(analytic_, visibility)).acne;
        }
        const double spent = least_seconds([&] { look_up(receivers.biased); });
        return {fmt::format("{}, receivers {}", map.method, how),
                map.format,
                map.bytes_per_texel(),
                map.build_ms,
                per_receiver(spent),
                &analytic_,
                std::move(visibility),
                1,
                acne};
    }

    void add_segments(const range_shadow_map& map, std::string_view how, shadow_test test)
    {
        add(by_segments(map, by_triangles_, how, test));
    }

    // Rows of maps in which triangles that cannot shadow one another share an id.
    void add_surfaces(const range_shadow_map& exact, const range_shadow_map& resolved)
    {
        const std::vector<std::uint32_t> ids = surface_ids(stage_.world);
        facts_["surfaces"] = std::set(ids.begin(), ids.end()).size();
        segment_receivers by_surfaces = by_triangles_;
        set_ids(by_surfaces.biased, ids), set_ids(by_surfaces.unbiased, ids);
        const auto add_one = [&](const range_shadow_map& map) {
            add_unpictured(by_segments(map, by_surfaces, "analytic", light_visibility));
        };
        add_one(with_ids(resolved, ids));
        const range_shadow_map renamed = with_ids(exact, ids);
        for (const int capacity : {4, 8, 16}) {
            range_shadow_map lists = interval_lists(renamed, capacity);
            lists.method += ", ids of surfaces";
            add_one(lists);
        }
    }

    error_statistics errors_of(const image<float>& estimate) const
    {
        std::vector<float> found, expected;
        for (const std::size_t pixel : pixels_) {
            found.push_back(estimate.pixels[pixel]);
            expected.push_back(reference_.visibility.pixels[pixel]);
        }
        return compare(found, expected);
    }

    void add_row(const outcome& o, const image<float>& estimate)
    {
        rows_.push_back({.scene = stage_.world.open.name,
                         .method = o.method,
                         .format = o.format,
                         .reference = "traced",
                         .receivers = static_cast<long long>(pixels_.size()),
                         .bytes_per_texel = o.bytes_per_texel,
                         .errors = errors_of(estimate),
                         .acne_unbiased = o.acne_unbiased,
                         .ns_per_receiver = o.ns_per_receiver,
                         .build_ms = o.build_ms,
                         .lanes = o.lanes});
    }

    void add_unpictured(const outcome& o)
    {
        facts_["unpictured"].push_back(o.method);
        add_row(o, mean_visibility(*o.seen, o.visibility));
    }

    void add(const outcome& o)
    {
        const std::string name = fmt::format("{:02}", facts_["methods"].size());
        const image<float> estimate = mean_visibility(*o.seen, o.visibility);
        write_png(folder_ / file(name), shade(stage_.world, stage_.light, *o.seen, o.visibility));
        write_png(folder_ / file(name + "-error"), error_picture(estimate, reference_.visibility, error_scale));
        facts_["methods"].push_back(
            {{"method", o.method}, {"format", o.format}, {"picture", file(name)}, {"error", file(name + "-error")}});
        add_row(o, estimate);
    }

    motion_scene listed_;
    const moving_stage& stage_;
    motion_sizes size_;
    std::filesystem::path folder_;
    reference_picture reference_;
    seen_motion analytic_, stochastic_;
    segment_receivers by_triangles_; // of what analytic_ sees
    std::vector<light_receiver> stochastic_receivers_;
    std::vector<std::size_t> pixels_; // that see a surface at some time
    nlohmann::ordered_json facts_;
    std::vector<report_row> rows_;
};

} // namespace

motion_sizes motion_sizes_of(const settings& how)
{
    const bool full = how.supersampling > 1, tiny = how.width < settings().width;
    const int shrink = full ? 1 : 4;
    return {how.width / shrink, how.height / shrink, full ? how.map_resolution : how.map_resolution / 2,
            tiny ? 64 : 1024};
}

motion_results compare_motion(const motion_scene& listed, const moving_stage& scenery, const motion_sizes& size,
                              const std::filesystem::path& folder)
{
    motion_comparison c(listed, scenery, size, folder);
    c.run();
    return std::move(c).results();
}

nlohmann::ordered_json facts_of(const motion_sizes& size)
{
    return {{"width", size.width},
            {"height", size.height},
            {"map_resolution", size.map_resolution},
            {"samples", size.reference_samples},
            {"error_scale", error_scale},
            {"scenes", nlohmann::json::array()}};
}

} // namespace gnomon::evaluation
