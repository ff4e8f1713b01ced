#include "tracer.hpp"

#include <glm/geometric.hpp>

#include <vector>

namespace gnomon::renderer {

namespace {

// A value for each pixel: that of its surface by trace(receivers, values), 1 for the background.
template <class T, class Trace> image<T> traced(const image<surface>& seen, const Trace& trace)
{
    std::vector<receiver> receivers;
    std::vector<std::size_t> pixels;
    for (std::size_t i = 0; i < seen.pixels.size(); ++i)
        if (const surface& s = seen.pixels[i]; s.valid())
            receivers.push_back({s.position, s.normal}), pixels.push_back(i);
    std::vector<T> values(receivers.size());
    trace(receivers, values);
    image<T> result(seen.width, seen.height, T(1));
    for (std::size_t i = 0; i < pixels.size(); ++i) result.pixels[pixels[i]] = values[i];
    return result;
}

receiver on_lit_side(const camera& light, const surface& s)
{
    const bool lit = glm::dot(direction_towards(light, s.position), glm::dvec3(s.normal)) > 0;
    return {s.position, lit ? s.normal : -s.normal};
}

} // namespace

image<float> traced_visibility(const tracer& rays, const camera& light, const image<surface>& seen)
{
    return traced<float>(seen, [&](const auto& from, auto& values) { rays.visibility(light, from, values); });
}

image<float> traced_visibility(const tracer& rays, const area_light& light, const image<surface>& seen, int samples)
{
    return traced<float>(seen, [&](const auto& from, auto& values) { rays.visibility(light, from, samples, values); });
}

layer_visibility traced_transmittance(const tracer& rays, const camera& light, const surface_layers& seen)
{
    layer_visibility result;
    result.opaque = traced<glm::vec3>(seen.opaque,
                                      [&](const auto& from, auto& values) { rays.transmittance(light, from, values); });
    std::vector<receiver> layers;
    for (const surface& s : seen.layers) layers.push_back(on_lit_side(light, s));
    result.layers.resize(layers.size());
    rays.transmittance(light, layers, result.layers);
    return result;
}

} // namespace gnomon::renderer
