#include "resting_receivers.hpp"

#include <fmt/format.h>
#include <gnomon/passes/range_look_up.hpp>
#include <gnomon/simd/xsimd.hpp>

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "accumulation.hpp"
#include "light_receivers.hpp"
#include "range_maps.hpp"
#include "shadow_tests.hpp"
#include "timing.hpp"
#include "toolbox/moving_stages.hpp"
#include "toolbox/tracer.hpp"

namespace gnomon::demo {

using namespace toolbox;

namespace {

constexpr int cubes = 1600;
constexpr float longest = 0.5f;            // way of a cube at motion 1x
constexpr std::uint32_t nobody = 1u << 20; // the ground casts no shadow on what is on it

class ground_receivers {
  public:
    ground_receivers(float factor, const motion_sizes& size)
        : factor_(factor), scenery_(random_cubes(1, cubes, factor * longest)), size_(size), rays_(scenery_.world)
    {
        size_.map_resolution *= 4;
        // As close as a camera's pixels, so that maps are read as they would be; every fourth along either axis is
        // traced.
        const int side = size.reference_samples < 1024 ? 64 : 256;
        const glm::vec3 up(0, 1, 0);
        seen_ = {side, side, {0}, {}};
        std::vector<receiver_course> references;
        for (int i = 0; i < side * side; ++i) {
            const glm::vec2 share = (glm::vec2(i % side, i / side) + 0.5f) / float(side);
            const glm::vec3 p(8 * share.x - 4, 0, 8 * share.y - 4);
            seen_.courses.push_back({0, 1, 1, nobody, p, p, up, up});
            seen_.first.push_back(std::uint32_t(seen_.courses.size()));
            traced_.push_back({{p, up}, {p, up}});
            if (i % side % 4 == 0 && i / side % 4 == 0) {
                referred_.push_back(std::size_t(i));
                references.push_back(traced_.back());
            }
        }
        reference_.resize(references.size());
        rays_.mean_visibility(scenery_.light, references, 4 * size.reference_samples, reference_);
    }

    motion_results results()
    {
        add_rays(16);
        add_rays(32);
        add_maps(16);
        add_maps(32);
        const auto& [world, eye, light, interests] = scenery_;
        add_ranges(resolved_ranges(world, light, size_.map_resolution));
        add_ranges(with_totals(caster_ranges(world, light, size_.map_resolution)));
        return std::move(results_);
    }

  private:
    void add_rays(int count)
    {
        std::vector<float> found(traced_.size());
        const double spent = seconds_on_one_core([&] { rays_.mean_visibility(scenery_.light, traced_, count, found); });
        add(fmt::format("{} rays", count), "Embree", 0, 0, spent, found);
    }

    void add_maps(int count)
    {
        accumulated_maps maps;
        const double build = seconds_on_one_core(
            [&] { maps = accumulate(scenery_.world, scenery_.light, size_.map_resolution, count); });
        const seen_motion at_times = seen_at_times(seen_, maps);
        std::vector<float> found;
        const double spent = seconds_on_one_core(
            [&] { found = mean_visibility(at_times, accumulated_visibility(at_times, scenery_.light, maps)).pixels; });
        add(fmt::format("accumulation of {}", count), "32 bit depth", 4.0 * count, 1e3 * build, spent, found);
    }

    void add_ranges(const range_shadow_map& map)
    {
        const std::vector<light_receiver> receivers = light_receivers_of(seen_, scenery_.light, size_.map_resolution);
        std::vector<float> found(receivers.size());
        const double spent = seconds_on_one_core([&] {
            for (std::size_t i = 0; i < found.size(); ++i) found[i] = analytic_visibility(map.map(), receivers[i]);
        });
        add(map.method + ", receivers analytic", map.format, map.bytes_per_texel(), map.build_ms, spent, found);

        std::vector<placed_receiver<float>> placed;
        for (const light_receiver& r : receivers)
            placed.push_back({r.path.x0 / r.path.w0, r.path.y0 / r.path.w0,
                              static_receiver_begin(r.path.depth.z0, r.path.depth.id, 0.f, 1.f)});
        const double packed = seconds_on_one_core([&] { static_shadows<float>(map.map(), placed, found); });
        for (float& x : found) x = 1 - x;
        add(fmt::format("{}, receivers analytic, by packs", map.method), map.format, map.bytes_per_texel(),
            map.build_ms, packed, found, int(xsimd::batch<float>::size));
    }

    void add(const std::string& method, const std::string& format, double bytes, double build_ms, double seconds,
             const std::vector<float>& found, int lanes = 1)
    {
        std::vector<float> estimate, expected;
        for (std::size_t i = 0; i < reference_.size(); ++i)
            if (reference_[i] > 0 && reference_[i] < 1) {
                estimate.push_back(found[referred_[i]]);
                expected.push_back(reference_[i]);
            }
        const double ns = 1e9 * seconds / double(found.size());
        const report_row row{.scene = fmt::format("ground below {} random cubes, motion {}x", cubes, factor_),
                             .method = method,
                             .format = format,
                             .reference = "traced",
                             .receivers = static_cast<long long>(estimate.size()),
                             .bytes_per_texel = bytes,
                             .errors = compare(estimate, expected),
                             .ns_per_receiver = ns,
                             .build_ms = build_ms,
                             .lanes = lanes};
        if (results_.rows.empty()) rays_ns_ = ns;
        results_.rows.push_back(row);
        results_.facts.push_back(
            {{"factor", factor_}, {"method", method}, {"ns", ns}, {"rmse", row.errors.rmse}, {"ratio", rays_ns_ / ns}});
    }

    float factor_;
    moving_stage scenery_;
    motion_sizes size_; // of a map, four times that of other scenes: totals cost no more to read
    tracer rays_;
    seen_motion seen_;
    std::vector<receiver_course> traced_;
    std::vector<std::size_t> referred_; // the receivers that the reference is of
    std::vector<float> reference_;
    double rays_ns_ = 0; // of 16 rays, the first method
    motion_results results_{nlohmann::json::array(), {}};
};

} // namespace

motion_results compare_resting_receivers(const motion_sizes& size)
{
    motion_results all{nlohmann::json::array(), {}};
    for (const float factor : {1.f, 4.f}) {
        const motion_results some = ground_receivers(factor, size).results();
        for (const auto& fact : some.facts) all.facts.push_back(fact);
        all.rows.insert(all.rows.end(), some.rows.begin(), some.rows.end());
    }
    return all;
}

} // namespace gnomon::demo
