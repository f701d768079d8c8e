/** Embree 3 (Debian 12) and Embree 4, which casts rays without a context. */
#pragma once
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace scanloom
{
/** Completes the query with the nearest hit of its ray, if there is one. */
inline void intersect(RTCScene scene, RTCRayHit& query)
{
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(scene, &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &query);
#endif
}
}  // namespace scanloom
