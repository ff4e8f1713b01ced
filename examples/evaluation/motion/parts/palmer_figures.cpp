// Figures 4.3 to 4.5 of Palmer 2011: a plane that turns little, by 256 samples in time; and chess, with
// percentage-closer filtering of 3 x 3 bilinear look-ups, with one, and with the nearest texel alone.
#include "evaluation/core/timing.hpp"
#include "evaluation/motion/motion_method.hpp"
#include "evaluation/motion/motion_part.hpp"
#include "evaluation/motion/motion_view.hpp"
#include "evaluation/motion/receivers/analytic.hpp"
#include "evaluation/motion/receivers/while_facing.hpp"
#include "evaluation/motion/scene_blocks.hpp"
#include "renderer/scene/layered_stages.hpp"
#include "renderer/scene/moving_stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

constexpr int path_times = 256;

// In closed form by the nearest texels that the path passes, without filtering.
float nearest_visibility(const range_map<float>& map, const light_receiver& r)
{
    return while_facing(r, [&](const receiver_path<float>& path) {
        moving_receiver<float> state = moving_receiver_begin(path, path.depth.t0, path.depth.t1);
        auto sweep = texel_sweep_over(path, 0.f, 0.f, float(map.width), float(map.height));
        while (sweep.t_begin < sweep.t_last) {
            state = moving_receiver_texel(state, sweep);
            if (0 <= sweep.column && sweep.column < float(map.width) && 0 <= sweep.row && sweep.row < float(map.height))
                for (const auto& range : map(std::size_t(sweep.column), std::size_t(sweep.row)))
                    state = add_range(state, range, box_shutter{});
            if (!(sweep.t_end < sweep.t_last)) break;
            sweep = texel_sweep_next(sweep);
        }
        return 1 - moving_receiver_end(state);
    });
}

// At 256 times of the path, each in the middle of its part.
float many_samples(const range_map<float>& map, const light_receiver& r)
{
    return while_facing(r, [&](const receiver_path<float>& path) {
        sampled_receiver<float> state = sampled_receiver_begin(float(path_times));
        for (int k = 0; k < path_times; ++k) {
            const float t = receiver_sample_time(path, float(k), float(path_times), 0.5f);
            state = sampled_receiver_add(state, intensity_at(map, path, t, 0.f));
        }
        return 1 - sampled_receiver_end(state);
    });
}

class palmer_figures {
  public:
    palmer_figures(const motion_sizes& size, std::filesystem::path folder) : size_(size), folder_(std::move(folder))
    {
        size_.reference_samples /= 8;
    }

    part_results results()
    {
        const double aspect = double(size_.width) / size_.height;
        begin("cube_near_turning_plane", cube_over_plane(aspect, 5, 1, -1));
        add("analytic", {}, "analytic", light_visibility, 1.5);
        add("sampled", {{"times", path_times}}, fmt::format("{} samples", path_times), many_samples, 1.5);
        begin("chess", chess(aspect));
        // The depth bias covers the texels that a filter reads.
        add("analytic", {{"look_ups", 0}}, "the nearest texels", nearest_visibility, 0.5);
        add("analytic", {{"look_ups", 1}}, "a bilinear look-up", light_visibility, 1.5);
        add("analytic", {{"look_ups", 3}}, "3 x 3 bilinear look-ups", wide_visibility, 2.5);
        return {.rows = rows_, .blocks = {pictures_, table_}};
    }

  private:
    void begin(const char* scene, moving_stage stage)
    {
        scene_ = &registry_of<scene_entry>().at(scene);
        view_.reset();
        stage_ = std::make_unique<moving_stage>(std::move(stage));
        view_ = std::make_unique<motion_view>(*stage_, size_, false);
        show("reference", "ray tracing at many times", view_->reference.colour);
    }

    void add(const char* receiver, const parameters& how, const std::string& words,
             float (*visibility_of)(const range_map<float>&, const light_receiver&), double bias_radius)
    {
        const auto& method = registry_of<evaluation::method>().at("resolved_ranges");
        const auto map = view_->maps.map(method.id);
        const auto receivers = light_receivers_of(view_->paths, stage_->light, size_.map_resolution, bias_radius);
        std::vector<float> visibility(receivers.size());
        const double spent = least_seconds([&] {
            std::ranges::transform(receivers, visibility.begin(),
                                   [&](const light_receiver& r) { return visibility_of(map->map(), r); });
        });
        report_row row = row_of(method, *map);
        row.scene = scene_->id;
        row.part = "palmer_figures";
        row.receiver = receiver;
        row.parameters.insert(how.begin(), how.end());
        row.label += ", " + words;
        row.reference = "traced";
        row.receivers = static_cast<long long>(view_->pixels.size());
        row.errors = view_->errors_of(mean_visibility(view_->paths, visibility));
        row.ns_per_receiver = view_->per_receiver(spent);
        show(fmt::format("{}-{}", receiver, pictures_.pictures.size()), words,
             shade(stage_->world, stage_->light, view_->paths, visibility));
        table_.rows.push_back({.cells = {{"scene", scene_->label},
                                         {"method", row.label},
                                         {"rmse", row.errors.rmse},
                                         {"leak", row.errors.leak},
                                         {"acne", row.errors.acne},
                                         {"ns", row.ns_per_receiver},
                                         {"build", row.build_ms}}});
        rows_.push_back(std::move(row));
    }

    void show(const std::string& name, const std::string& words, const picture& shown)
    {
        const std::string file = fmt::format("palmer-{}-{}.png", scene_->id, name);
        write_png(folder_ / file, shown);
        pictures_.pictures.push_back({file, fmt::format("{} by {}", scene_->label, words), words});
    }

    motion_sizes size_;
    std::filesystem::path folder_;
    const scene_entry* scene_ = nullptr;
    std::unique_ptr<moving_stage> stage_;
    std::unique_ptr<motion_view> view_;
    std::vector<report_row> rows_;
    pictures_block pictures_{
        .title = "Figures 4.3 to 4.5 of Palmér",
        .text = fmt::format("A plane that turns by 10 degrees below a cube, and chess, five of whose pieces move while "
                            "one turns. The thesis compares with {} samples of each receiver.",
                            path_times),
        .columns = 4,
        .pictures = {}};
    table_block table_{.text = "Errors are in thousandths of visibility.",
                       .columns = {{.key = "scene", .label = "scene"},
                                   {.key = "method", .label = "method"},
                                   error_column("rmse", "RMSE"),
                                   error_column("leak", "leak"),
                                   error_column("acne", "acne"),
                                   number_column("ns", "ns per receiver"),
                                   number_column("build", "map, ms", 0)},
                       .rows = {}};
};

part_run begin_figures(const motion_settings& how)
{
    const auto found = std::make_shared<part_results>();
    return {.tasks = {[=] { *found = palmer_figures(how.size, how.folder).results(); }},
            .results = [=] { return std::move(*found); }};
}

const registered<motion_part> entry{
    motion_part{.id = "palmer_figures", .label = "Figures 4.3 to 4.5 of Palmér", .order = 66, .begin = begin_figures}};

} // namespace

} // namespace gnomon::evaluation
