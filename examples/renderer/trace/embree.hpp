// Embree of the version that the build has found, 4 or 3, for this folder's sources alone: no other file sees its types.
#pragma once

#if GNOMON_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <array>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

namespace gnomon::renderer {

struct release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

template <class T> using owned = std::unique_ptr<std::remove_pointer_t<T>, release>;

// A point of a translucent triangle that a ray crosses, by the weights of its second and third corner.
struct crossing {
    std::uint32_t mesh, triangle;
    float u, v;
};

// For each lane of a packet, in no order.
using crossings = std::array<std::vector<crossing>, 16>;

#if GNOMON_EMBREE == 3

struct ray_query {
    RTCIntersectContext context;
    crossings* gathered;
};

inline RTCIntersectContext coherent()
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
}

// Finds the first hits of coherent rays, of those lanes where valid is -1.
inline void intersect(const int* valid, RTCScene scene, RTCRayHit16& rays)
{
    RTCIntersectContext context = coherent();
    rtcIntersect16(valid, scene, &context, &rays);
}

// Ends the coherent rays that meet something: tfar becomes -infinity. If crossings are gathered, a ray's index is its
// lane, and translucent triangles do not end it.
inline void occlude(const int* valid, RTCScene scene, RTCRay16& rays, crossings* gathered)
{
    ray_query query{coherent(), gathered};
    rtcOccluded16(valid, scene, &query.context, &rays);
}

struct user_query {
    RTCIntersectContext context;
    void* data;
};

// Sends a ray through user geometry, whose callbacks read the data by user_data().
inline void intersect(RTCScene scene, RTCRayHit& ray, void* data)
{
    user_query query{{}, data};
    rtcInitIntersectContext(&query.context);
    rtcIntersect1(scene, &query.context, &ray);
}

inline void occlude(RTCScene scene, RTCRay& ray)
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
}

#else

struct ray_query {
    RTCRayQueryContext context;
    crossings* gathered;
};

inline void intersect(const int* valid, RTCScene scene, RTCRayHit16& rays)
{
    RTCIntersectArguments how;
    rtcInitIntersectArguments(&how);
    how.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect16(valid, scene, &rays, &how);
}

inline void occlude(const int* valid, RTCScene scene, RTCRay16& rays, crossings* gathered)
{
    ray_query query{{}, gathered};
    rtcInitRayQueryContext(&query.context);
    RTCOccludedArguments how;
    rtcInitOccludedArguments(&how);
    how.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    how.context = &query.context;
    rtcOccluded16(valid, scene, &rays, &how);
}

struct user_query {
    RTCRayQueryContext context;
    void* data;
};

inline void intersect(RTCScene scene, RTCRayHit& ray, void* data)
{
    user_query query{{}, data};
    rtcInitRayQueryContext(&query.context);
    RTCIntersectArguments how;
    rtcInitIntersectArguments(&how);
    how.context = &query.context;
    rtcIntersect1(scene, &ray, &how);
}

inline void occlude(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &ray); }

#endif

inline void* user_data(const RTCIntersectFunctionNArguments* args)
{
    // The context is the first member of the query that intersect() has passed.
    return reinterpret_cast<const user_query*>(args->context)->data;
}

// The occlusion filter of translucent geometry: notes a crossing and lets the ray pass, if crossings are gathered.
inline void gather(const RTCFilterFunctionNArguments* args)
{
    // The context is the first member of the query that occlude() has passed.
    crossings* gathered = reinterpret_cast<const ray_query*>(args->context)->gathered;
    if (!gathered) return;
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] != -1) continue;
        (*gathered)[RTCRayN_id(args->ray, args->N, i)].push_back(
            {RTCHitN_geomID(args->hit, args->N, i), RTCHitN_primID(args->hit, args->N, i),
             RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i)});
        args->valid[i] = 0;
    }
}

} // namespace gnomon::renderer
