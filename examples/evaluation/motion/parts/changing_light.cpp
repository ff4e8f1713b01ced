// Shading that changes while the shadow does (Palmer 2011, 2.3): a plane turns away from the light in three exposures.
// The light of a segment of time is its mean visibility times the mean of the light at its ends, or the mean of the
// product in closed form.
#include "evaluation/core/timing.hpp"
#include "evaluation/motion/motion_method.hpp"
#include "evaluation/motion/motion_part.hpp"
#include "evaluation/motion/motion_view.hpp"
#include "evaluation/motion/receivers/range_receiver.hpp"
#include "evaluation/motion/scene_blocks.hpp"
#include "renderer/scene/moving_stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

const registered<scene_entry> plane_entry{scene_facts{
    .id = "turning_plane",
    .label = "a plane that turns away from the light",
    .order = 270,
    .text = "A plane turns by 30 degrees in each of three exposures, in the last of them away from the light."}};

struct frame {
    float open, close; // degrees
};
constexpr frame frames[] = {{40, 70}, {70, 100}, {100, 130}};

class changing_light {
  public:
    changing_light(const motion_sizes& size, std::filesystem::path folder) : size_(size), folder_(std::move(folder)) {}

    part_results results()
    {
        for (const frame& f : frames) add(f);
        return {.rows = rows_, .blocks = {pictures_, table_}};
    }

  private:
    void add(const frame& f)
    {
        const moving_stage stage = turning_plane(double(size_.width) / size_.height, f.open, f.close);
        motion_sizes size = size_;
        size.reference_samples /= 8;
        motion_view view(stage, size, false);
        show(f, "reference", "ray tracing", view.reference.colour);
        const auto& method = registry_of<evaluation::method>().at("resolved_ranges");
        const auto map = view.maps.map(method.id);
        const auto& receivers = view.receivers().biased;
        for (const char* id : {"analytic", "shaded"}) {
            const range_receiver& receiver = range_receiver_of(id);
            std::vector<float> visibility(receivers.size());
            const double spent = least_seconds([&] { receiver.look_up(*map, receivers, visibility); });
            const picture shaded = shade(stage.world, stage.light, view.paths, visibility);
            std::vector<float> found, expected;
            for (const std::size_t i : view.pixels) {
                found.push_back(shaded.pixels[i].y);
                expected.push_back(view.reference.colour.pixels[i].y);
            }
            report_row row = row_of(method, *map);
            row.scene = plane_entry->id;
            row.part = fmt::format("degrees_{:g}", f.open);
            row.receiver = id;
            row.label += ", " + receiver.label;
            row.reference = "traced";
            row.receivers = static_cast<long long>(found.size());
            row.errors = compare(found, expected);
            row.ns_per_receiver = view.per_receiver(spent);
            show(f, id, receiver.label, shaded);
            table_.rows.push_back({.cells = {{"frame", fmt::format("{:g} to {:g} degrees", f.open, f.close)},
                                             {"method", row.label},
                                             {"rmse", row.errors.rmse},
                                             {"largest", row.errors.max_abs},
                                             {"ns", row.ns_per_receiver}}});
            rows_.push_back(std::move(row));
        }
    }

    void show(const frame& f, const std::string& name, const std::string& words, const picture& shown)
    {
        const std::string file = fmt::format("{}-{:g}-{}.png", plane_entry->id, f.open, name);
        write_png(folder_ / file, shown);
        const std::string angles = fmt::format("{:g} to {:g} degrees", f.open, f.close);
        pictures_.pictures.push_back(
            {file, fmt::format("{}, {}, by {}", plane_entry->label, angles, words), angles + ": " + words});
    }

    motion_sizes size_;
    std::filesystem::path folder_;
    std::vector<report_row> rows_;
    pictures_block pictures_{
        .title = "A plane that turns away",
        .text = plane_entry->text +
                " While it faces away it is dark (Figure 2.4 of Palmér). Where shading changes while the shadow does, "
                "the mean of their product is not the product of their means (2.3): ranges are integrated with light "
                "that is linear in time, in closed form.",
        .columns = 3,
        .pictures = {}};
    table_block table_{.text = "Errors of the green light of a pixel, in thousandths.",
                       .columns = {{.key = "frame", .label = "exposure"},
                                   {.key = "method", .label = "method"},
                                   error_column("rmse", "RMSE"),
                                   error_column("largest", "largest error", 1),
                                   number_column("ns", "ns per receiver")},
                       .rows = {}};
};

part_run begin(const motion_settings& how)
{
    const auto found = std::make_shared<part_results>();
    return {.tasks = {[=] { *found = changing_light(how.size, how.folder).results(); }},
            .results = [=] { return std::move(*found); }};
}

const registered<motion_part> entry{
    motion_part{.id = "changing_light", .label = "light that changes", .order = 65, .begin = begin}};

} // namespace

} // namespace gnomon::evaluation
