// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Packets of rays find the same as each ray alone, and do not change other lanes, on processors
// that trace 4, 8 or 16 rays side by side.
#include "PathTracing/Rays/cslfEmbree.h"
#include "cslfTesting.h"

#include <glm/vec3.hpp>

#include <cmath>
#include <limits>

namespace
{
constexpr int Lanes = 16;
constexpr float Infinity = std::numeric_limits<float>::infinity();

/// A square of two triangles, from -1 to 1, at z = 0.
cslf::EmbreeScene MakeSquare(RTCDevice device)
{
  cslf::EmbreeScene scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  const cslf::EmbreeGeometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
    geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), 4));
  auto* triangles = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
    geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), 2));
  for (int i = 0; i < 4; ++i)
  {
    vertices[i] = { i & 1 ? 1 : -1, i & 2 ? 1 : -1, 0 };
  }
  triangles[0] = { 0, 1, 2 };
  triangles[1] = { 1, 3, 2 };
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(scene.get(), geometry.get(), 0);
  rtcCommitScene(scene.get());
  return scene;
}

/// Rays down from z = 2 along x. The outer ones miss the square, and every third lane is not a ray.
void FillRays(RTCRay16& rays, int* valid)
{
  for (int i = 0; i < Lanes; ++i)
  {
    valid[i] = i % 3 == 1 ? 0 : -1;
    rays.org_x[i] = valid[i] ? 0.2f * (i - 7.5f) : std::nanf("");
    rays.org_y[i] = 0.1f;
    rays.org_z[i] = 2.0f;
    rays.dir_x[i] = 0.0f;
    rays.dir_y[i] = 0.0f;
    rays.dir_z[i] = valid[i] ? -1.0f : Infinity;
    rays.tnear[i] = 0.0f;
    rays.tfar[i] = Infinity;
    rays.time[i] = 0.0f;
    rays.mask[i] = ~0u;
    rays.id[i] = static_cast<unsigned int>(i);
    rays.flags[i] = 0;
  }
}

bool IsOverSquare(int lane)
{
  return std::abs(lane - 7.5f) < 5.0f;
}

void TestIntersection(RTCScene scene, int width, bool alike)
{
  RTCRayHit16 query;
  alignas(64) int valid[Lanes];
  FillRays(query.ray, valid);
  for (int i = 0; i < Lanes; ++i)
  {
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  cslf::EmbreeIntersect16(
    scene, width, cslf::EmbreeQuery(cslf::Passing::ByChance), alike, valid, query);
  for (int i = 0; i < Lanes; ++i)
  {
    const bool hit = valid[i] && IsOverSquare(i);
    CSLF_CHECK(query.hit.geomID[i] == (hit ? 0 : RTC_INVALID_GEOMETRY_ID));
    CSLF_CHECK(hit ? std::abs(query.ray.tfar[i] - 2.0f) < 1e-5f : query.ray.tfar[i] == Infinity);
    CSLF_CHECK(query.ray.id[i] == static_cast<unsigned int>(i));
  }
}

void TestOcclusion(RTCScene scene, int width)
{
  RTCRay16 query;
  alignas(64) int valid[Lanes];
  FillRays(query, valid);
  cslf::EmbreeOccluded16(scene, width, cslf::EmbreeQuery(cslf::Passing::ByChance), valid, query);
  for (int i = 0; i < Lanes; ++i)
  {
    CSLF_CHECK(query.tfar[i] == (valid[i] && IsOverSquare(i) ? -Infinity : Infinity));
  }
}

void TestDevice(const char* configuration, int widest)
{
  const cslf::EmbreeDevice device(rtcNewDevice(configuration));
  if (!device)
  {
    std::cout << "This processor does not have " << configuration << ".\n";
    return;
  }
  const int width = cslf::GetPacketWidth(device.get());
  CSLF_CHECK(width == 4 || width == 8 || width == 16);
  CSLF_CHECK(width <= widest);
  const cslf::EmbreeScene scene = MakeSquare(device.get());
  TestIntersection(scene.get(), width, true);
  TestIntersection(scene.get(), width, false);
  TestOcclusion(scene.get(), width);
}
}

int TestCSLFRayPackets(int, char*[])
{
  TestDevice("isa=sse2", 4);
  TestDevice("isa=avx", 8);
  TestDevice("isa=avx2", 8);
  TestDevice("", Lanes); // the processor's features
  return cslf::testing::Result();
}
