#include "tracer.hpp"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>
#include <utility>

#include "shading.hpp"

namespace gnomon::toolbox {

namespace {

// Float positions within the bounds are exact to 6e-8 of the diagonal, Embree's intersections to a few times that.
constexpr float relative_offset = 2e-6f;

// Rays in one packet; those of one receiver or pixel at many times are as coherent as rays can be.
constexpr int packet = 16;

struct release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

template <class T> using owned = std::unique_ptr<std::remove_pointer_t<T>, release>;

template <class T>
void upload(RTCGeometry geometry, RTCBufferType type, unsigned slot, RTCFormat format, const std::vector<T>& values)
{
    // Embree owns the buffer, and pads it as it needs to.
    void* buffer = rtcSetNewGeometryBuffer(geometry, type, slot, format, sizeof(T), values.size());
    if (!values.empty()) std::memcpy(buffer, values.data(), sizeof(T) * values.size());
}

moving_scene at_rest(const scene& world)
{
    moving_scene result{world, {}};
    for (const mesh& part : world.meshes) result.closing.push_back(part.positions);
    return result;
}

glm::vec3 unit(const glm::vec3& v)
{
    const float length = glm::length(v);
    return length > 0 ? v / length : v;
}

receiver between(const moving_receiver& moving, float t)
{
    return {glm::mix(moving.open.position, moving.closing.position, t),
            unit(glm::mix(moving.open.normal, moving.closing.normal, t))};
}

// A moment in part i of n, chosen by the finalizer of SplitMix64.
float moment(std::size_t owner, int i, int n)
{
    std::uint64_t bits = (static_cast<std::uint64_t>(owner) << 24) + static_cast<std::uint64_t>(i) + 1;
    bits *= 0x9e3779b97f4a7c15u;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    const auto jitter = static_cast<float>((bits ^ (bits >> 31)) >> 40) * 0x1p-24f;
    return (static_cast<float>(i) + jitter) / static_cast<float>(n);
}

using mask = std::array<int, packet>; // -1 for rays that are to be traced

void set_ray(RTCRay16& rays, int lane, const glm::vec3& origin, const glm::vec3& direction, float end, float time)
{
    rays.org_x[lane] = origin.x, rays.org_y[lane] = origin.y, rays.org_z[lane] = origin.z;
    rays.dir_x[lane] = direction.x, rays.dir_y[lane] = direction.y, rays.dir_z[lane] = direction.z;
    rays.tnear[lane] = 0, rays.tfar[lane] = end;
    rays.time[lane] = time, rays.mask[lane] = ~0u, rays.id[lane] = 0, rays.flags[lane] = 0;
}

struct corners {
    std::array<glm::vec3, 3> at;

    glm::vec3 inside(const glm::vec3& weights) const
    {
        return weights.x * at[0] + weights.y * at[1] + weights.z * at[2];
    }
    glm::vec3 normal() const
    {
        return unit(
            glm::vec3(glm::cross(glm::dvec3(at[1]) - glm::dvec3(at[0]), glm::dvec3(at[2]) - glm::dvec3(at[0]))));
    }
};

void check_samples(int samples)
{
    if (samples < 1) throw std::invalid_argument(fmt::format("tracer: {} moments, at least one expected", samples));
}

void check_room(std::size_t receivers, std::size_t results)
{
    if (receivers != results)
        throw std::invalid_argument(fmt::format("tracer: {} receivers, room for {} results", receivers, results));
}

} // namespace

struct tracer::state {
    moving_scene world;
    std::vector<bool> moves;
    owned<RTCDevice> device{rtcNewDevice(nullptr)};
    owned<RTCScene> scene;
    float offset = 0;

    // A spot light's ray is the segment up to the light, a directional one has no end. Returns the cosine between the
    // receiver's normal and the way to the light.
    float aim(RTCRay16& rays, int lane, const receiver& from, const moving_camera& light, float time) const
    {
        const glm::vec3 origin = from.position + offset * from.normal;
        const bool segment = light.open.perspective();
        const glm::dvec3 place = light.open.position + static_cast<double>(time) * light.motion;
        const glm::vec3 direction(segment ? place - glm::dvec3(origin) : -light.open.forward);
        set_ray(rays, lane, origin, direction, segment ? 1 : std::numeric_limits<float>::infinity(), time);
        return glm::dot(from.normal, unit(direction));
    }

    // Ends the rays of a packet that meet something: tfar becomes -infinity.
    void trace(const mask& valid, RTCRay16& rays) const
    {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        rtcOccluded16(valid.data(), scene.get(), &context, &rays);
    }

    void look(const mask& valid, RTCRayHit16& rays) const
    {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        rtcIntersect16(valid.data(), scene.get(), &context, &rays);
    }

    glm::vec3 colour(const hit& seen, float sunlight) const
    {
        if (!seen.valid()) return daylight.background;
        return radiance(world.open.meshes[static_cast<std::size_t>(seen.mesh)].albedo, seen.normal, sunlight);
    }

    corners triangle(std::size_t mesh, std::uint32_t index, float time) const
    {
        const auto& part = world.open.meshes[mesh];
        const glm::uvec3 t = part.triangles[index];
        corners result;
        for (int i = 0; i < 3; ++i) {
            const glm::vec3& open = part.positions[t[i]];
            result.at[static_cast<std::size_t>(i)] =
                moves[mesh] ? glm::mix(open, world.closing[mesh][t[i]], time) : open;
        }
        return result;
    }

    hit meet(unsigned mesh, unsigned triangle_index, float u, float v, const glm::dvec3& direction, float time) const
    {
        hit result;
        if (mesh == RTC_INVALID_GEOMETRY_ID) return result;
        const corners at = triangle(mesh, triangle_index, time);
        result.mesh = static_cast<int>(mesh), result.triangle = triangle_index;
        result.weights = {1 - u - v, u, v};
        result.position = at.inside(result.weights);
        result.normal = at.normal();
        if (glm::dot(glm::dvec3(result.normal), direction) > 0) result.normal = -result.normal;
        return result;
    }
};

tracer::tracer(const toolbox::scene& world) : tracer(at_rest(world)) {}

tracer::tracer(moving_scene world) : state_(std::make_unique<state>())
{
    if (!state_->device) throw std::runtime_error("tracer: Embree has no device");
    state_->world = std::move(world);
    const moving_scene& all = state_->world;
    state_->scene.reset(rtcNewScene(state_->device.get()));
    rtcSetSceneFlags(state_->scene.get(), RTC_SCENE_FLAG_ROBUST);
    for (std::size_t m = 0; m < all.open.meshes.size(); ++m) {
        const mesh& part = all.open.meshes[m];
        state_->moves.push_back(all.moves(m));
        RTCGeometry geometry = rtcNewGeometry(state_->device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetGeometryTimeStepCount(geometry, all.moves(m) ? 2 : 1);
        upload(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, part.positions);
        if (all.moves(m)) upload(geometry, RTC_BUFFER_TYPE_VERTEX, 1, RTC_FORMAT_FLOAT3, all.closing[m]);
        upload(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, part.triangles);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(state_->scene.get(), geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(state_->scene.get());
    if (const bounds box = bounds_of(all); !box.empty()) state_->offset = relative_offset * glm::length(box.extent());
    if (const RTCError error = rtcGetDeviceError(state_->device.get()); error != RTC_ERROR_NONE)
        throw std::runtime_error(fmt::format("tracer: Embree error {}", static_cast<int>(error)));
}

tracer::~tracer() = default;
tracer::tracer(tracer&&) noexcept = default;
tracer& tracer::operator=(tracer&&) noexcept = default;

float tracer::offset() const { return state_->offset; }

void tracer::visibility(const camera& light, std::span<const receiver> receivers, std::span<float> result) const
{
    const std::vector<float> times(receivers.size(), 0);
    visibility({light, glm::dvec3(0)}, receivers, times, result);
}

void tracer::visibility(const moving_camera& light, std::span<const receiver> receivers, std::span<const float> times,
                        std::span<float> result) const
{
    check_room(receivers.size(), result.size());
    if (receivers.size() != times.size())
        throw std::invalid_argument(fmt::format("tracer: {} receivers, times for {}", receivers.size(), times.size()));
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, receivers.size(), 1024), [&](const auto& range) {
        alignas(64) RTCRay16 rays{};
        for (std::size_t first = range.begin(); first < range.end(); first += packet) {
            alignas(64) mask valid{};
            const int count = static_cast<int>(std::min<std::size_t>(packet, range.end() - first));
            for (int i = 0; i < count; ++i) {
                const std::size_t r = first + static_cast<std::size_t>(i);
                state_->aim(rays, i, receivers[r], light, times[r]);
                valid[static_cast<std::size_t>(i)] = -1;
            }
            state_->trace(valid, rays);
            for (int i = 0; i < count; ++i) result[first + static_cast<std::size_t>(i)] = rays.tfar[i] < 0 ? 0.f : 1.f;
        }
    });
}

void tracer::mean_visibility(const moving_camera& light, std::span<const moving_receiver> receivers, int samples,
                             std::span<float> result) const
{
    check_room(receivers.size(), result.size());
    check_samples(samples);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, receivers.size(), 64), [&](const auto& range) {
        alignas(64) RTCRay16 rays{};
        for (std::size_t r = range.begin(); r < range.end(); ++r) {
            int lit = 0;
            for (int first = 0; first < samples; first += packet) {
                alignas(64) mask valid{};
                for (int i = 0; i < std::min(packet, samples - first); ++i) {
                    const float time = moment(r, first + i, samples);
                    if (state_->aim(rays, i, between(receivers[r], time), light, time) > 0)
                        valid[static_cast<std::size_t>(i)] = -1;
                }
                state_->trace(valid, rays);
                for (int i = 0; i < packet; ++i) lit += valid[static_cast<std::size_t>(i)] && !(rays.tfar[i] < 0);
            }
            result[r] = static_cast<float>(lit) / static_cast<float>(samples);
        }
    });
}

hit tracer::first_hit(const view_ray& ray, float time) const
{
    RTCRayHit query{};
    const glm::vec3 origin(ray.origin), direction(ray.direction);
    query.ray.org_x = origin.x, query.ray.org_y = origin.y, query.ray.org_z = origin.z;
    query.ray.dir_x = direction.x, query.ray.dir_y = direction.y, query.ray.dir_z = direction.z;
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.time = time, query.ray.mask = ~0u;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(state_->scene.get(), &context, &query);
    return state_->meet(query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v, ray.direction, time);
}

moving_receiver tracer::receiver_of(const hit& seen, float time_of_hit) const
{
    const auto mesh = static_cast<std::size_t>(seen.mesh);
    const glm::vec3 then = state_->triangle(mesh, seen.triangle, time_of_hit).normal();
    const float side = glm::dot(then, seen.normal) < 0 ? -1.f : 1.f;
    const auto at = [&](float time) {
        const corners triangle = state_->triangle(mesh, seen.triangle, time);
        return receiver{triangle.inside(seen.weights), side * triangle.normal()};
    };
    return {at(0), at(1)};
}

reference_picture tracer::photograph(const moving_camera& light, const camera& eye, int width, int height,
                                     int samples) const
{
    check_samples(samples);
    reference_picture result{{width, height, 1}, {width, height, 0}, {width, height}};
    const auto expose = [&](int x, int y) {
        const view_ray way = ray_through(eye, {(x + 0.5) / width, (y + 0.5) / height});
        const glm::vec3 origin(way.origin), direction(way.direction);
        const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        alignas(64) RTCRayHit16 view{};
        alignas(64) RTCRay16 rays{};
        glm::dvec3 colour(0);
        int covered = 0, lit = 0;
        for (int first = 0; first < samples; first += packet) {
            alignas(64) mask looking{}, facing{};
            std::array<hit, packet> seen{};
            std::array<float, packet> cosines{};
            for (int i = 0; i < std::min(packet, samples - first); ++i) {
                set_ray(view.ray, i, origin, direction, std::numeric_limits<float>::infinity(),
                        moment(pixel, first + i, samples));
                view.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
                looking[static_cast<std::size_t>(i)] = -1;
            }
            state_->look(looking, view);
            for (std::size_t i = 0; i < packet; ++i) {
                if (!looking[i]) continue;
                const float time = view.ray.time[i];
                seen[i] = state_->meet(view.hit.geomID[i], view.hit.primID[i], view.hit.u[i], view.hit.v[i],
                                       way.direction, time);
                if (!seen[i].valid()) continue;
                const receiver from{seen[i].position, seen[i].normal};
                cosines[i] = state_->aim(rays, static_cast<int>(i), from, light, time);
                if (cosines[i] > 0) facing[i] = -1;
            }
            state_->trace(facing, rays);
            for (std::size_t i = 0; i < packet; ++i) {
                if (!looking[i]) continue;
                const bool sunny = facing[i] && !(rays.tfar[i] < 0);
                covered += seen[i].valid(), lit += sunny;
                colour += state_->colour(seen[i], sunny ? cosines[i] : 0);
            }
        }
        result.coverage(x, y) = static_cast<float>(covered) / static_cast<float>(samples);
        if (covered > 0) result.visibility(x, y) = static_cast<float>(lit) / static_cast<float>(covered);
        result.colour(x, y) = glm::vec3(colour / static_cast<double>(samples));
    };
    tbb::parallel_for(0, height, [&](int y) {
        for (int x = 0; x < width; ++x) expose(x, y);
    });
    return result;
}

image<float> traced_visibility(const tracer& rays, const camera& light, const image<surface>& seen)
{
    std::vector<receiver> receivers;
    std::vector<std::size_t> pixels;
    for (std::size_t i = 0; i < seen.pixels.size(); ++i)
        if (const surface& s = seen.pixels[i]; s.valid())
            receivers.push_back({s.position, s.normal}), pixels.push_back(i);
    std::vector<float> visible(receivers.size());
    rays.visibility(light, receivers, visible);
    image<float> result(seen.width, seen.height, 1);
    for (std::size_t i = 0; i < pixels.size(); ++i) result.pixels[pixels[i]] = visible[i];
    return result;
}

} // namespace gnomon::toolbox
