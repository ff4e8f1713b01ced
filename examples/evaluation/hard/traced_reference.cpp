// Ray tracing: filter width, depth bias and resolution of the map are errors too.
#include "renderer/trace/tracer.hpp"
#include "shaded_stage.hpp"

namespace gnomon::evaluation {

namespace {

class traced_reference final : public hard_reference {
  public:
    traced_reference() : hard_reference("traced", "ray tracing", 20, false) {}

    std::vector<float> visibility(const shaded_stage& stage, std::span<const map_receiver>) const override
    {
        const renderer::tracer rays(stage.scenery.world);
        const renderer::image<float> traced = renderer::traced_visibility(rays, stage.scenery.light, stage.seen);
        std::vector<float> result;
        for (const std::size_t pixel : stage.where.pixels) result.push_back(traced.pixels[pixel]);
        return result;
    }
};

const registered<traced_reference> entry;

} // namespace

} // namespace gnomon::evaluation
