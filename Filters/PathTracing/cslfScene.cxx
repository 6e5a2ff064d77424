// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfScene.h"

#include "cslfEmbree.h"
#include "cslfOpacity.h"
#include "cslfVectorize.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cslf
{
namespace
{
// How far rays start off a surface, in radii of the scene: a hundred times the rounding of a
// vertex.
constexpr float SurfaceOffset = 1e-5f;

// The part of the way to a light that must be free.
constexpr float ShadowLength = 0.9999f;

// The least cosine between a shading normal and the direction it is seen from.
constexpr float SmallestCosine = 1e-3f;

bool IsTraceable(const Ray& ray)
{
  // Embree stops the process at a ray that is not finite. A sum is finite only if all its terms
  // are.
  const glm::vec3 sum = ray.Origin + ray.Direction;
  return std::isfinite(sum.x + sum.y + sum.z) && ray.Direction != glm::vec3(0.0f);
}

RTCRay ToEmbree(const Ray& ray, float distance)
{
  RTCRay result;
  result.org_x = ray.Origin.x;
  result.org_y = ray.Origin.y;
  result.org_z = ray.Origin.z;
  result.dir_x = ray.Direction.x;
  result.dir_y = ray.Direction.y;
  result.dir_z = ray.Direction.z;
  result.tnear = 0.0f;
  result.tfar = distance;
  result.time = 0.0f;
  result.mask = ~0u;
  result.id = 0;
  result.flags = 0;
  return result;
}

CSLF_VECTORIZE void FillQuery(const RayPacket& packet, RTCRayHit16& query, int* valid)
{
  static_assert(Hit::None == RTC_INVALID_GEOMETRY_ID, "hits of nothing are told alike");
  for (int i = 0; i < RayPacket::Size; ++i)
  {
    const float sum = packet.OriginX[i] + packet.OriginY[i] + packet.OriginZ[i] +
      packet.DirectionX[i] + packet.DirectionY[i] + packet.DirectionZ[i];
    // Only what is finite is equal to itself less nothing.
    valid[i] = sum - sum == 0.0f ? packet.Active[i] : 0;
    query.ray.org_x[i] = packet.OriginX[i];
    query.ray.org_y[i] = packet.OriginY[i];
    query.ray.org_z[i] = packet.OriginZ[i];
    query.ray.dir_x[i] = packet.DirectionX[i];
    query.ray.dir_y[i] = packet.DirectionY[i];
    query.ray.dir_z[i] = packet.DirectionZ[i];
    query.ray.tnear[i] = 0.0f;
    query.ray.tfar[i] = std::numeric_limits<float>::infinity();
    query.ray.time[i] = 0.0f;
    query.ray.mask[i] = ~0u;
    query.ray.id[i] = 0;
    query.ray.flags[i] = 0;
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
}

void ReportError(void* user, RTCError, const char* text)
{
  auto* error = static_cast<std::string*>(user);
  if (error->empty())
  {
    *error = std::string("Embree: ") + (text ? text : "unknown error");
  }
}

void AddGeometry(RTCDevice device, RTCScene scene, const Mesh& mesh, unsigned int id)
{
  const EmbreeGeometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(geometry.get(),
    RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.Vertices.size()));
  auto* triangles = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(geometry.get(),
    RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), mesh.Triangles.size()));
  if (vertices && triangles)
  {
    std::copy(mesh.Vertices.begin(), mesh.Vertices.end(), vertices);
    std::copy(mesh.Triangles.begin(), mesh.Triangles.end(), triangles);
    if (mesh.IsTranslucent())
    {
      PassByOpacity(geometry.get(), mesh);
    }
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene, geometry.get(), id);
  }
}

/// The meshes must stay where they are.
std::vector<EmissiveTriangle> CollectEmitters(std::vector<Mesh>& meshes)
{
  std::vector<EmissiveTriangle> emitters;
  for (Mesh& mesh : meshes)
  {
    mesh.PrepareEmission();
    if (!mesh.Material.IsEmissive())
    {
      continue;
    }
    for (std::uint32_t i = 0; i < mesh.Triangles.size(); ++i)
    {
      const glm::uvec3& triangle = mesh.Triangles[i];
      const glm::vec3& corner = mesh.Vertices[triangle.x];
      emitters.push_back({ corner, mesh.Vertices[triangle.y] - corner,
        mesh.Vertices[triangle.z] - corner, mesh.GetEmissionImportance(i), &mesh, i });
    }
  }
  return emitters;
}

bool HasNormals(const Mesh& mesh, const glm::uvec3& triangle)
{
  const glm::vec3 none(0.0f);
  return !mesh.Normals.empty() && mesh.Normals[triangle.x] != none &&
    mesh.Normals[triangle.y] != none && mesh.Normals[triangle.z] != none;
}

/// A normal, turned to the side of another.
glm::vec3 TurnTo(const glm::vec3& normal, const glm::vec3& side)
{
  return glm::dot(normal, side) < 0.0f ? -normal : normal;
}

/// The normal of the side from which the vertices run counterclockwise.
glm::vec3 GetFrontNormal(const Mesh& mesh, const glm::uvec3& triangle)
{
  const glm::vec3& corner = mesh.Vertices[triangle.x];
  return glm::normalize(
    glm::cross(mesh.Vertices[triangle.y] - corner, mesh.Vertices[triangle.z] - corner));
}

/// The interpolated normal, bent by the normal texture, turned to the ray's side, and so that the
/// ray sees its front.
glm::vec3 FindShadingNormal(
  const Mesh& mesh, const Hit& hit, const SurfaceHit& surface, const glm::vec3& outgoing)
{
  const glm::uvec3& triangle = mesh.Triangles[hit.Triangle];
  const glm::vec3 front = surface.Inside ? -surface.GeometricNormal : surface.GeometricNormal;
  glm::vec3 normal = front;
  if (HasNormals(mesh, triangle))
  {
    normal = TurnTo(mesh.Interpolate(mesh.Normals, hit.GetPlace()), front);
    normal = glm::length(normal) > 1e-6f ? normal : front;
  }
  normal = TurnTo(mesh.BendNormal(normal, hit.GetPlace()), surface.GeometricNormal);
  const float length = glm::length(normal);
  if (!(length > 1e-6f))
  {
    return surface.GeometricNormal;
  }
  normal /= length;
  const float cosine = glm::dot(normal, outgoing);
  return cosine < SmallestCosine ? glm::normalize(normal + (SmallestCosine - cosine) * outgoing)
                                 : normal;
}

/// A point of a triangle, raised to the smooth surface that its corners' normals suggest, so that
/// the triangle does not shadow directions above the shading normal's horizon: Hanika, "Hacking the
/// Shadow Terminator", Ray Tracing Gems II, 2021.
glm::vec3 RaiseToSmoothSurface(const Mesh& mesh, const glm::uvec3& triangle, const Hit& hit,
  const glm::vec3& geometric, const glm::vec3& position)
{
  const float weights[3] = { 1.0f - hit.U - hit.V, hit.U, hit.V };
  glm::vec3 raised = position;
  for (int i = 0; i < 3; ++i)
  {
    const glm::vec3 normal = TurnTo(mesh.Normals[triangle[i]], geometric);
    const float depth = glm::dot(position - mesh.Vertices[triangle[i]], normal);
    raised -= weights[i] * std::min(depth, 0.0f) * normal;
  }
  return raised;
}
}

struct Scene::Acceleration
{
  EmbreeDevice Device;
  EmbreeScene World;
};

Scene::Scene(std::vector<Mesh> meshes, LightSet lights)
  : Meshes(std::move(meshes))
  , Lights(std::move(lights))
  , Emitters(CollectEmitters(this->Meshes))
  , Tree(std::make_unique<Acceleration>())
{
  std::size_t triangles = 0;
  for (const Mesh& mesh : this->Meshes)
  {
    this->FirstTriangles.push_back(triangles);
    triangles += mesh.Triangles.size();
  }
  // Without a configuration: Embree's "threads" would bind every other user of TBB as well.
  this->Tree->Device.reset(rtcNewDevice(nullptr));
  RTCDevice device = this->Tree->Device.get();
  if (!device)
  {
    this->Error = "Embree cannot be started on this machine.";
    return;
  }
  rtcSetDeviceErrorFunction(device, ReportError, &this->Error);
  this->Tree->World.reset(rtcNewScene(device));
  RTCScene world = this->Tree->World.get();
  rtcSetSceneFlags(world, RTC_SCENE_FLAG_ROBUST);
  // The builder of high quality refers to triangles more than once; rays that are attenuated must
  // meet each only once.
  const bool translucent = std::any_of(this->Meshes.begin(), this->Meshes.end(),
    [](const Mesh& mesh) { return mesh.IsTranslucent(); });
  rtcSetSceneBuildQuality(world, translucent ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_HIGH);
  for (std::size_t i = 0; i < this->Meshes.size(); ++i)
  {
    AddGeometry(device, world, this->Meshes[i], static_cast<unsigned int>(i));
  }
  rtcCommitScene(world);
}

Scene::~Scene() = default;

Hit Scene::Intersect(const Ray& ray) const
{
  Hit hit;
  if (!IsTraceable(ray))
  {
    return hit;
  }
  RTCRayHit query;
  query.ray = ToEmbree(ray, std::numeric_limits<float>::infinity());
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  EmbreeIntersect(this->Tree->World.get(), EmbreeQuery(Passing::ByChance), query);
  if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID)
  {
    const glm::vec3 normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
    hit = { query.ray.tfar, query.hit.u, query.hit.v, query.hit.geomID, query.hit.primID,
      glm::dot(normal, ray.Direction) > 0.0f };
  }
  return hit;
}

void Scene::Intersect(RayPacket& packet) const
{
  RTCRayHit16 query;
  alignas(64) int valid[RayPacket::Size];
  FillQuery(packet, query, valid);
  const EmbreeQuery rule(packet.PassByHalf ? Passing::ByHalf : Passing::ByChance);
  EmbreeIntersectCoherent(this->Tree->World.get(), rule, valid, query);
  for (int i = 0; i < RayPacket::Size; ++i)
  {
    Hit& hit = packet.Hits[i];
    hit.Mesh = query.hit.geomID[i];
    if (hit.IsValid())
    {
      const float away = query.hit.Ng_x[i] * query.ray.dir_x[i] +
        query.hit.Ng_y[i] * query.ray.dir_y[i] + query.hit.Ng_z[i] * query.ray.dir_z[i];
      hit = { query.ray.tfar[i], query.hit.u[i], query.hit.v[i], query.hit.geomID[i],
        query.hit.primID[i], away > 0.0f };
    }
  }
}

float Scene::GetTransmittance(const Ray& ray, float distance) const
{
  if (!IsTraceable(ray))
  {
    return 0.0f;
  }
  float transmittance = 1.0f;
  EmbreeQuery rule(Passing::Attenuated);
  rule.Transmittance = &transmittance;
  RTCRay query = ToEmbree(ray, distance * ShadowLength);
  EmbreeOccluded(this->Tree->World.get(), rule, query);
  return query.tfar < 0.0f ? 0.0f : transmittance;
}

SurfaceHit Scene::GetSurface(const Ray& ray, const Hit& hit) const
{
  const Mesh& mesh = this->Meshes[hit.Mesh];
  const glm::uvec3& triangle = mesh.Triangles[hit.Triangle];
  const TrianglePoint place = hit.GetPlace();
  const glm::vec3 outgoing = -ray.Direction;

  // Where it is, and which way it faces.
  SurfaceHit surface;
  const glm::vec3 front = GetFrontNormal(mesh, triangle);
  surface.GeometricNormal = TurnTo(front, outgoing);
  surface.Inside = surface.GeometricNormal != front;
  surface.ShadingNormal = FindShadingNormal(mesh, hit, surface, outgoing);
  const glm::vec3 position = mesh.Interpolate(mesh.Vertices, place);
  surface.PassPosition = position - SurfaceOffset * surface.GeometricNormal;
  surface.LeavePosition = HasNormals(mesh, triangle)
    ? RaiseToSmoothSurface(mesh, triangle, hit, surface.GeometricNormal, position)
    : position;
  surface.LeavePosition += SurfaceOffset * surface.GeometricNormal;

  // What it is made of.
  const MaterialPoint point = mesh.GetMaterialPoint(place);
  surface.Material = &mesh.Material;
  surface.BaseColor = point.BaseColor;
  surface.Metallic = point.Metallic;
  surface.Alpha = point.Alpha;
  surface.Emission = glm::vec3(0.0f);
  surface.EmissionImportance = 0.0f;
  if (mesh.Material.IsEmissive())
  {
    surface.Emission = mesh.GetEmission(place);
    surface.EmissionImportance = mesh.GetEmissionImportance(hit.Triangle);
  }
  return surface;
}

SurfaceHit Scene::GetSurface(const Hit& hit) const
{
  const Mesh& mesh = this->Meshes[hit.Mesh];
  const glm::vec3 front = GetFrontNormal(mesh, mesh.Triangles[hit.Triangle]);
  return this->GetSurface({ glm::vec3(0.0f), hit.Back ? front : -front }, hit);
}
}
