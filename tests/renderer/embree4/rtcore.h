// What Embree 4 declares otherwise than Embree 3, for machines that have only the latter.
#pragma once

#include <embree3/rtcore.h>

enum RTCRayQueryFlags { RTC_RAY_QUERY_FLAG_INCOHERENT = 0, RTC_RAY_QUERY_FLAG_COHERENT = 1 << 16 };

struct RTCRayQueryContext {
    unsigned instID;
};

struct RTCIntersectArguments {
    RTCRayQueryFlags flags;
    RTCRayQueryContext* context;
};

struct RTCOccludedArguments {
    RTCRayQueryFlags flags;
    RTCRayQueryContext* context;
};

void rtcInitIntersectArguments(RTCIntersectArguments* args);
void rtcInitRayQueryContext(RTCRayQueryContext* context);
void rtcInitOccludedArguments(RTCOccludedArguments* args);
void rtcIntersect16(const int* valid, RTCScene scene, RTCRayHit16* rayhit, RTCIntersectArguments* args = nullptr);
void rtcOccluded16(const int* valid, RTCScene scene, RTCRay16* ray, RTCOccludedArguments* args = nullptr);
void rtcIntersect1(RTCScene scene, RTCRayHit* rayhit, RTCIntersectArguments* args = nullptr);
void rtcOccluded1(RTCScene scene, RTCRay* ray, RTCOccludedArguments* args = nullptr);
