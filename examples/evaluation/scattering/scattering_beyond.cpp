#include "scattering_beyond.hpp"

#include "evaluation/core/timed_look_ups.hpp"
#include "renderer/trace/tracer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

const registered<scene_entry> fog{scene_facts{
    .id = "height_fog",
    .label = "height fog",
    .order = 260,
    .text = "The hall and the trees in air that thins out with height. The weights of a row are those of its "
            "middle ray."}};
const registered<scene_entry> veils{
    scene_facts{.id = "veils",
                .label = "translucent veils in the hall",
                .order = 270,
                .text = "Every surface of a pixel has a look-up of its own, up to that surface."}};

constexpr std::array falloffs{0.1, 0.4}; // for a meter of height
constexpr double shown_falloff = 0.1;
// A high light and a low one.
struct foggy_stage {
    const char* id;
    scattering_stage (*make)(double aspect);
};
constexpr std::array foggy{foggy_stage{"room", room_stage}, foggy_stage{"trees", trees_stage}};
constexpr const char* shown_scene = "trees";

constexpr std::array of_veils{"ray_march_32",           "min_max_rows",     "scatter4_unorm16_paper",
                              "scatter6_unorm16_paper", "scatter4_unorm16", "scatter6_unorm16"};
constexpr const char* best_of_both = "scatter6_unorm16";

const scattering_method& method_of(const char* id)
{
    return dynamic_cast<const scattering_method&>(registry_of<method>().at(id));
}

// A map of a method, and a row of its errors against ray tracing with its costs.
class measured_map {
  public:
    measured_map(const scattering_method& m, const scattering_scene& scene) : of_(m), map_(m.build(scene)) {}

    std::vector<float> visibilities(std::span<const view_segment> where) const { return visibilities_of(*map_, where); }

    std::vector<float> exact(std::span<const view_segment> where) const { return map_->exact(where).value(); }

    report_row row(const scene_facts& scene, std::span<const view_segment> where, std::span<const float> visibility,
                   std::span<const float> traced) const
    {
        report_row result = row_of(of_);
        result.scene = scene.id;
        result.receiver = "view_rays";
        result.reference = scattering_references[1].id;
        result.receivers = static_cast<long long>(traced.size());
        result.errors = compare(visibility, traced);
        result.map_bytes = double(map_->bytes());
        for (const build_pass& p : map_->passes()) {
            result.passes.emplace_back(p.name, p.milliseconds);
            result.build_ms += p.milliseconds;
        }
        const std::vector<view_segment> timed = runs_to_time(where);
        std::vector<float> scratch(timed.size());
        const timed_look_up look_up = map_->timed(timed).front();
        result.lanes = look_up.lanes;
        result.ns_kernel = nanoseconds(look_up.kernel, scratch, 0.005);
        result.ns_per_receiver = nanoseconds(look_up.look_up, scratch, 0.005);
        return result;
    }

  private:
    const scattering_method& of_;
    std::unique_ptr<scattering_map> map_;
};

shown_picture saved(const picture& shown, const scene_facts& scene, const std::string& id, const std::string& label,
                    const std::filesystem::path& folder)
{
    const std::string file = fmt::format("{}-{}.png", scene.id, id);
    write_png(folder / file, shown);
    return {file, fmt::format("{}, by {}", scene.label, label), escaped(label)};
}

// The veils with all surfaces of each pixel, and the visibility of the air before each.
class layered_view {
  public:
    layered_view(const scattering_stage& stage, const settings& how)
        : stage_(stage),
          opaque_{stage},
          seen_(rasterize_surface_layers(stage.world, stage.eye, how.width, how.height)),
          lengths_(ray_lengths(stage.eye, seen_))
    {
        opaque_.world = opaque_part(stage.world);
        behind_ = std::make_unique<scattering_view>(opaque_, how);
        radiances_ = shade_each(stage.world, stage.light, seen_,
                                traced_transmittance(tracer(opaque_.world), stage.light, seen_));
        for (std::size_t pixel = 0; pixel < behind_->where.size(); ++pixel)
            for (std::size_t i = seen_.first[pixel]; i < seen_.first[pixel + 1]; ++i) {
                const view_segment& whole = behind_->where[pixel];
                const float share = lengths_.layers[i] / lengths_.opaque.pixels[pixel];
                layers.push_back({share * whole.end, share * whole.footprint, whole.pixel});
            }
    }

    const scattering_view& behind() const { return *behind_; }

    picture shown(std::span<const float> opaque, const std::vector<float>& before_layers) const
    {
        per_surface<float> visibility{image<float>(seen_.opaque.width, seen_.opaque.height), before_layers};
        std::ranges::copy(opaque, visibility.opaque.pixels.begin());
        return blended(seen_, with_scattering(seen_, radiances_, lengths_, visibility, stage_));
    }

    std::vector<view_segment> layers; // of all pixels, each from back to front

  private:
    const scattering_stage& stage_;
    scattering_stage opaque_;
    surface_layers seen_;
    per_surface<float> lengths_;
    per_surface<glm::vec3> radiances_;
    std::unique_ptr<scattering_view> behind_;
};

} // namespace

std::size_t steps_of_fog() { return foggy.size() * falloffs.size(); }
std::size_t steps_of_layers() { return 1 + of_veils.size(); }

page_part compare_fog(const settings& given, const std::filesystem::path& folder, steps& all)
{
    settings how = given;
    how.width /= 2, how.height /= 2, how.map_resolution /= 2;
    page_part result;
    table_block table{
        .title = "Height fog",
        .text =
            "Root mean square errors of visibility against ray tracing, in thousandths, in air whose density falls by "
            "e<sup>-falloff</sup> for each meter of height. Pictures and maps have half the resolution of the others. "
            "Maps have the same texels as in even air, and rows have "
            "the "
            "weights of their middle rays in the fog, or those of even air. A ray at another angle to the light "
            "crosses "
            "a light ray at another height: the higher the light, the less weights for a whole row can do. Of the "
            "exact count nothing is lost but that.",
        .columns = {{.key = "scene", .label = "scene"},
                    {.key = "falloff", .label = "falloff", .digits = 1},
                    {.key = "method", .label = "method"},
                    {.key = "followed", .label = "weights of the fog", .digits = 1, .scale = 1e3, .best = best::low},
                    {.key = "even", .label = "weights of even air", .digits = 1, .scale = 1e3, .best = best::low}},
        .rows = {}};
    pictures_block pictures{.title = {}, .text = {}, .columns = 2, .pictures = {}};
    for (const foggy_stage& one : foggy)
        for (const double falloff : falloffs) {
            all.begin(fmt::format("{}: {}, falloff {:g}", fog->label, one.id, falloff));
            scattering_stage stage = one.make(double(how.width) / how.height);
            stage.air.falloff = float(falloff);
            const scattering_view view(stage, how);
            const std::vector<float> traced = view.traced(view.where);
            const scattering_scene in_the_fog = view.scene();
            scattering_scene even = in_the_fog;
            even.falloff = 0;
            const auto add = [&](const std::string& label, const std::string& colour, double followed, double of_even) {
                table.rows.push_back({{{"scene", one.id},
                                       {"falloff", falloff},
                                       {"method", label},
                                       {"followed", followed},
                                       {"even", of_even}},
                                      colour});
            };
            const scattering_method& m = method_of(best_of_both);
            const measured_map follows(m, in_the_fog), other(m, even);
            const auto error = [&](const measured_map& by, double of_rows) {
                const std::vector<float> visibility = by.visibilities(view.where);
                report_row row = by.row(*fog, view.where, visibility, traced);
                row.part = one.id;
                row.parameters["falloff"] = falloff;
                row.parameters["falloff_of_rows"] = of_rows;
                result.rows.push_back(row);
                return row.errors.rmse;
            };
            const auto exact_error = [&](const measured_map& by) { return compare(by.exact(view.where), traced).rmse; };
            add(m.label, m.its_family().colour, error(follows, falloff), error(other, 0));
            add("exact count", {}, exact_error(follows), exact_error(other));
            if (falloff == shown_falloff && one.id == std::string_view(shown_scene)) {
                pictures.text = fmt::format("With a falloff of {:g}.", falloff);
                pictures.pictures = {saved(view.shown(follows.visibilities(view.where)), *fog, m.id, m.label, folder),
                                     saved(view.shown(traced), *fog, "traced", scattering_references[1].label, folder)};
            }
        }
    result.blocks = {std::move(table), std::move(pictures)};
    return result;
}

page_part compare_layers(const settings& how, const std::filesystem::path& folder, steps& all)
{
    page_part result;
    const scattering_stage stage = veils_stage(double(how.width) / how.height);
    all.begin(fmt::format("{}: {}", veils->label, scattering_references[1].label));
    const layered_view view(stage, how);
    const scattering_view& behind = view.behind();
    const std::vector<float> traced = behind.traced(behind.where), traced_layers = behind.traced(view.layers);
    table_block table{
        .title = "Forward shading",
        .text =
            "Four translucent veils hang in the hall. Each surface of a pixel is shaded with the air before "
            "it, by a look-up at its own place, and blended over what is behind. Root mean square errors of "
            "visibility against ray tracing, in thousandths: at the opaque surface of each pixel, and at all "
            "translucent ones.",
        .columns = {{.key = "method", .label = "method"},
                    {.key = "opaque", .label = "opaque", .digits = 1, .scale = 1e3, .best = best::low},
                    {.key = "layers", .label = "translucent", .digits = 1, .scale = 1e3, .best = best::low}},
        .rows = {}};
    pictures_block pictures{.title = {}, .text = {}, .columns = 2, .pictures = {}};
    for (const char* id : of_veils) {
        const scattering_method& m = method_of(id);
        all.begin(fmt::format("{}: {}", veils->label, m.label));
        const measured_map map(m, behind.scene());
        const std::vector<float> opaque = map.visibilities(behind.where), layers = map.visibilities(view.layers);
        const auto add = [&](const char* part, std::span<const view_segment> where, std::span<const float> visibility,
                             std::span<const float> expected) {
            report_row row = map.row(*veils, where, visibility, expected);
            row.part = part;
            result.rows.push_back(row);
            return row.errors.rmse;
        };
        table.rows.push_back({{{"method", m.label},
                               {"opaque", add("opaque", behind.where, opaque, traced)},
                               {"layers", add("layers", view.layers, layers, traced_layers)}},
                              m.its_family().colour});
        if (id == std::string_view(best_of_both))
            pictures.pictures = {
                saved(view.shown(opaque, layers), *veils, id, m.label, folder),
                saved(view.shown(traced, traced_layers), *veils, "traced", scattering_references[1].label, folder)};
    }
    result.blocks = {std::move(table), std::move(pictures)};
    return result;
}

} // namespace gnomon::evaluation
