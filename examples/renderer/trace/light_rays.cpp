// Rays from receivers to lights with an area, and through translucent meshes.
#include "tracer_state.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <type_traits>
#include <utility>

namespace gnomon::renderer {

namespace {

// The corners of a triangle between which a crossing lies: two on an edge, one at a corner, else three; in order.
glm::uvec3 corners_around(const glm::uvec3& triangle, const glm::vec3& weights)
{
    constexpr float rounding = 1e-6f;
    glm::uvec3 corner = triangle;
    for (int i = 0; i < 3; ++i)
        if (weights[i] <= rounding) corner[i] = ~0u;
    if (corner.x > corner.y) std::swap(corner.x, corner.y);
    if (corner.y > corner.z) std::swap(corner.y, corner.z);
    if (corner.x > corner.y) std::swap(corner.x, corner.y);
    return corner;
}

// The share of light that passes all crossings of a ray, which are put in order. Embree may report a crossing twice, and
// both triangles at an edge report one each.
glm::dvec3 transmitted(const scene& world, std::vector<crossing>& ray)
{
    const auto triangle = [](const crossing& at) { return std::pair(at.mesh, at.triangle); };
    std::ranges::sort(ray, {}, triangle);
    ray.erase(
        std::unique(ray.begin(), ray.end(), [&](const auto& a, const auto& b) { return triangle(a) == triangle(b); }),
        ray.end());
    struct shared {
        std::uint32_t mesh;
        glm::uvec3 corners;
        bool operator==(const shared& other) const { return mesh == other.mesh && corners == other.corners; }
    };
    glm::dvec3 result(1);
    std::vector<shared> edges;
    for (const crossing& at : ray) {
        const mesh& part = world.meshes[at.mesh];
        const glm::vec3 weights(1 - at.u - at.v, at.u, at.v);
        const shared edge{at.mesh, corners_around(part.triangles[at.triangle], weights)};
        if (edge.corners.z == ~0u) {
            if (std::ranges::find(edges, edge) != edges.end()) continue;
            edges.push_back(edge);
        }
        result *= 1.0 - glm::dvec3(part.opacity_at(at.triangle, weights));
    }
    return result;
}

// The mean over the places of a light: the fraction that is seen, or the transmittance if the results are colours.
template <class State, class Result>
void mean_over_light(const State& state, const area_light& light, std::span<const receiver> receivers, int samples,
                     std::span<Result> result)
{
    check_room(receivers.size(), result.size());
    check_samples(samples);
    constexpr bool through = std::is_same_v<Result, glm::vec3>;
    using sum = std::conditional_t<through, glm::dvec3, double>;
    // Rays of a receiver follow one another. Blocks are of one size, so that threads do not change the packets.
    const auto each = static_cast<std::size_t>(samples), block = std::max<std::size_t>(1, 4096 / each);
    tbb::parallel_for(std::size_t(0), (receivers.size() + block - 1) / block, [&](std::size_t index) {
        alignas(64) RTCRay16 rays{};
        crossings gathered;
        const std::size_t first = index * block, last = std::min(first + block, receivers.size());
        std::vector<sum> sums(last - first, sum(0));
        for (std::size_t ray = first * each; ray < last * each; ray += packet) {
            alignas(64) mask valid{};
            const std::size_t count = std::min<std::size_t>(packet, last * each - ray);
            for (std::size_t i = 0; i < count; ++i) {
                const std::size_t r = (ray + i) / each;
                const glm::dvec2 place = stratified_place(r, static_cast<int>((ray + i) % each), samples) - 0.5;
                if (state.aim(rays, static_cast<int>(i), receivers[r], light, place) > 0) valid[i] = -1;
            }
            state.trace(valid, rays, through ? &gathered : nullptr);
            for (std::size_t i = 0; i < count; ++i) {
                if (valid[i] && !(rays.tfar[i] < 0)) {
                    sum& total = sums[(ray + i) / each - first];
                    if constexpr (through) total += transmitted(state.world.open, gathered[i]);
                    else total += 1;
                }
                gathered[i].clear();
            }
        }
        for (std::size_t r = first; r < last; ++r) result[r] = Result(sums[r - first] / double(samples));
    });
}

} // namespace

void tracer::transmittance(const camera& light, std::span<const receiver> receivers, std::span<glm::vec3> result) const
{
    mean_over_light(*state_, {light, glm::dvec2(0)}, receivers, 1, result);
}

void tracer::transmittance(const moving_camera& light, std::span<const receiver> receivers,
                           std::span<const float> times, std::span<glm::vec3> result) const
{
    check_room(receivers.size(), result.size());
    check_room(receivers.size(), times.size());
    tbb::parallel_for(std::size_t(0), (receivers.size() + 1023) / 1024, [&](std::size_t block) {
        alignas(64) RTCRay16 rays{};
        crossings gathered;
        const std::size_t last = std::min((block + 1) * 1024, receivers.size());
        for (std::size_t first = block * 1024; first < last; first += packet) {
            alignas(64) mask valid{};
            const std::size_t count = std::min<std::size_t>(packet, last - first);
            for (std::size_t i = 0; i < count; ++i)
                if (state_->aim(rays, static_cast<int>(i), receivers[first + i], light, times[first + i]) > 0)
                    valid[i] = -1;
            state_->trace(valid, rays, &gathered);
            for (std::size_t i = 0; i < count; ++i) {
                const bool lit = valid[i] && !(rays.tfar[i] < 0);
                result[first + i] = lit ? glm::vec3(transmitted(state_->world.open, gathered[i])) : glm::vec3(0);
                gathered[i].clear();
            }
        }
    });
}

void tracer::visibility(const area_light& light, std::span<const receiver> receivers, int samples,
                        std::span<float> result) const
{
    mean_over_light(*state_, light, receivers, samples, result);
}

void tracer::transmittance(const area_light& light, std::span<const receiver> receivers, int samples,
                           std::span<glm::vec3> result) const
{
    mean_over_light(*state_, light, receivers, samples, result);
}

} // namespace gnomon::renderer
