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

/// How a ray deals with surfaces whose opacity is neither 0 nor 1.
enum class Passing
{
  ByChance,  ///< passes with the chance that the opacity says
  ByHalf,    ///< passes where the opacity is below one half
  Attenuated ///< passes, and its light is attenuated: of queries for occlusion only
};

#if RTC_VERSION_MAJOR < 4

/// What the filters of opacity get of a query; all queries go with one.
struct EmbreeQuery
{
  RTCIntersectContext Context; // first, since that is what filters get a pointer to
  Passing Rule;
  float* Transmittance = nullptr; // of the rays by their id, where they are attenuated

  explicit EmbreeQuery(Passing rule)
    : Rule(rule)
  {
    rtcInitIntersectContext(&this->Context);
  }
};

/// The first hit of one ray.
inline void EmbreeIntersect(RTCScene scene, EmbreeQuery query, RTCRayHit& rayHit)
{
  rtcIntersect1(scene, &query.Context, &rayHit);
}

/// Whether anything lies along the ray: sets tfar to -infinity if so.
inline void EmbreeOccluded(RTCScene scene, EmbreeQuery query, RTCRay& ray)
{
  rtcOccluded1(scene, &query.Context, &ray);
}

/// The first hits of 16 rays, which may run alike; lanes with valid == 0 are left alone.
inline void EmbreeIntersect16(
  RTCScene scene, EmbreeQuery query, bool alike, const int valid[16], RTCRayHit16& rayHit)
{
  query.Context.flags =
    alike ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcIntersect16(valid, scene, &query.Context, &rayHit);
}

/// The first hits of 8 rays that do not run alike.
inline void EmbreeIntersect8(
  RTCScene scene, EmbreeQuery query, const int valid[8], RTCRayHit8& rayHit)
{
  query.Context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcIntersect8(valid, scene, &query.Context, &rayHit);
}

/// Whether anything lies along each of 16 rays that do not run alike: sets tfar to -infinity if so.
inline void EmbreeOccluded16(RTCScene scene, EmbreeQuery query, const int valid[16], RTCRay16& ray)
{
  query.Context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcOccluded16(valid, scene, &query.Context, &ray);
}

#else

struct EmbreeQuery
{
  RTCRayQueryContext Context;
  Passing Rule;
  float* Transmittance = nullptr;

  explicit EmbreeQuery(Passing rule)
    : Rule(rule)
  {
    rtcInitRayQueryContext(&this->Context);
  }
};

inline void EmbreeIntersect(RTCScene scene, EmbreeQuery query, RTCRayHit& rayHit)
{
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &query.Context;
  rtcIntersect1(scene, &rayHit, &arguments);
}

inline void EmbreeOccluded(RTCScene scene, EmbreeQuery query, RTCRay& ray)
{
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &query.Context;
  rtcOccluded1(scene, &ray, &arguments);
}

inline void EmbreeIntersect16(
  RTCScene scene, EmbreeQuery query, bool alike, const int valid[16], RTCRayHit16& rayHit)
{
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = alike ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  arguments.context = &query.Context;
  rtcIntersect16(valid, scene, &rayHit, &arguments);
}

inline void EmbreeIntersect8(
  RTCScene scene, EmbreeQuery query, const int valid[8], RTCRayHit8& rayHit)
{
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
  arguments.context = &query.Context;
  rtcIntersect8(valid, scene, &rayHit, &arguments);
}

inline void EmbreeOccluded16(RTCScene scene, EmbreeQuery query, const int valid[16], RTCRay16& ray)
{
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
  arguments.context = &query.Context;
  rtcOccluded16(valid, scene, &ray, &arguments);
}

#endif
}

#endif
