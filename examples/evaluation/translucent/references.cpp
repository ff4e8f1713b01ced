#include "references.hpp"

#include "renderer/trace/tracer.hpp"

#include <glm/vec3.hpp>
#include <tbb/parallel_for.h>

namespace gnomon::evaluation {

namespace {

known_visibility empty(const char* reference, std::size_t receivers)
{
    known_visibility result{.reference = reference};
    for (numbers& one : result.of) one.resize(receivers);
    return result;
}

} // namespace

known_visibility filtered_visibility(const translucent_view& view, const texel_stacks& stacks,
                                     std::span<const float> taps)
{
    known_visibility result = empty("filtered", view.size());
    tbb::parallel_for(std::size_t(0), view.size(), [&](std::size_t i) {
        const of_colours intensity = stacks.filtered_intensity(view.where[i], taps);
        for (std::size_t c = 0; c < result.of.size(); ++c)
            result.of[c][i] = static_cast<float>(1 - intensity[static_cast<int>(c)]);
    });
    return result;
}

known_visibility traced_visibility(const translucent_view& view)
{
    std::vector<renderer::receiver> receivers;
    for (const seen_receiver& r : view.receivers) {
        const renderer::surface& s = view.surface_of(r);
        receivers.push_back({s.position, s.normal});
    }
    std::vector<glm::vec3> traced(receivers.size());
    renderer::tracer(view.scenery.world).transmittance(view.scenery.light, receivers, traced);
    known_visibility result = empty("traced", view.size());
    for (std::size_t i = 0; i < traced.size(); ++i) {
        const glm::vec3& t = traced[i];
        result.of[0][i] = (t.r + t.g + t.b) / 3;
        for (int c = 0; c < 3; ++c) result.of[static_cast<std::size_t>(c) + 1][i] = t[c];
    }
    return result;
}

} // namespace gnomon::evaluation
