// Layers of samples that come from exact ranges at regular instants: what is left of their noise is the camera's, so one
// map stands for all seeds.
#include "filtered_layers.hpp"

#include <gnomon/motion/triangle/triangle_motion.h>
#include <gnomon/passes/range/samples.hpp>

#include <cstdint>

namespace gnomon::evaluation {

namespace {

// Motions of points of triangles on the map, from shutter open to shutter close.
class point_motions {
  public:
    point_motions(const renderer::moving_scene& world, const renderer::moving_camera& light, int resolution)
    {
        const renderer::camera open = light.at(0), close = light.at(1);
        for (std::size_t m = 0; m < world.open.meshes.size(); ++m) {
            const renderer::mesh& part = world.open.meshes[m];
            const auto vertex = [&](std::uint32_t i) -> moving_vertex<double> {
                const glm::dvec4 p = renderer::texel_space(open, glm::dvec2(resolution), part.positions[i]);
                const glm::dvec4 q = renderer::texel_space(close, glm::dvec2(resolution), world.closing[m][i]);
                return {p.x, p.y, p.z, p.w, q.x, q.y, q.z, q.w};
            };
            for (const glm::uvec3& t : part.triangles) triangles_.push_back({vertex(t.x), vertex(t.y), vertex(t.z)});
        }
    }

    triangle_motion<float> operator()(float id, float x, float y, float t) const
    {
        const moving_triangle<double>& of = triangles_[std::size_t(id)];
        const triangle_motion<double> d =
            moving_triangle_motion(of, moving_triangle_edges(of, double(x), double(y)), double(t), 0.0);
        return {float(d.d_x), float(d.d_y), float(d.d_z)};
    }

  private:
    std::vector<moving_triangle<double>> triangles_;
};

using model = layer_variance_float;

class layered_ranges final : public layered_method {
  public:
    layered_ranges()
        : layered_method(
              facts_of_layers<model>(
                  {.id = "layered_ranges", .family = "layers", .label = "layers of exact ranges", .order = 40}),
              {{.parameters = {{"samples", 4}, {"centres", 1}}, .comparisons = {of_settings}}}, false)
    {}

    std::unique_ptr<layered_map> build(layered_input& from, const evaluation::parameters& how) const override
    {
        const int side = from.resolution, each = int(how.at("samples"));
        const auto ranges = from.ranges().map("resolved_ranges");
        timed_samples samples{{side, side, each, {}}, ranges->build_ms};
        samples.of.of.resize(std::size_t(side) * std::size_t(side) * std::size_t(each));
        samples.sampling_ms += 1e3 * seconds_on_one_core([&] {
                                   const point_motions motions(from.stage.world, from.stage.light, side);
                                   sample_ranges(ranges->map(), std::size_t(each), motions, std::span(samples.of.of),
                                                 {0, std::size_t(side)});
                               });
        return std::make_unique<filtered_layers_map<model>>(samples, how);
    }
};

const registered<layered_ranges> entry;

} // namespace

} // namespace gnomon::evaluation
