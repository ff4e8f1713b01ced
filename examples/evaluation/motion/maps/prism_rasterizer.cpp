#include "prism_rasterizer.hpp"

#include <glm/vec2.hpp>

#include <cmath>
#include <limits>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

constexpr float margin = 0.05f; // in texels: more than rounding takes from a triangle's extent

prism_triangle<prism_pack> broadcast(const prism_triangle<float>& v)
{
    const auto vertex = [](const prism_vertex<float>& p) {
        return prism_vertex<prism_pack>{prism_pack(p.x), prism_pack(p.y), prism_pack(p.z), prism_pack(p.t),
                                        prism_pack(p.inverse_w)};
    };
    return {vertex(v.a), vertex(v.b), vertex(v.c)};
}

} // namespace

prism_rasterizer::prism_rasterizer(const moving_scene& world, const moving_camera& light, int resolution)
    : resolution_(resolution)
{
    const camera open = light.open, close = light.at(1);
    const glm::dvec2 size(resolution);
    std::uint32_t number = 0;
    for (std::size_t m = 0; m < world.open.meshes.size(); ++m) {
        const mesh& part = world.open.meshes[m];
        for (const glm::uvec3& t : part.triangles) {
            const auto vertex = [&](std::uint32_t i) {
                const glm::vec4 q(texel_space(open, size, part.positions[i]));
                const glm::vec4 r(texel_space(close, size, world.closing[m][i]));
                return moving_vertex<float>{q.x, q.y, q.z, q.w, r.x, r.y, r.z, r.w};
            };
            const moving_triangle<float> corners{vertex(t.x), vertex(t.y), vertex(t.z)};
            const std::uint32_t mine = number++;
            bool in_front = true;
            for (const moving_vertex<float>& v : {corners.a, corners.b, corners.c}) in_front &= v.w0 > 0 && v.w1 > 0;
            if (in_front) setups_.push_back({prism_make(corners, 0.f), mine});
        }
    }
}

prism_rasterizer::drawn_prism prism_rasterizer::drawn(const setup& s) const
{
    drawn_prism result{};
    float low = float(resolution_), high = -1;
    for (std::size_t k = 0; k < triangles; ++k) {
        const prism_triangle<float> v = prism_triangle_make(s.shape, float(k));
        result.scalars[k] = v, result.packs[k] = broadcast(v);
        low = std::min({low, v.a.y, v.b.y, v.c.y}), high = std::max({high, v.a.y, v.b.y, v.c.y});
    }
    const auto last = float(resolution_ - 1);
    result.first_row = int(std::ceil(std::clamp(low - 0.5f - margin, 0.f, last + 1)));
    result.last_row = int(std::floor(std::clamp(high - 0.5f + margin, -1.f, last)));
    return result;
}

// The extent along x of its edges within the margin of the row.
prism_rasterizer::interval prism_rasterizer::row_of(const prism_triangle<float>& v, float y)
{
    interval result{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    const auto add = [&](const prism_vertex<float>& p, const prism_vertex<float>& q) {
        if (std::max(p.y, q.y) < y - margin || std::min(p.y, q.y) > y + margin) return;
        const float rise = q.y - p.y;
        for (const float level : {y - margin, y + margin}) {
            const float passed = rise == 0 ? (level < y ? 0.f : 1.f) : std::clamp((level - p.y) / rise, 0.f, 1.f);
            const float x = p.x + (q.x - p.x) * passed;
            result = {std::min(result.low, x - margin), std::max(result.high, x + margin)};
        }
    };
    add(v.a, v.b), add(v.b, v.c), add(v.c, v.a);
    return result;
}

} // namespace gnomon::evaluation
