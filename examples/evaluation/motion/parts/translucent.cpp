// Translucent casters in motion: ranges with opacities, whose mean transmittance is found in closed form, against rays
// at some times, and against maps that take every caster for opaque.
#include "evaluation/core/timing.hpp"
#include "evaluation/motion/motion_method.hpp"
#include "evaluation/motion/motion_part.hpp"
#include "evaluation/motion/receivers/analytic.hpp"
#include "evaluation/motion/receivers/while_facing.hpp"
#include "evaluation/motion/scene_blocks.hpp"
#include "renderer/scene/moving_stages.hpp"
#include "renderer/trace/tracer.hpp"

#include <gnomon/passes/range/resolve.hpp>
#include <gnomon/passes/range/translucent.hpp>

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <memory>
#include <random>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

const registered<scene_entry> panes{scene_facts{
    .id = "moving_panes",
    .label = "panes of glass that cross one another",
    .order = 260,
    .text = "Three panes of dark glass, which stop 40%, 60% and 80% of the light, cross one another above a cube."}};
const registered<family> translucent{
    family{.id = "translucent_ranges", .label = "ranges with opacities", .order = 155, .colour = "#17becf"}};
const registered<method> ranges_method{
    method_facts{.id = "translucent_ranges", .family = "translucent_ranges", .label = "ranges with opacities"}};

constexpr int step = 2; // every pixel of so many along either axis is referred to

// The lists of all ranges without what an opaque surface hides at all times: opaque ranges resolved, then translucent
// ones as they are.
struct translucent_map : map_facts {
    std::vector<std::uint32_t> first{0};
    std::vector<depth_time_range<float>> ranges;
    std::vector<float> opacities;

    translucent_range_map<float> map() const
    {
        return {{std::size_t(resolution), std::size_t(resolution), first, ranges}, opacities};
    }
};

translucent_map with_opacities(const range_shadow_map& exact, const moving_scene& world)
{
    translucent_map result{unresolved_lists(ranges_method->label, exact.resolution), {0}, {}, {}};
    result.format = {"ranges_24b", "24 B ranges"};
    const triangle_numbers numbers(world.open);
    std::vector<depth_time_range<float>> opaque;
    std::vector<visible_span<float>> spans;
    const auto add = [&](const depth_time_range<float>& r, float opacity) {
        result.ranges.push_back(r), result.opacities.push_back(opacity);
    };
    result.build_ms =
        exact.build_ms + 1e3 * least_seconds([&] {
                             result.first = {0}, result.ranges.clear(), result.opacities.clear();
                             for (std::size_t texel = 0; texel + 1 < exact.first.size(); ++texel) {
                                 opaque.clear();
                                 const auto opacity_of = [&](const depth_time_range<float>& r) {
                                     return world.open.meshes[numbers[std::uint32_t(r.id)].mesh].opacity.x;
                                 };
                                 for (const auto& r : list_of(exact, texel))
                                     if (opacity_of(r) >= 1) opaque.push_back(r);
                                 spans.resize(resolve_capacity(opaque.size(), range_ids::surfaces));
                                 for (const auto& s : resolve_ranges<float>(opaque, spans, range_ids::surfaces))
                                     add(range_of<float>(opaque, s), 1);
                                 for (const auto& r : list_of(exact, texel))
                                     if (opacity_of(r) < 1) add(r, opacity_of(r));
                                 result.first.push_back(std::uint32_t(result.ranges.size()));
                             }
                         });
    result.bytes = result.first.size() * sizeof result.first[0] + result.ranges.size() * sizeof result.ranges[0] +
                   result.opacities.size() * sizeof result.opacities[0];
    return result;
}

class translucent_comparison {
  public:
    translucent_comparison(const motion_sizes& size, std::filesystem::path folder)
        : size_(size),
          folder_(std::move(folder)),
          stage_(moving_panes(double(size.width) / size.height)),
          opaque_{opaque_part(stage_.world.open), stage_.world.closing},
          rays_(stage_.world),
          seen_(camera_segments(opaque_, stage_.eye, size.width, size.height, depth_tolerance))
    {
        for (int y = 0; y < size.height; y += step)
            for (int x = 0; x < size.width; x += step)
                if (const auto i = std::size_t(y * size.width + x); !seen_(i).empty()) pixels_.push_back(i);
        reference_ = traced(seen_, pixels_, size.reference_samples / 4);
    }

    part_results results()
    {
        map_source maps(stage_.world, stage_.light, size_.map_resolution);
        const auto receivers = light_receivers_of(seen_, stage_.light, size_.map_resolution);
        std::vector<float> found(receivers.size());
        const auto look_up = [&](const auto& visibility) {
            return least_seconds([&] { std::ranges::transform(receivers, found.begin(), visibility); });
        };

        const translucent_map map = with_opacities(*maps.map("exact_ranges"), stage_.world);
        double spent = look_up([&](const light_receiver& r) {
            return while_facing(r, [&](const receiver_path<float>& path) {
                return 1 - moving_intensity(map.map(), path, path.depth.t0, path.depth.t1);
            });
        });
        add(row_of(*ranges_method, map), "analytic", spent, found);
        show("ranges", found, "ranges with opacities");

        const auto& resolved = registry_of<method>().at("resolved_ranges");
        const auto as_if_opaque = maps.map(resolved.id);
        spent = look_up([&](const light_receiver& r) { return light_visibility(as_if_opaque->map(), r); });
        add(row_of(resolved, *as_if_opaque), "analytic", spent, found);
        show("opaque", found, "resolved ranges, which take all casters for opaque");

        for (const int count : {16, 64}) {
            std::vector<float> at_pixels;
            const double traced_in = least_seconds([&] { at_pixels = traced(seen_, pixels_, count); });
            report_row row = row_of(registry_of<method>().at("rays"));
            row.label = fmt::format("{} rays", count);
            row.parameters["times"] = count;
            add_errors(std::move(row), "at_times_of_rays", traced_in * step * step, at_pixels);
        }
        return {.rows = rows_, .blocks = {pictures_, table()}};
    }

  private:
    // The mean transmittance of some pixels, by rays at so many times of each segment.
    std::vector<float> traced(const seen_motion& seen, const std::vector<std::size_t>& pixels, int count) const
    {
        std::vector<receiver> from;
        std::vector<float> times;
        std::vector<glm::vec3> passed;
        std::vector<float> result(pixels.size()), weights(pixels.size());
        std::mt19937 bits(3);
        for (int k = 0; k < count; ++k) {
            from.clear(), times.clear();
            for (const std::size_t i : pixels)
                for (const seen_segment& s : seen(i)) {
                    const float u = (float(k) + float(bits() >> 8) * 0x1p-24f) / float(count);
                    from.push_back({glm::mix(s.p0, s.p1, u), glm::normalize(glm::mix(s.n0, s.n1, u))});
                    times.push_back(s.t0 + u * (s.t1 - s.t0));
                }
            passed.resize(from.size());
            rays_.transmittance(stage_.light, from, times, passed);
            std::size_t ray = 0;
            for (std::size_t p = 0; p < pixels.size(); ++p)
                for (const seen_segment& s : seen(pixels[p]))
                    result[p] += s.weight * passed[ray++].x, weights[p] += s.weight;
        }
        for (std::size_t p = 0; p < pixels.size(); ++p) result[p] /= weights[p];
        return result;
    }

    void add(report_row row, const char* receiver, double seconds, const std::vector<float>& of_segments)
    {
        const image<float> mean = mean_visibility(seen_, of_segments);
        std::vector<float> at_pixels;
        for (const std::size_t i : pixels_) at_pixels.push_back(mean.pixels[i]);
        row.label += ", " + registry_of<receiver_kind>().at(receiver).label;
        add_errors(std::move(row), receiver, seconds, at_pixels);
    }

    void add_errors(report_row row, const char* receiver, double seconds, const std::vector<float>& at_pixels)
    {
        row.scene = panes->id;
        row.part = "translucent";
        row.receiver = receiver;
        row.reference = "traced";
        row.receivers = static_cast<long long>(pixels_.size());
        row.errors = compare(at_pixels, reference_);
        row.ns_per_receiver = 1e9 * seconds / double(pixels_.size() * step * step);
        rows_.push_back(std::move(row));
    }

    void show(const char* name, const std::vector<float>& visibility, const char* words)
    {
        const std::string file = fmt::format("{}-{}.png", panes->id, name);
        write_png(folder_ / file, shade(opaque_, stage_.light, seen_, visibility));
        pictures_.pictures.push_back({file, fmt::format("the ground below {} by {}", panes->label, words), words});
    }

    table_block table() const
    {
        table_block result{
            .text = fmt::format(
                "{} Each range has the opacity of its surface. Between two times at which a range begins or ends to "
                "be in front of the receiver, the transmittance is the product of 1 - opacity over the ranges in "
                "front; the mean over the shutter interval is the sum of these steps. The reference traces {} rays for "
                "each segment of time of a pixel. Errors are in thousandths of visibility.",
                panes->text, size_.reference_samples / 4),
            .columns = {{.key = "method", .label = "method"},
                        number_column("bytes", "bytes per texel", 0),
                        error_column("rmse", "RMSE"),
                        error_column("largest", "largest error", 1),
                        number_column("ns", "ns per receiver", 0, best::low)},
            .rows = {}};
        for (const report_row& row : rows_)
            result.rows.push_back({.cells = {{"method", row.label},
                                             {"bytes", row.map_bytes > 0 ? cell(row.bytes_per_texel) : cell()},
                                             {"rmse", row.errors.rmse},
                                             {"largest", row.errors.max_abs},
                                             {"ns", row.ns_per_receiver}}});
        return result;
    }

    motion_sizes size_;
    std::filesystem::path folder_;
    moving_stage stage_;
    moving_scene opaque_;
    tracer rays_;
    seen_motion seen_;
    std::vector<std::size_t> pixels_; // that see a surface and are referred to
    std::vector<float> reference_;
    std::vector<report_row> rows_;
    pictures_block pictures_{.title = "Translucent casters",
                             .text = "Panes are left out of the pictures, their shadows are not.",
                             .columns = 2,
                             .pictures = {}};
};

part_run begin_translucent(const motion_settings& how)
{
    const auto found = std::make_shared<part_results>();
    return {.tasks = {[=] { *found = translucent_comparison(how.size, how.folder).results(); }},
            .results = [=] { return std::move(*found); }};
}

const registered<motion_part> entry{
    motion_part{.id = "translucent", .label = "translucent casters", .order = 70, .begin = begin_translucent}};

} // namespace

} // namespace gnomon::evaluation
