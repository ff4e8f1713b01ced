#include "resting_receivers.hpp"

#include "accumulation.hpp"
#include "evaluation/core/timing.hpp"
#include "light_receivers.hpp"
#include "range_maps.hpp"
#include "renderer/scene/moving_stages.hpp"
#include "renderer/trace/tracer.hpp"
#include "shadow_tests.hpp"

#include <gnomon/passes/range/look_up.hpp>

#include <fmt/format.h>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string_view>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

constexpr int cubes = 1600;
constexpr float longest = 0.5f;            // way of a cube at motion 1x
constexpr std::uint32_t nobody = 1u << 20; // receivers cast no shadow

// The time by which an open shutter has let in this share of its light (shutter_tent, inverted).
float tent_time(float share) { return share < 0.5f ? std::sqrt(0.5f * share) : 1 - std::sqrt(0.5f * (1 - share)); }

// Level receivers, as close as a camera's pixels, so that maps are read as they would be. Every fourth along either
// axis is traced.
struct resting_points {
    std::string_view where;
    seen_motion seen;
    std::vector<receiver_motion> motions;
    std::vector<std::size_t> referred; // the receivers that the reference is of
    std::vector<float> reference, tent_reference;
};

resting_points points(std::string_view where, int side, const tracer& rays, const moving_camera& light, int samples)
{
    const glm::vec3 up(0, 1, 0);
    resting_points result{where, {side, side, {0}, {}}, {}, {}, {}, {}};
    std::vector<receiver_motion> referred;
    std::mt19937 bits(1);
    for (int i = 0; i < side * side; ++i) {
        const glm::vec2 share = (glm::vec2(i % side, i / side) + 0.5f) / float(side);
        const float height = where == "ground" ? 0 : 0.5f + 4 * float(bits() >> 8) * 0x1p-24f;
        const glm::vec3 p(8 * share.x - 4, height, 8 * share.y - 4);
        result.seen.segments.push_back({0, 1, 1, nobody, p, p, up, up});
        result.seen.first.push_back(std::uint32_t(result.seen.segments.size()));
        result.motions.push_back({{p, up}, {p, up}});
        if (i % side % 4 != 0 || i / side % 4 != 0) continue;
        result.referred.push_back(std::size_t(i));
        referred.push_back(result.motions.back());
    }
    result.reference.resize(referred.size());
    rays.mean_visibility(light, referred, samples, result.reference);
    return result;
}

class resting_comparison {
  public:
    resting_comparison(float factor, const motion_sizes& size)
        : factor_(factor), scenery_(random_cubes(1, cubes, factor * longest)), size_(size), rays_(scenery_.world)
    {
        size_.map_resolution *= 4;
        const int side = size.reference_samples < 1024 ? 64 : 256;
        for (const char* where : {"ground", "among"})
            points_.push_back(points(where, side, rays_, scenery_.light, size.reference_samples));
        points_[0].tent_reference.resize(points_[0].referred.size());
        std::vector<receiver> asked;
        for (const std::size_t i : points_[0].referred) asked.push_back(points_[0].motions[i].open);
        tent_rays(asked, size.reference_samples, points_[0].tent_reference);
    }

    motion_results results()
    {
        for (const int count : {16, 32})
            for (const resting_points& at : points_) add_rays(at, count);
        for (const int count : {16, 32}) add_maps(count);
        const auto& [world, eye, light, interests] = scenery_;
        const range_shadow_map resolved = resolved_ranges(world, light, size_.map_resolution);
        for (const resting_points& at : points_) add_ranges(at, resolved);
        add_tent(points_[0], resolved);
        const range_shadow_map casters = with_totals(caster_ranges(world, light, size_.map_resolution));
        for (const resting_points& at : points_) add_ranges(at, casters);
        const compact_shadow_map packed = compact_ranges(casters);
        for (const resting_points& at : points_) add_packed(at, packed);
        return std::move(results_);
    }

  private:
    struct measured {
        std::string method, format;
        double bytes_per_texel, build_ms, seconds;
        int lanes = 1;
        bool tent = false;
    };

    std::vector<light_receiver> receivers_of(const resting_points& at) const
    {
        return light_receivers_of(at.seen, scenery_.light, size_.map_resolution);
    }

    // At times as dense as a shutter that opens and closes evenly is open.
    void tent_rays(const std::vector<receiver>& asked, int count, std::vector<float>& found) const
    {
        std::vector<float> times(asked.size()), seen(asked.size());
        std::mt19937 bits(2);
        std::ranges::fill(found, 0.f);
        for (int k = 0; k < count; ++k) {
            for (float& t : times) t = tent_time((float(k) + float(bits() >> 8) * 0x1p-24f) / float(count));
            rays_.visibility(scenery_.light, asked, times, seen);
            for (std::size_t i = 0; i < found.size(); ++i) found[i] += seen[i] / float(count);
        }
    }

    void add_rays(const resting_points& at, int count)
    {
        std::vector<float> found(at.motions.size());
        const double spent = least_seconds([&] { rays_.mean_visibility(scenery_.light, at.motions, count, found); });
        add(at, {fmt::format("{} rays", count), "Embree", 0, 0, spent}, found);
    }

    void add_maps(int count)
    {
        accumulated_maps maps;
        interleaved_maps together;
        const double build = least_seconds([&] {
            maps = accumulate(scenery_.world, scenery_.light, size_.map_resolution, middle_times(count));
            together = interleave(maps);
        });
        maps = {};
        for (const resting_points& at : points_) {
            std::vector<resting_receiver> receivers;
            for (const light_receiver& r : receivers_of(at))
                receivers.push_back({r.path.x0 / r.path.w0, r.path.y0 / r.path.w0, r.path.depth.z0});
            std::vector<float> found(receivers.size());
            const double spent = least_seconds([&] { resting_visibility(together, receivers, found); });
            add(at,
                {fmt::format("accumulation of {}", count), "32 bit depth", 4.0 * double(together.depths_per_texel()),
                 1e3 * build, spent, int(accumulation_pack::size)},
                found);
        }
    }

    template <class Visibility>
    void add_analytic(const resting_points& at, const map_facts& map, const Visibility& visibility_of)
    {
        const std::vector<light_receiver> receivers = receivers_of(at);
        std::vector<float> found(receivers.size());
        const double spent = least_seconds([&] {
            for (std::size_t i = 0; i < found.size(); ++i) found[i] = visibility_of(receivers[i]);
        });
        add(at, {map.method + ", receivers analytic", map.format, map.bytes_per_texel(), map.build_ms, spent}, found);
    }

    void add_ranges(const resting_points& at, const range_shadow_map& map)
    {
        add_analytic(at, map, [&](const light_receiver& r) { return light_visibility(map.map(), r); });
        std::vector<placed_receiver<float>> placed;
        for (const light_receiver& r : receivers_of(at))
            placed.push_back({r.path.x0 / r.path.w0, r.path.y0 / r.path.w0, whole_exposure(r)});
        std::vector<float> found(placed.size());
        const double spent = least_seconds([&] { static_intensities<float>(map.map(), placed, found); });
        for (float& x : found) x = 1 - x;
        add(at,
            {fmt::format("{}, receivers analytic, many at a time", map.method), map.format, map.bytes_per_texel(),
             map.build_ms, spent},
            found);
    }

    void add_packed(const resting_points& at, const compact_shadow_map& map)
    {
        add_analytic(at, map, [&](const light_receiver& r) {
            return 1 -
                   gnomon::static_intensity(map.map(), r.path.x0 / r.path.w0, r.path.y0 / r.path.w0, whole_exposure(r));
        });
    }

    // A shutter that opens and closes evenly.
    void add_tent(const resting_points& at, const range_shadow_map& map)
    {
        const std::vector<light_receiver> receivers = receivers_of(at);
        std::vector<float> found(receivers.size());
        const double spent = least_seconds([&] {
            for (std::size_t i = 0; i < found.size(); ++i) {
                const receiver_path<float>& p = receivers[i].path;
                found[i] = 1 - gnomon::static_intensity(map.map(), p.x0 / p.w0, p.y0 / p.w0,
                                                        whole_exposure(receivers[i]), 1, tent_shutter{});
            }
        });
        add(at,
            {map.method + ", receivers analytic, tent shutter", map.format, map.bytes_per_texel(), map.build_ms, spent,
             1, true},
            found);
        std::vector<receiver> asked;
        for (const receiver_motion& c : at.motions) asked.push_back(c.open);
        const double traced = least_seconds([&] { tent_rays(asked, 16, found); });
        add(at, {"16 rays, tent shutter", "Embree", 0, 0, traced, 1, true}, found);
    }

    static static_receiver<float> whole_exposure(const light_receiver& r)
    {
        return static_receiver_begin(r.path.depth.z0, r.path.depth.id, 0.f, 1.f);
    }

    void add(const resting_points& at, const measured& how, const std::vector<float>& found)
    {
        const std::vector<float>& reference = how.tent ? at.tent_reference : at.reference;
        std::vector<float> estimate, expected;
        for (std::size_t i = 0; i < reference.size(); ++i)
            if (reference[i] > 0 && reference[i] < 1) {
                estimate.push_back(found[at.referred[i]]);
                expected.push_back(reference[i]);
            }
        const double ns = 1e9 * how.seconds / double(found.size());
        const std::string place = at.where == "ground" ? "ground below" : "among";
        const report_row row{.scene = fmt::format("{} {} random cubes, motion {}x", place, cubes, factor_),
                             .method = how.method,
                             .format = how.format,
                             .reference = "traced",
                             .receivers = static_cast<long long>(estimate.size()),
                             .bytes_per_texel = how.bytes_per_texel,
                             .errors = compare(estimate, expected),
                             .ns_per_receiver = ns,
                             .build_ms = how.build_ms,
                             .lanes = how.lanes};
        if (how.method == "16 rays") rays_ns_[at.where] = ns;
        results_.rows.push_back(row);
        results_.facts.push_back({{"factor", factor_},
                                  {"where", at.where},
                                  {"shutter", how.tent ? "tent" : "box"},
                                  {"method", how.method},
                                  {"bytes_per_texel", how.bytes_per_texel},
                                  {"build_ms", how.build_ms},
                                  {"ns", ns},
                                  {"rmse", row.errors.rmse},
                                  {"ratio", rays_ns_[at.where] / ns}});
    }

    float factor_;
    moving_stage scenery_;
    motion_sizes size_; // of a map, four times that of other scenes: totals cost no more to read
    tracer rays_;
    std::vector<resting_points> points_;
    std::map<std::string_view, double> rays_ns_; // of 16 rays, the first method, in each place
    motion_results results_{nlohmann::json::array(), {}};
};

} // namespace

motion_results compare_resting_receivers(const motion_sizes& size, float factor)
{
    return resting_comparison(factor, size).results();
}

} // namespace gnomon::evaluation
