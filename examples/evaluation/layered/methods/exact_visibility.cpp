// The visibility of the light at the time of each sample, by ray tracing: what is left of its error is the camera's noise.
#include "evaluation/core/timing.hpp"
#include "evaluation/layered/layered_method.hpp"
#include "renderer/trace/tracer.hpp"

namespace gnomon::evaluation {

namespace {

const registered<family> exact_family{
    family{.id = "exact_visibility", .label = "exact visibility", .order = 200, .colour = "#7f7f7f"}};

class traced_light final : public layered_map {
  public:
    explicit traced_light(const renderer::moving_stage& stage) : light_(stage.light)
    {
        for (const renderer::mesh& part : stage.world.open.meshes)
            bytes_ +=
                2 * part.positions.size() * sizeof part.positions[0] + part.triangles.size() * sizeof part.triangles[0];
        conversion_ms = 1e3 * seconds_on_one_core([&] { rays_.emplace(stage.world); });
    }

    std::size_t bytes() const override { return bytes_; }

    void visibilities(std::span<const stochastic_receiver> where, std::span<float> result) const override
    {
        std::vector<renderer::receiver> from;
        std::vector<float> times;
        for (const stochastic_receiver& r : where) from.push_back(r.in_world), times.push_back(r.t);
        rays_->visibility(light_, from, times, result);
    }

    shutter_exposure<float> averaged(const stochastic_receiver& r) const override { return {r.t, r.t}; }

  private:
    renderer::moving_camera light_;
    std::size_t bytes_ = 0; // of the triangles, without the tracer's tree
    std::optional<renderer::tracer> rays_;
};

class exact_visibility final : public layered_method {
  public:
    exact_visibility()
        : layered_method({.id = exact_method,
                          .family = "exact_visibility",
                          .label = "exact at the camera's times",
                          .format = {"triangles", "triangles"}},
                         {{.comparisons = {equal_input}}}, false)
    {}

    std::unique_ptr<layered_map> build(layered_input& from, const evaluation::parameters&) const override
    {
        return std::make_unique<traced_light>(from.stage);
    }
};

const registered<exact_visibility> entry;

} // namespace

} // namespace gnomon::evaluation
