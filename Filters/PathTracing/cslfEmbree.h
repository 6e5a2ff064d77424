// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Embree 3 and 4 behind one set of names: handles that release themselves, and the ray queries the
 * tracer uses. The only file that knows the difference between the two.
 */
#ifndef cslfEmbree_h
#define cslfEmbree_h

#if __has_include(<embree3/rtcore.h>)
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <memory>
#include <type_traits>

namespace cslf
{
struct EmbreeRelease
{
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};

using EmbreeDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, EmbreeRelease>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, EmbreeRelease>;
using EmbreeGeometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, EmbreeRelease>;

#if RTC_VERSION_MAJOR < 4

/// The first hit of one ray.
inline void EmbreeIntersect(RTCScene scene, RTCRayHit& rayHit)
{
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &rayHit);
}

/// Whether anything lies along the ray: sets tfar to -infinity if so.
inline void EmbreeOccluded(RTCScene scene, RTCRay& ray)
{
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
}

/// The first hits of 16 rays that run alike; lanes with valid == 0 are left alone.
inline void EmbreeIntersectCoherent(RTCScene scene, const int valid[16], RTCRayHit16& rayHit)
{
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &context, &rayHit);
}

#else

inline void EmbreeIntersect(RTCScene scene, RTCRayHit& rayHit)
{
  rtcIntersect1(scene, &rayHit);
}

inline void EmbreeOccluded(RTCScene scene, RTCRay& ray)
{
  rtcOccluded1(scene, &ray);
}

inline void EmbreeIntersectCoherent(RTCScene scene, const int valid[16], RTCRayHit16& rayHit)
{
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &rayHit, &arguments);
}

#endif
}

#endif
