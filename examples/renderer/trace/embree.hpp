// Embree of the version that the build has found, 4 or 3, for the tracer alone: no other file sees its types.
#pragma once

#if GNOMON_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

namespace gnomon::renderer {

#if GNOMON_EMBREE == 3

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

// Ends the coherent rays that meet something: tfar becomes -infinity.
inline void occlude(const int* valid, RTCScene scene, RTCRay16& rays)
{
    RTCIntersectContext context = coherent();
    rtcOccluded16(valid, scene, &context, &rays);
}

#else

inline void intersect(const int* valid, RTCScene scene, RTCRayHit16& rays)
{
    RTCIntersectArguments how;
    rtcInitIntersectArguments(&how);
    how.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect16(valid, scene, &rays, &how);
}

inline void occlude(const int* valid, RTCScene scene, RTCRay16& rays)
{
    RTCOccludedArguments how;
    rtcInitOccludedArguments(&how);
    how.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcOccluded16(valid, scene, &rays, &how);
}

#endif

} // namespace gnomon::renderer
