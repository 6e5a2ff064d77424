// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A common interface to Embree 3 and 4: handles that release themselves, and the tracer's ray
 * queries. This is the only file that depends on the version.
 */
#ifndef cslfEmbree_h
#define cslfEmbree_h

#if __has_include(<embree3/rtcore.h>)
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <cstring>
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

/// How a ray treats surfaces whose opacity is neither 0 nor 1.
enum class Passing
{
  ByChance,  ///< passes with the probability given by the opacity
  ByOpacity, ///< passes if the opacity is below the query's MinimumOpacity
  Attenuated ///< passes, and its light is attenuated; only in occlusion queries
};

#if RTC_VERSION_MAJOR < 4
using EmbreeContext = RTCIntersectContext;
#else
using EmbreeContext = RTCRayQueryContext;
#endif

/// The data of a query for the opacity filters. All queries pass it.
struct EmbreeQuery
{
  EmbreeContext Context; // first, because filters get a pointer to it
  Passing Rule;
  float MinimumOpacity = 0.0f;
  RTCRayHit16* Veils = nullptr;   // gets the last hit that each ray passes, by its id
  float* Transmittance = nullptr; // of the rays by their id, if they are attenuated
  bool* MeetsVeils = nullptr;     // set if an opacity is neither 0 nor 1

  explicit EmbreeQuery(Passing rule)
    : Rule(rule)
  {
#if RTC_VERSION_MAJOR < 4
    rtcInitIntersectContext(&this->Context);
#else
    rtcInitRayQueryContext(&this->Context);
#endif
  }
};

/// Embree's query for the first hits of a type of packet, with the arguments of its version.
template <typename RayHits, typename... Arguments>
void CallIntersect(Arguments... arguments)
{
  if constexpr (std::is_same_v<RayHits, RTCRayHit16>)
  {
    rtcIntersect16(arguments...);
  }
  else if constexpr (std::is_same_v<RayHits, RTCRayHit8>)
  {
    rtcIntersect8(arguments...);
  }
  else
  {
    rtcIntersect4(arguments...);
  }
}

/// Embree's query for occlusion, likewise.
template <typename Rays, typename... Arguments>
void CallOccluded(Arguments... arguments)
{
  if constexpr (std::is_same_v<Rays, RTCRay16>)
  {
    rtcOccluded16(arguments...);
  }
  else if constexpr (std::is_same_v<Rays, RTCRay8>)
  {
    rtcOccluded8(arguments...);
  }
  else
  {
    rtcOccluded4(arguments...);
  }
}

/// The first hit of one ray.
inline void EmbreeIntersect(RTCScene scene, EmbreeQuery query, RTCRayHit& rayHit)
{
#if RTC_VERSION_MAJOR < 4
  rtcIntersect1(scene, &query.Context, &rayHit);
#else
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &query.Context;
  rtcIntersect1(scene, &rayHit, &arguments);
#endif
}

/// The first hits of a packet of rays, which may be coherent. Lanes with valid == 0 are not
/// changed. The packet must not be wider than GetPacketWidth.
template <typename RayHits>
void EmbreeIntersectPacket(
  RTCScene scene, EmbreeQuery query, bool alike, const int* valid, RayHits& rayHits)
{
#if RTC_VERSION_MAJOR < 4
  query.Context.flags =
    alike ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  CallIntersect<RayHits>(valid, scene, &query.Context, &rayHits);
#else
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = alike ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  arguments.context = &query.Context;
  CallIntersect<RayHits>(valid, scene, &rayHits, &arguments);
#endif
}

/// Whether anything lies along each ray of an incoherent packet. If so, sets tfar to -infinity. The
/// packet must not be wider than GetPacketWidth.
template <typename Rays>
void EmbreeOccludedPacket(RTCScene scene, EmbreeQuery query, const int* valid, Rays& rays)
{
#if RTC_VERSION_MAJOR < 4
  query.Context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  CallOccluded<Rays>(valid, scene, &query.Context, &rays);
#else
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
  arguments.context = &query.Context;
  CallOccluded<Rays>(valid, scene, &rays, &arguments);
#endif
}

/// The number of rays that Embree traces side by side on this machine: 16, 8 or 4.
inline int GetPacketWidth(RTCDevice device)
{
  return rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) ? 16
    : rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED)     ? 8
                                                                                  : 4;
}

/// Calls `trace(first, part)` for each `Part` of a packet of 16, whose lanes from `first` on are
/// copied to it and back. The packet and its parts must be Embree's structures of one kind, whose
/// members are each a 4-byte value of every lane.
template <typename Part, typename Packet, typename Trace>
void ForEachPart(Packet& packet, const Trace& trace)
{
  constexpr std::size_t lane = sizeof(float);
  constexpr std::size_t members = sizeof(Packet) / (16 * lane);
  constexpr std::size_t lanes = sizeof(Part) / (members * lane);
  static_assert(members * lanes * lane == sizeof(Part), "a part has no padding");
  auto* whole = reinterpret_cast<unsigned char*>(&packet);
  for (std::size_t first = 0; first < 16; first += lanes)
  {
    Part part;
    auto* some = reinterpret_cast<unsigned char*>(&part);
    for (std::size_t i = 0; i < members; ++i)
    {
      std::memcpy(some + i * lanes * lane, whole + (16 * i + first) * lane, lanes * lane);
    }
    trace(first, part);
    for (std::size_t i = 0; i < members; ++i)
    {
      std::memcpy(whole + (16 * i + first) * lane, some + i * lanes * lane, lanes * lane);
    }
  }
}

/// Traces a packet of 16 in packets of `width`: as a whole, or in parts as above.
template <typename Part8, typename Part4, typename Packet, typename Trace>
void TraceParts(int width, Packet& packet, const Trace& trace)
{
  if (width == 16)
  {
    trace(0, packet);
  }
  else if (width == 8)
  {
    ForEachPart<Part8>(packet, trace);
  }
  else
  {
    ForEachPart<Part4>(packet, trace);
  }
}

/// The first hits of 16 rays, which may be coherent. Lanes with valid == 0 are not changed. They
/// are traced in packets of GetPacketWidth: Embree 3 ignores `valid` in wider packets, and ends the
/// process if a lane's numbers are not finite.
inline void EmbreeIntersect16(RTCScene scene, int width, const EmbreeQuery& query, bool alike,
  const int valid[16], RTCRayHit16& rayHits)
{
  const auto trace = [scene, &query, alike, valid](std::size_t first, auto& part)
  { EmbreeIntersectPacket(scene, query, alike, valid + first, part); };
  TraceParts<RTCRayHit8, RTCRayHit4>(width, rayHits, trace);
}

/// Whether anything lies along each of 16 incoherent rays. If so, sets tfar to -infinity.
inline void EmbreeOccluded16(
  RTCScene scene, int width, const EmbreeQuery& query, const int valid[16], RTCRay16& rays)
{
  const auto trace = [scene, &query, valid](std::size_t first, auto& part)
  { EmbreeOccludedPacket(scene, query, valid + first, part); };
  TraceParts<RTCRay8, RTCRay4>(width, rays, trace);
}
}

#endif
