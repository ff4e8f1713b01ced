#include "layered_costs.hpp"

#include "evaluation/core/timing.hpp"
#include "evaluation/layered/methods/filtered_layers.hpp"
#include "evaluation/motion/cube_costs.hpp"
#include "evaluation/motion/words.hpp"
#include "layered_view.hpp"
#include "renderer/scene/moving_stages.hpp"

#include <gnomon/passes/look_up.hpp>
#include <gnomon/passes/mips.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <string>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

const layered_method& method_of(const char* id)
{
    return dynamic_cast<const layered_method&>(registry_of<method>().at(id));
}

moving_stage stilled(moving_stage stage)
{
    for (std::size_t m = 0; m < stage.world.open.meshes.size(); ++m)
        stage.world.closing[m] = stage.world.open.meshes[m].positions;
    stage.light.motion = stage.eye.motion = glm::dvec3(0);
    return stage;
}

// The sums of all samples of a texel, with mips: a variance shadow map with opacity.
class plain_map {
    using format = layer_variance_float;
    using texel = format_texel<format>;
    using channels = std::array<float, sizeof(format_channels<format>) / sizeof(float)>;

  public:
    explicit plain_map(const sample_map<float>& samples)
        : size_(samples.width), texels_(mip_texels(samples.width, samples.height))
    {
        for (std::size_t y = 0; y < size_; ++y)
            for (std::size_t x = 0; x < size_; ++x) {
                format_channels<format> sums{};
                for (const stochastic_sample<float>& s : samples(x, y))
                    sums = format::add(sums, s.z, {s.z < 1 ? 1.f : 0.f, 1.f});
                texels_[y * size_ + x] = format::encode(sums);
            }
        build_mips<format>(mip_view<texel>{texels_, size_, size_});
    }

    std::size_t bytes() const { return texels_.size() * sizeof(texel); }

    // By the same probes, trilinear ones, and the same bias.
    void visibilities(std::span<const stochastic_receiver> where, std::span<float> result) const
    {
        const mip_view<const texel> mips{texels_, size_, size_};
        layer_motion<float> still{};
        still.least = -1, still.greatest = 1;
        const layer_grid<float> grid = layer_grid_make(still, float(size_), float(size_));
        for (std::size_t i = 0; i < where.size(); ++i) {
            const layer_receiver<float> r = layer_receiver_of(where[i]);
            const auto footprint =
                layer_footprint_make(grid, r.x0 - grid.middle, r.y0 - grid.middle, r.t0, r.x1 - grid.middle,
                                     r.y1 - grid.middle, r.t1, r.cross_x, r.cross_y, 0.0f);
            std::array<float, std::tuple_size_v<channels>> sums{};
            for (float k = 0; k < footprint.probes; ++k) {
                const layer_place<float> place = layer_probe(footprint, k);
                const auto one = std::bit_cast<channels>(trilinear<format>(mips, place.u, place.v, footprint.level));
                for (std::size_t n = 0; n < sums.size(); ++n) sums[n] += one[n];
            }
            const float bias = layer_bias(grid, r.slope, r.slope, r.t, layer_look_up{}.reach, layer_look_up{}.limit);
            result[i] = format::visibility(std::bit_cast<format_channels<format>>(sums), r.z - bias,
                                           float(format::least_variance));
        }
    }

  private:
    std::size_t size_;
    std::vector<texel> texels_;
};

} // namespace

static_costs static_costs_of(const motion_scene& scene, const layered_sizes& size)
{
    const moving_stage stage = stilled(scene.stage(double(size.width) / size.height, size.full));
    layered_input input(stage, size.map_resolution, 0);
    seen_samples seen(stage, {size.width, size.height, size.camera_samples, 1}, 1);
    const stochastic_receivers& receivers = seen.receivers(size.map_resolution);
    std::vector<float> found(receivers.where.size());
    const plain_map plain(input.samples().of.map());
    const auto layers = method_of(usual_layers).build(input, {{"layers", 1}, {"neighbour", 0}});
    const double plain_time = least_seconds([&] { plain.visibilities(receivers.where, found); });
    const double layers_time = least_seconds([&] { layers->visibilities(receivers.where, found); });
    return {double(layers->bytes()) / double(plain.bytes()), layers_time / plain_time, layers->facts.at("plain_tiles")};
}

moving_costs moving_costs_of(const moving_cubes& cubes, const layered_sizes& size)
{
    const moving_stage stage =
        random_cubes(double(size.width) / size.height, cubes.count, longest_path * float(cubes.speed));
    layered_input input(stage, size.map_resolution, 0);
    seen_samples seen(stage, {size.width, size.height, size.camera_samples, 1}, 1);
    const stochastic_receivers& receivers = seen.receivers(size.map_resolution);
    std::vector<float> found(receivers.where.size());
    moving_costs result{cubes, {}};
    for (const char* id : {"time_slices_sloped", usual_layers, "range_footprints"}) {
        const layered_method& m = method_of(id);
        const auto map = m.build(input, m.variants.front().parameters);
        const double spent = seconds_on_one_core([&] { map->visibilities(receivers.where, found); });
        result.rivals.push_back({&m, map->sampling_ms + map->conversion_ms, 1e3 * spent, double(map->bytes())});
    }
    return result;
}

chart_block chart_of(const std::vector<moving_costs>& found)
{
    struct quantity {
        const char *title, *unit;
        double (*of)(const rival_costs&);
    };
    constexpr std::array quantities{
        quantity{"time of map and look-ups", "ms, one core",
                 [](const rival_costs& r) { return r.build_ms + r.look_up_ms; }},
        quantity{"memory of the map", "MiB", [](const rival_costs& r) { return r.bytes / 1048576; }}};
    chart_block chart{
        .title = "Layers and ranges by what moves",
        .text = {},
        .name = "cubes",
        .alt = "Time and memory of three methods by the number of random cubes and by their speed.",
        .caption = "Random cubes of half-extent 0.125; by their number at speed 1, and by the speed of 400.",
        .panels = {}};
    std::string where;
    for (const bool by_speed : {false, true})
        for (const quantity& q : quantities) {
            std::vector<const moving_costs*> shown;
            for (const moving_costs& c : found)
                if (by_speed ? c.of.count == 400 : c.of.speed == 1) shown.push_back(&c);
            const auto place = [&](const moving_costs* c) { return by_speed ? c->of.speed : double(c->of.count); };
            std::ranges::sort(shown, {}, place);
            panel p{.title = q.title,
                    .x = {.label = by_speed ? "speed" : "cubes", .scale = scale::log},
                    .y = {.label = q.unit, .scale = scale::log},
                    .series = {}};
            for (const moving_costs* c : shown) p.x.ticks.emplace_back(place(c), ratio(place(c)));
            for (std::size_t m = 0; m < shown.front()->rivals.size(); ++m) {
                const layered_method& of = *shown.front()->rivals[m].method;
                series line{.label = of.label,
                            .colour = of.its_family().colour,
                            .style = style::line,
                            .labelled = false,
                            .marker = "circle"};
                for (const moving_costs* c : shown) line.points.push_back({place(c), q.of(c->rivals[m])});
                p.series.push_back(std::move(line));
            }
            for (const moving_costs* c : shown) {
                const double layers = q.of(c->rivals[1]), ranges = q.of(c->rivals[2]);
                if (layers < ranges)
                    where += fmt::format("{}{} of {} cubes at speed {} ({:.1f} against {:.1f} {})",
                                         where.empty() ? "" : "; ", q.title, c->of.count, ratio(c->of.speed), layers,
                                         ranges, q.unit);
            }
            chart.panels.push_back(std::move(p));
        }
    chart.text =
        "Ranges are exact, and grow with the triangles that cross a texel; layers depend on samples alone. "
        "<b>Layers beat ranges</b> in: " +
        (where.empty() ? std::string("nothing of these") : where) + ". Everywhere else ranges are cheaper.";
    return chart;
}

} // namespace gnomon::evaluation
