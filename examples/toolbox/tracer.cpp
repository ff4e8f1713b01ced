#include "tracer.hpp"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

namespace gnomon::toolbox {

namespace {

// Float positions within the bounds are exact to 6e-8 of the diagonal, Embree's intersections to a few times that.
constexpr float relative_offset = 2e-6f;

struct release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

template <class T> using owned = std::unique_ptr<std::remove_pointer_t<T>, release>;

template <class T> void upload(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const std::vector<T>& values)
{
    // Embree owns the buffer, and pads it as it needs to.
    void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), values.size());
    if (!values.empty()) std::memcpy(buffer, values.data(), sizeof(T) * values.size());
}

} // namespace

struct tracer::state {
    owned<RTCDevice> device{rtcNewDevice(nullptr)};
    owned<RTCScene> scene;
    float offset = 0;
};

tracer::tracer(const toolbox::scene& world) : state_(std::make_unique<state>())
{
    if (!state_->device) throw std::runtime_error("tracer: Embree has no device");
    state_->scene.reset(rtcNewScene(state_->device.get()));
    rtcSetSceneFlags(state_->scene.get(), RTC_SCENE_FLAG_ROBUST);
    for (const mesh& part : world.meshes) {
        RTCGeometry geometry = rtcNewGeometry(state_->device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
        upload(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, part.positions);
        upload(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, part.triangles);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(state_->scene.get(), geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(state_->scene.get());
    const bounds all = bounds_of(world);
    if (!all.empty()) state_->offset = relative_offset * glm::length(all.extent());
    if (const RTCError error = rtcGetDeviceError(state_->device.get()); error != RTC_ERROR_NONE)
        throw std::runtime_error(fmt::format("tracer: Embree error {}", static_cast<int>(error)));
}

tracer::~tracer() = default;
tracer::tracer(tracer&&) noexcept = default;
tracer& tracer::operator=(tracer&&) noexcept = default;

float tracer::offset() const { return state_->offset; }

void tracer::visibility(const camera& light, std::span<const receiver> receivers, std::span<float> result) const
{
    if (receivers.size() != result.size())
        throw std::invalid_argument(
            fmt::format("tracer: {} receivers, room for {} results", receivers.size(), result.size()));
    const auto trace = [&](const receiver& from) {
        const glm::vec3 origin = from.position + state_->offset * from.normal;
        // A spot light's ray is the segment up to the light, a directional one has no end.
        const glm::vec3 direction(light.perspective() ? light.position - glm::dvec3(origin) : -light.forward);
        RTCRay ray{};
        ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
        ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
        ray.tfar = light.perspective() ? 1 : std::numeric_limits<float>::infinity();
        ray.mask = ~0u;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcOccluded1(state_->scene.get(), &context, &ray);
        return ray.tfar < 0 ? 0.f : 1.f; // Embree's mark of a hit: -infinity
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, receivers.size(), 1024), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) result[i] = trace(receivers[i]);
    });
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
