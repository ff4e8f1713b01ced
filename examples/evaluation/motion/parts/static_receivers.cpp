// The cost of a static receiver, and the error of its visibility over the whole shutter interval: by resolved ranges,
// shadow maps of some times, and rays at some times; among random cubes and on the ground below them, behind all of
// them; at one speed and at four times as much.
#include "evaluation/core/progress.hpp"
#include "evaluation/core/timing.hpp"
#include "evaluation/motion/accumulation.hpp"
#include "evaluation/motion/motion_method.hpp"
#include "evaluation/motion/motion_part.hpp"
#include "evaluation/motion/packed_map.hpp"
#include "evaluation/motion/receivers/analytic.hpp"
#include "evaluation/motion/static_blocks.hpp"
#include "renderer/scene/moving_stages.hpp"
#include "renderer/trace/tracer.hpp"

#include <gnomon/passes/range/look_up.hpp>

#include <fmt/format.h>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

const registered<family> rays_family{family{.id = "rays", .label = "rays", .order = 90, .colour = "#bcbd22"}};
const registered<method> rays_method{method_facts{.id = "rays", .family = "rays", .label = "rays"}};
const registered<receiver_kind> times_of_rays{
    receiver_facts{.id = "at_times_of_rays", .label = "receivers at the times of the rays", .order = 90}};
const registered<map_kind> interleaved_kind{
    map_kind{.id = "interleaved_depths", .label = "shadow maps of some times, texel by texel", .order = 105}};
const registered<receiver_kind> batch{receiver_facts{
    .id = "analytic_batch", .label = "analytic receivers, many at a time", .order = 160, .marker = "star"}};

constexpr int cubes = 1600;
constexpr float longest = 0.5f;               // path of a cube at speed 1
constexpr std::uint32_t no_caster = 1u << 20; // receivers cast no shadow

// The time by which an open shutter has let in this share of its light (shutter_tent, inverted).
float tent_time(float share) { return share < 0.5f ? std::sqrt(0.5f * share) : 1 - std::sqrt(0.5f * (1 - share)); }

// Level receivers, as close as a camera's pixels, so that maps are read as they would be. Every fourth along either
// axis is traced.
struct static_points {
    std::string_view where;
    seen_motion seen;
    std::vector<receiver_motion> motions;
    std::vector<std::size_t> referred; // the receivers that the reference is of
    std::vector<float> reference, tent_reference;
};

static_points points(std::string_view where, int side, const tracer& rays, const moving_camera& light, int samples)
{
    const glm::vec3 up(0, 1, 0);
    static_points result{where, {side, side, {0}, {}}, {}, {}, {}, {}};
    std::vector<receiver_motion> referred;
    std::mt19937 bits(1);
    for (int i = 0; i < side * side; ++i) {
        const glm::vec2 share = (glm::vec2(i % side, i / side) + 0.5f) / float(side);
        const float height = where == behind_all ? 0 : 0.5f + 4 * float(bits() >> 8) * 0x1p-24f;
        const glm::vec3 p(8 * share.x - 4, height, 8 * share.y - 4);
        result.seen.segments.push_back({0, 1, 1, no_caster, p, p, up, up});
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

class static_comparison {
  public:
    static_comparison(float speed, const motion_sizes& size)
        : speed_(speed), stage_(random_cubes(1, cubes, speed * longest)), size_(size), rays_(stage_.world)
    {
        size_.map_resolution *= 4;
        const int side = size.reference_samples < 1024 ? 64 : 256;
        for (const char* where : {behind_all, among_casters})
            points_.push_back(points(where, side, rays_, stage_.light, size.reference_samples));
        points_[0].tent_reference.resize(points_[0].referred.size());
        std::vector<receiver> placed;
        for (const std::size_t i : points_[0].referred) placed.push_back(points_[0].motions[i].open);
        tent_rays(placed, size.reference_samples, points_[0].tent_reference);
    }

    std::vector<report_row> rows()
    {
        for (const int count : {least_rays, 2 * least_rays})
            for (const static_points& at : points_) add_rays(at, count);
        for (const int count : {16, 32}) add_maps(count);
        map_source maps(stage_.world, stage_.light, size_.map_resolution);
        const auto resolved = maps.map("resolved_ranges");
        for (const static_points& at : points_) add_ranges(at, "resolved_ranges", *resolved);
        add_tent(points_[0], *resolved);
        const auto casters = maps.map("caster_ranges", {{"totals", 1}});
        for (const static_points& at : points_) add_ranges(at, "caster_ranges", *casters);
        const packed_map packed = packed_map_of(*casters);
        for (const static_points& at : points_) add_packed(at, packed);
        return std::move(rows_);
    }

  private:
    std::vector<light_receiver> receivers_of(const static_points& at) const
    {
        return light_receivers_of(at.seen, stage_.light, size_.map_resolution);
    }

    // At times as dense as a shutter that opens and closes evenly is open.
    void tent_rays(const std::vector<receiver>& placed, int count, std::vector<float>& found) const
    {
        std::vector<float> times(placed.size()), seen(placed.size());
        std::mt19937 bits(2);
        std::ranges::fill(found, 0.f);
        for (int k = 0; k < count; ++k) {
            for (float& t : times) t = tent_time((float(k) + float(bits() >> 8) * 0x1p-24f) / float(count));
            rays_.visibility(stage_.light, placed, times, seen);
            for (std::size_t i = 0; i < found.size(); ++i) found[i] += seen[i] / float(count);
        }
    }

    static report_row row_of_rays(int count)
    {
        report_row row = row_of(*rays_method);
        row.label = fmt::format("{} rays", count);
        row.receiver = times_of_rays->id;
        row.parameters["times"] = count;
        return row;
    }

    void add_rays(const static_points& at, int count)
    {
        std::vector<float> found(at.motions.size());
        const double spent = least_seconds([&] { rays_.mean_visibility(stage_.light, at.motions, count, found); });
        add(at, row_of_rays(count), spent, found);
    }

    void add_maps(int count)
    {
        accumulated_maps maps;
        interleaved_maps together;
        map_facts facts = accumulation_facts(count, size_.map_resolution);
        facts.kind = interleaved_kind->id;
        facts.build_ms = 1e3 * least_seconds([&] {
                             maps = accumulate(stage_.world, stage_.light, size_.map_resolution, middle_times(count));
                             together = interleave(maps);
                         });
        facts.bytes = texels_of(size_.map_resolution) * together.depths_per_texel() * sizeof(float);
        maps = {};
        for (const static_points& at : points_) {
            std::vector<static_place> receivers;
            for (const light_receiver& r : receivers_of(at))
                receivers.push_back({r.path.x0 / r.path.w0, r.path.y0 / r.path.w0, r.path.depth.z0});
            std::vector<float> found(receivers.size());
            const double spent = least_seconds([&] { static_visibility(together, receivers, found); });
            report_row row = row_of(registry_of<method>().at("accumulation"), facts);
            row.receiver = "at_times_of_maps";
            row.lanes = int(accumulation_pack::size);
            add(at, std::move(row), spent, found);
        }
    }

    static report_row row_of_ranges(const char* method_id, const map_facts& map, const char* receiver)
    {
        report_row row = row_of(registry_of<method>().at(method_id), map);
        row.receiver = receiver;
        row.label += ", " + registry_of<receiver_kind>().at(receiver).label;
        return row;
    }

    template <class Visibility>
    void add_analytic(const static_points& at, report_row row, const Visibility& visibility_of)
    {
        const std::vector<light_receiver> receivers = receivers_of(at);
        std::vector<float> found(receivers.size());
        const double spent = least_seconds([&] {
            for (std::size_t i = 0; i < found.size(); ++i) found[i] = visibility_of(receivers[i]);
        });
        add(at, std::move(row), spent, found);
    }

    void add_ranges(const static_points& at, const char* method_id, const range_shadow_map& map)
    {
        add_analytic(at, row_of_ranges(method_id, map, "analytic"),
                     [&](const light_receiver& r) { return light_visibility(map.map(), r); });
        std::vector<placed_receiver<float>> placed;
        for (const light_receiver& r : receivers_of(at))
            placed.push_back({r.path.x0 / r.path.w0, r.path.y0 / r.path.w0, whole_exposure(r)});
        std::vector<float> found(placed.size());
        const double spent = least_seconds([&] { static_intensities<float>(map.map(), placed, found); });
        for (float& x : found) x = 1 - x;
        add(at, row_of_ranges(method_id, map, "analytic_batch"), spent, found);
    }

    void add_packed(const static_points& at, const packed_map& map)
    {
        add_analytic(at, row_of_ranges("packed_caster_ranges", map, "analytic"), [&](const light_receiver& r) {
            return 1 - static_intensity(map.map(), r.path.x0 / r.path.w0, r.path.y0 / r.path.w0, whole_exposure(r));
        });
    }

    // A shutter that opens and closes evenly.
    void add_tent(const static_points& at, const range_shadow_map& map)
    {
        const auto with_tent = [](report_row row) {
            row.parameters["tent"] = 1;
            row.label += ", tent shutter";
            return row;
        };
        add_analytic(at, with_tent(row_of_ranges("resolved_ranges", map, "analytic")), [&](const light_receiver& r) {
            const receiver_path<float>& p = r.path;
            return 1 - static_intensity(map.map(), p.x0 / p.w0, p.y0 / p.w0, whole_exposure(r), 1, tent_shutter{});
        });
        std::vector<receiver> placed;
        for (const receiver_motion& c : at.motions) placed.push_back(c.open);
        std::vector<float> found(placed.size());
        const double traced = least_seconds([&] { tent_rays(placed, least_rays, found); });
        add(at, with_tent(row_of_rays(least_rays)), traced, found);
    }

    static static_receiver<float> whole_exposure(const light_receiver& r)
    {
        return static_receiver_begin(r.path.depth.z0, r.path.depth.id, 0.f, 1.f);
    }

    // Errors are over receivers that are neither lit nor in shadow all of the time.
    void add(const static_points& at, report_row row, double seconds, const std::vector<float>& found)
    {
        const std::vector<float>& reference = has_tent(row) ? at.tent_reference : at.reference;
        std::vector<float> estimate, expected;
        for (std::size_t i = 0; i < reference.size(); ++i)
            if (reference[i] > 0 && reference[i] < 1) {
                estimate.push_back(found[at.referred[i]]);
                expected.push_back(reference[i]);
            }
        row.scene = "random_cubes";
        row.part = at.where;
        row.parameters["cubes"] = cubes;
        row.parameters["speed"] = double(speed_);
        row.reference = "traced";
        row.receivers = static_cast<long long>(estimate.size());
        row.errors = compare(estimate, expected);
        row.ns_per_receiver = 1e9 * seconds / double(found.size());
        rows_.push_back(std::move(row));
    }

    float speed_;
    moving_stage stage_;
    motion_sizes size_; // of a map, four times that of other scenes: totals cost no more to read
    tracer rays_;
    std::vector<static_points> points_;
    std::vector<report_row> rows_;
};

part_run static_receivers(const motion_settings& how)
{
    const std::vector<float> speeds{1, 4};
    const auto found = std::make_shared<std::vector<std::vector<report_row>>>(speeds.size());
    part_run result;
    for (std::size_t i = 0; i < speeds.size(); ++i)
        result.tasks.push_back(
            [=, size = how.size, speed = speeds[i]] { (*found)[i] = static_comparison(speed, size).rows(); });
    result.results = [=] {
        part_results r;
        for (const auto& some : *found) r.rows.insert(r.rows.end(), some.begin(), some.end());
        r.blocks.push_back(static_table(r.rows));
        return r;
    };
    return result;
}

const registered<motion_part> entry{
    motion_part{.id = "static_receivers", .label = "static receivers", .order = 60, .begin = static_receivers}};

} // namespace

} // namespace gnomon::evaluation
