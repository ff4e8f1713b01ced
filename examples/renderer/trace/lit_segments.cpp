#include "lit_segments.hpp"

#include "embree.hpp"
#include "renderer/shade/scattering.hpp"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

namespace gnomon::renderer {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Light axes: x and y across the light, z along its propagation; the origin is the centre of the casters.
struct axes {
    glm::dvec3 right, up, forward, origin;

    glm::dvec3 direction(const glm::dvec3& v) const
    {
        return {glm::dot(v, right), glm::dot(v, up), glm::dot(v, forward)};
    }
    glm::dvec3 position(const glm::dvec3& p) const { return direction(p - origin); }
};

// The points at which four linear functions are not negative: inside each edge of a triangle, and behind its plane, whose
// function is the last and depends on z, too.
struct prism {
    std::array<double, 4> x{}, y{}, constant{};
    double z = 0;

    // The part of a ray that lies inside. It is empty if from >= to.
    lit_segment part(const view_ray& ray, lit_segment within) const
    {
        bool outside = false;
        for (std::size_t i = 0; i < 4; ++i) {
            double slope = x[i] * ray.direction.x + y[i] * ray.direction.y;
            double value = x[i] * ray.origin.x + y[i] * ray.origin.y + constant[i];
            if (i == 3) slope += z * ray.direction.z, value += z * ray.origin.z;
            const double zero = -value / slope;
            within.from = slope > 0 ? std::max(within.from, zero) : within.from;
            within.to = slope < 0 ? std::min(within.to, zero) : within.to;
            // A ray in the plane is not shadowed, one along an edge is: two triangles may meet there.
            outside |= slope == 0 && (i == 3 ? value <= 0 : value < 0);
        }
        return outside ? lit_segment{0, 0} : within;
    }
};

using triangle_corners = std::array<glm::dvec3, 3>;

glm::dvec3 lower_corner(const triangle_corners& at) { return glm::min(glm::min(at[0], at[1]), at[2]); }
glm::dvec3 upper_corner(const triangle_corners& at) { return glm::max(glm::max(at[0], at[1]), at[2]); }

bool precedes(const glm::dvec3& a, const glm::dvec3& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

// The prism behind a triangle in light axes; z is 0 if the triangle is seen edge-on.
prism behind(triangle_corners corner)
{
    prism result;
    const auto normal = [&] { return glm::cross(corner[1] - corner[0], corner[2] - corner[0]); };
    if (normal().z < 0) std::swap(corner[1], corner[2]);
    for (std::size_t i = 0; i < 3; ++i) {
        // Two triangles at an edge have the same function but for its sign: no gap is between them.
        glm::dvec3 a = corner[i], b = corner[(i + 1) % 3];
        const double sign = precedes(b, a) ? -1 : 1;
        if (sign < 0) std::swap(a, b);
        result.x[i] = sign * (a.y - b.y), result.y[i] = sign * (b.x - a.x);
        result.constant[i] = sign * (a.x * b.y - b.x * a.y);
    }
    const glm::dvec3 n = normal();
    result.x[3] = n.x, result.y[3] = n.y, result.z = n.z, result.constant[3] = -glm::dot(n, corner[0]);
    return result;
}

// A ray in light axes, whose point at distance `start` is the origin of Embree's ray. `left` is a part outside of which all
// is known to be shadowed.
struct shadowed_ray {
    view_ray ray;
    double start;
    lit_segment left;
    std::vector<lit_segment> shadows{};
};

} // namespace

struct shadow_volumes::state {
    axes light;
    std::vector<triangle_corners> triangles;
    std::vector<prism> prisms; // one for each triangle
    glm::dvec3 lower{infinity}, upper{-infinity};
    double size = 0;
    owned<RTCDevice> device{rtcNewDevice(nullptr)};
    owned<RTCScene> scene;

    // More than the rounding of float coordinates within the bounds, and of Embree's test of boxes.
    double margin() const { return 1e-6 * size; }

    // A length that no rounding makes too short, and that is finite in float.
    float embree_length(double length) const
    {
        return static_cast<float>(std::min(length * (1 + 1e-6) + margin(), 1e30));
    }

    // The part of a ray that triangles may shadow.
    lit_segment within_bounds(const view_ray& ray, lit_segment part) const
    {
        if (prisms.empty()) return {0, 0};
        for (int i = 0; i < 3; ++i) {
            const double low = lower[i] - margin() - ray.origin[i];
            const double high = i < 2 ? upper[i] + margin() - ray.origin[i] : infinity;
            const double d = ray.direction[i];
            if (d == 0) {
                if (low > 0 || high < 0) return {0, 0};
                continue;
            }
            part.from = std::max(part.from, std::min(low / d, high / d));
            part.to = std::min(part.to, std::max(low / d, high / d));
        }
        return part;
    }

    static void bound(const RTCBoundsFunctionArguments* args)
    {
        const auto& self = *static_cast<const state*>(args->geometryUserPtr);
        const triangle_corners& at = self.triangles[args->primID];
        const glm::vec3 from(lower_corner(at) - self.margin()), to(upper_corner(at) + self.margin());
        // Prisms have no end.
        *args->bounds_o = {from.x, from.y, from.z, 0, to.x, to.y, 1e15f, 0};
    }

    // Notes the shadow of a triangle. A shadow at an end of what is left shortens it, at the far end Embree's ray, too.
    static void shadow(const RTCIntersectFunctionNArguments* args)
    {
        if (args->valid[0] != -1) return;
        const auto& self = *static_cast<const state*>(args->geometryUserPtr);
        auto& query = *static_cast<shadowed_ray*>(user_data(args));
        lit_segment& left = query.left;
        const lit_segment part = self.prisms[args->primID].part(query.ray, left);
        if (!(part.from < part.to)) return;
        if (part.from > left.from && part.to < left.to) {
            query.shadows.push_back(part);
            return;
        }
        if (part.from == left.from) left.from = part.to;
        else left.to = part.from;
        auto& ray = reinterpret_cast<RTCRayHit*>(args->rayhit)->ray;
        ray.tfar = left.from < left.to ? std::min(ray.tfar, self.embree_length(left.to - query.start)) : -1;
    }
};

shadow_volumes::shadow_volumes(const renderer::scene& casters, const camera& light) : state_(std::make_unique<state>())
{
    if (light.perspective()) throw std::invalid_argument("shadow volumes: the light is not directional");
    if (!state_->device) throw std::runtime_error("shadow volumes: Embree has no device");
    const bounds box = bounds_of(casters);
    state_->light = {light.right, light.up, light.forward, box.empty() ? glm::dvec3(0) : glm::dvec3(box.centre())};
    if (!box.empty()) state_->size = glm::length(glm::dvec3(box.extent()));
    for (const mesh& part : casters.meshes)
        for (const glm::uvec3& triangle : part.triangles) {
            triangle_corners at;
            for (int i = 0; i < 3; ++i)
                at[static_cast<std::size_t>(i)] = state_->light.position(part.positions[triangle[i]]);
            const prism volume = behind(at);
            if (!(volume.z > 0)) continue; // edge-on: there is nothing behind the triangle
            state_->lower = glm::min(state_->lower, lower_corner(at));
            state_->upper = glm::max(state_->upper, upper_corner(at));
            state_->triangles.push_back(at), state_->prisms.push_back(volume);
        }
    state_->scene.reset(rtcNewScene(state_->device.get()));
    RTCGeometry geometry = rtcNewGeometry(state_->device.get(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(state_->prisms.size()));
    rtcSetGeometryUserData(geometry, state_.get());
    rtcSetGeometryBoundsFunction(geometry, state::bound, nullptr);
    rtcSetGeometryIntersectFunction(geometry, state::shadow);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(state_->scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(state_->scene.get());
    if (const RTCError error = rtcGetDeviceError(state_->device.get()); error != RTC_ERROR_NONE)
        throw std::runtime_error(fmt::format("shadow volumes: Embree error {}", static_cast<int>(error)));
}

shadow_volumes::~shadow_volumes() = default;
shadow_volumes::shadow_volumes(shadow_volumes&&) noexcept = default;
shadow_volumes& shadow_volumes::operator=(shadow_volumes&&) noexcept = default;

std::vector<lit_segment> shadow_volumes::lit(const view_ray& ray, double length) const
{
    const view_ray local{state_->light.position(ray.origin), state_->light.direction(ray.direction)};
    const lit_segment near = state_->within_bounds(local, {0, length});
    shadowed_ray query{local, near.from, {0, length}};
    if (near.from < near.to) {
        const glm::vec3 origin(local.origin + near.from * local.direction), direction(local.direction);
        RTCRayHit embree{};
        embree.ray.org_x = origin.x, embree.ray.org_y = origin.y, embree.ray.org_z = origin.z;
        embree.ray.dir_x = direction.x, embree.ray.dir_y = direction.y, embree.ray.dir_z = direction.z;
        embree.ray.tfar = state_->embree_length(near.to - near.from);
        embree.ray.mask = ~0u, embree.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        intersect(state_->scene.get(), embree, &query);
    }
    std::ranges::sort(query.shadows, {}, &lit_segment::from);
    std::vector<lit_segment> result;
    const double shortest = 1e-9 * state_->size;
    double from = query.left.from;
    const auto add = [&](double to) {
        if (to - from > shortest) result.push_back({from, to});
    };
    for (const lit_segment& shadow : query.shadows) {
        if (shadow.from >= query.left.to) break;
        add(shadow.from);
        from = std::max(from, shadow.to);
    }
    add(query.left.to);
    return result;
}

double visible_share(std::span<const lit_segment> lit, const medium& air, const view_ray& ray, double length)
{
    // Finite, so that a product with no thickness is 0.
    const double sigma = std::min(static_cast<double>(air.mean_extinction()), std::numeric_limits<double>::max());
    // The scattering between two distances: the integral of density times transmittance, times sigma if this is not 0.
    const auto scattering = [&](double from, double to) {
        const double thickness = air.thickness({ray.origin + from * ray.direction, ray.direction}, to - from);
        if (sigma == 0) return thickness;
        return std::exp(-sigma * air.thickness(ray, from)) * -std::expm1(-sigma * thickness);
    };
    const double all = scattering(0, length);
    if (!(all > 0)) return 1;
    if (all == infinity) return !lit.empty() && lit.back().to == length ? 1 : 0; // the far end outweighs the rest
    double sum = 0;
    for (const lit_segment& part : lit) sum += scattering(part.from, part.to);
    return std::clamp(sum / all, 0.0, 1.0);
}

void traced_scattering(const shadow_volumes& shadows, const medium& air, std::span<const view_ray> rays,
                       std::span<const double> lengths, std::span<float> result)
{
    if (rays.size() != lengths.size() || rays.size() != result.size())
        throw std::invalid_argument(fmt::format("traced scattering: {} rays, {} lengths, room for {} results",
                                                rays.size(), lengths.size(), result.size()));
    tbb::parallel_for(std::size_t(0), rays.size(), [&](std::size_t i) {
        result[i] = static_cast<float>(visible_share(shadows.lit(rays[i], lengths[i]), air, rays[i], lengths[i]));
    });
}

image<float> traced_scattering(const shadow_volumes& shadows, const medium& air, const camera& eye,
                               const image<float>& lengths)
{
    std::vector<view_ray> rays;
    rays.reserve(lengths.pixels.size());
    for (int y = 0; y < lengths.height; ++y)
        for (int x = 0; x < lengths.width; ++x) rays.push_back(unit_ray(eye, x, y, lengths.width, lengths.height));
    const std::vector<double> distances(lengths.pixels.begin(), lengths.pixels.end());
    image<float> result(lengths.width, lengths.height);
    traced_scattering(shadows, air, rays, distances, result.pixels);
    return result;
}

per_surface<float> traced_scattering(const shadow_volumes& shadows, const medium& air, const camera& eye,
                                     const surface_layers& seen, const per_surface<float>& lengths)
{
    const int width = seen.opaque.width, height = seen.opaque.height;
    std::vector<view_ray> rays(seen.layers.size());
    for (std::size_t pixel = 0; pixel + 1 < seen.first.size(); ++pixel) {
        const int index = static_cast<int>(pixel);
        for (std::size_t i = seen.first[pixel]; i < seen.first[pixel + 1]; ++i)
            rays[i] = unit_ray(eye, index % width, index / width, width, height);
    }
    const std::vector<double> distances(lengths.layers.begin(), lengths.layers.end());
    per_surface<float> result{traced_scattering(shadows, air, eye, lengths.opaque), std::vector<float>(rays.size())};
    traced_scattering(shadows, air, rays, distances, result.layers);
    return result;
}

} // namespace gnomon::renderer
