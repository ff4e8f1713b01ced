#include "swept_triangles.hpp"

#include <cstddef>
#include <limits>

namespace gnomon::renderer {

namespace {

void put_bounds(const RTCBoundsFunctionArguments* args)
{
    const bounds& box = static_cast<const bounds*>(args->geometryUserPtr)[args->primID];
    RTCBounds& to = *args->bounds_o;
    to.lower_x = box.lower.x, to.lower_y = box.lower.y, to.lower_z = box.lower.z;
    to.upper_x = box.upper.x, to.upper_y = box.upper.y, to.upper_z = box.upper.z;
}

// Ends rays that cross the box.
void end_in_box(const RTCOccludedFunctionNArguments* args)
{
    const bounds& box = static_cast<const bounds*>(args->geometryUserPtr)[args->primID];
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] != -1) continue;
        const segment ray{{RTCRayN_org_x(args->ray, args->N, i), RTCRayN_org_y(args->ray, args->N, i),
                           RTCRayN_org_z(args->ray, args->N, i)},
                          {RTCRayN_dir_x(args->ray, args->N, i), RTCRayN_dir_y(args->ray, args->N, i),
                           RTCRayN_dir_z(args->ray, args->N, i)},
                          RTCRayN_tfar(args->ray, args->N, i)};
        if (crosses(ray, box, 0)) RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
    }
}

} // namespace

swept_triangles::swept_triangles(RTCDevice device, const moving_scene& world, float margin) : tree_(rtcNewScene(device))
{
    for (std::size_t m = 0; m < world.open.meshes.size(); ++m) {
        if (!world.moves(m)) continue;
        const mesh& part = world.open.meshes[m];
        for (const glm::uvec3& t : part.triangles) {
            bounds box;
            for (int i = 0; i < 3; ++i) box.include(part.positions[t[i]]), box.include(world.closing[m][t[i]]);
            box.lower -= margin, box.upper += margin;
            boxes_.push_back(box);
        }
    }
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes_.size()));
    rtcSetGeometryUserData(geometry, boxes_.data());
    rtcSetGeometryBoundsFunction(geometry, put_bounds, nullptr);
    rtcSetGeometryOccludedFunction(geometry, end_in_box);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(tree_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(tree_.get(), RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(tree_.get());
}

bool swept_triangles::near(const segment& ray) const
{
    RTCRay query{};
    query.org_x = ray.origin.x, query.org_y = ray.origin.y, query.org_z = ray.origin.z;
    query.dir_x = ray.direction.x, query.dir_y = ray.direction.y, query.dir_z = ray.direction.z;
    query.tfar = ray.end, query.mask = ~0u;
    occlude(tree_.get(), query);
    return query.tfar < 0;
}

} // namespace gnomon::renderer
