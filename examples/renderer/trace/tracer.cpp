#include "tracer_state.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace gnomon::renderer {

namespace {

// Float positions within the bounds are exact to 6e-8 of the diagonal, Embree's intersections to a few times that.
constexpr float relative_offset = 2e-6f;

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

receiver between(const receiver_motion& moving, float t)
{
    return {glm::mix(moving.open.position, moving.closing.position, t),
            unit(glm::mix(moving.open.normal, moving.closing.normal, t))};
}

} // namespace

tracer::tracer(const renderer::scene& world) : tracer(at_rest(world)) {}

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
        if (!part.opaque()) rtcSetGeometryOccludedFilterFunction(geometry, gather);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(state_->scene.get(), geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(state_->scene.get());
    if (const bounds box = bounds_of(all); !box.empty()) state_->offset = relative_offset * glm::length(box.extent());
    if (std::ranges::count(state_->moves, true) > 0)
        state_->swept = std::make_unique<swept_triangles>(state_->device.get(), all, 10 * state_->offset);
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

void tracer::mean_visibility(const moving_camera& light, std::span<const receiver_motion> receivers, int samples,
                             std::span<float> result) const
{
    check_room(receivers.size(), result.size());
    check_samples(samples);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, receivers.size(), 64), [&](const auto& range) {
        alignas(64) RTCRay16 rays{};
        for (std::size_t r = range.begin(); r < range.end(); ++r) {
            const receiver_motion& at = receivers[r];
            const bool one_is_all = at.open == at.closing && state_->always_alike(at.open, light);
            const int times = one_is_all ? 1 : samples;
            int lit = 0;
            for (int first = 0; first < times; first += packet) {
                alignas(64) mask valid{};
                for (int i = 0; i < std::min(packet, times - first); ++i) {
                    const float time = random_time(r, first + i, times);
                    if (state_->aim(rays, i, between(at, time), light, time) > 0)
                        valid[static_cast<std::size_t>(i)] = -1;
                }
                state_->trace(valid, rays);
                for (int i = 0; i < packet; ++i) lit += valid[static_cast<std::size_t>(i)] && !(rays.tfar[i] < 0);
            }
            result[r] = static_cast<float>(lit) / static_cast<float>(times);
        }
    });
}

hit tracer::first_hit(const view_ray& ray, float time) const
{
    alignas(64) RTCRayHit16 query{};
    alignas(64) const mask one{-1};
    set_ray(query.ray, 0, {glm::vec3(ray.origin), glm::vec3(ray.direction), endless}, time);
    query.hit.geomID[0] = RTC_INVALID_GEOMETRY_ID;
    state_->look(one, query);
    return state_->met(query, 0, ray.direction);
}

receiver_motion tracer::receiver_of(const hit& seen, float time_of_hit) const
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

reference_picture tracer::photograph(const moving_camera& light, const moving_camera& eye, int width, int height,
                                     int samples) const
{
    check_samples(samples);
    reference_picture result{{width, height, 1}, {width, height, 0}, {width, height}};
    const auto expose = [&](int x, int y) {
        const view_ray centre = ray_through(eye.open, {(x + 0.5) / width, (y + 0.5) / height});
        const segment ray{glm::vec3(centre.origin), glm::vec3(centre.direction), endless};
        const auto ray_at = [&](float time) {
            return segment{glm::vec3(centre.origin + double(time) * eye.motion), ray.direction, endless};
        };
        const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        const bool one_hit = eye.motion == glm::dvec3(0) && state_->always_alike(ray);
        const hit only = one_hit ? first_hit(centre, 0) : hit{};
        const bool one_is_all = one_hit && (!only.valid() || state_->always_alike({only.position, only.normal}, light));
        const int times = one_is_all ? 1 : samples;
        alignas(64) RTCRayHit16 view{};
        alignas(64) RTCRay16 rays{};
        glm::dvec3 colour(0);
        int covered = 0, lit = 0;
        for (int first = 0; first < times; first += packet) {
            alignas(64) mask looking{}, facing{};
            std::array<hit, packet> seen{};
            std::array<float, packet> cosines{};
            for (int i = 0; i < std::min(packet, times - first); ++i) {
                const float time = random_time(pixel, first + i, times);
                set_ray(view.ray, i, ray_at(time), time);
                view.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
                looking[static_cast<std::size_t>(i)] = -1;
            }
            if (!one_hit) state_->look(looking, view);
            for (std::size_t i = 0; i < packet; ++i) {
                if (!looking[i]) continue;
                const float time = view.ray.time[i];
                seen[i] = one_hit ? only : state_->met(view, static_cast<int>(i), centre.direction);
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
        result.coverage(x, y) = static_cast<float>(covered) / static_cast<float>(times);
        if (covered > 0) result.visibility(x, y) = static_cast<float>(lit) / static_cast<float>(covered);
        result.colour(x, y) = glm::vec3(colour / static_cast<double>(times));
    };
    tbb::parallel_for(0, height, [&](int y) {
        for (int x = 0; x < width; ++x) expose(x, y);
    });
    return result;
}

} // namespace gnomon::renderer
