// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfScene.h"

#include "PathTracing/Rays/cslfEmbree.h"
#include "PathTracing/Rays/cslfHitFilter.h"
#include "PathTracing/Rays/cslfHitGeometry.h"
#include "PathTracing/Rays/cslfRayLanes.h"
#include "PathTracing/Shapes/cslfTriangleGeometry.h"
#include "PathTracing/Volumes/cslfVolumeSet.h"
#include "Pipeline/cslfPhase.h"
#include "SIMD/cslfVectorize.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>
#include <utility>

namespace cslf
{
namespace
{
// The share of the way to a light that must be free.
constexpr float ShadowLength = 0.9999f;

// Up to this many shapes, packets of rays to one octant are traced as coherent. Measured in closed
// boxes: it saves half of the time at 100 triangles, and costs a little at 600.
constexpr std::size_t SmallCount = 400;

// The progress when the trees of meshes with instances are built.
constexpr double PartsShare = 0.5;

bool IsTraceable(const Ray& ray)
{
  // Embree ends the process at a ray that is not finite. A sum is finite only if all its terms are.
  const glm::vec3 sum = ray.Origin + ray.Direction;
  return std::isfinite(sum.x + sum.y + sum.z) && ray.Direction != glm::vec3(0.0f);
}

RTCRay ToEmbree(const Ray& ray)
{
  RTCRay result;
  result.org_x = ray.Origin.x;
  result.org_y = ray.Origin.y;
  result.org_z = ray.Origin.z;
  result.dir_x = ray.Direction.x;
  result.dir_y = ray.Direction.y;
  result.dir_z = ray.Direction.z;
  result.tnear = 0.0f;
  result.tfar = std::numeric_limits<float>::infinity();
  result.time = 0.0f;
  result.mask = ~0u;
  result.id = 0;
  result.flags = 0;
  return result;
}

/// Prepares a packet for tracing: `valid` marks its finite rays.
CSLF_VECTORIZE void PrepareQuery(RTCRayHit16& query, const int* active, int* valid)
{
  for (int i = 0; i < RayPacket::Size; ++i)
  {
    const float sum = query.ray.org_x[i] + query.ray.org_y[i] + query.ray.org_z[i] +
      query.ray.dir_x[i] + query.ray.dir_y[i] + query.ray.dir_z[i];
    // False for values that are not finite.
    valid[i] = sum - sum == 0.0f ? active[i] : 0;
    query.ray.tnear[i] = 0.0f;
    query.ray.tfar[i] = std::numeric_limits<float>::infinity();
    query.ray.time[i] = 0.0f;
    query.ray.mask[i] = ~0u;
    query.ray.id[i] = static_cast<unsigned int>(i);
    query.ray.flags[i] = 0;
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
}

/// Makes a query of as many lanes as it has, from the first on. Lanes that are active and that
/// Embree can trace are valid.
template <int Size, typename Query>
inline void FillRays(const RayLanes& rays, int first, Query& query, int* valid)
{
  CSLF_LANE_LOOP
  for (int i = 0; i < Size; ++i)
  {
    const glm::vec3 origin = rays.Origin.Get(first + i);
    const glm::vec3 direction = rays.Direction.Get(first + i);
    const float sum = origin.x + origin.y + origin.z + direction.x + direction.y + direction.z;
    valid[i] = sum - sum == 0.0f ? rays.Active[first + i] : 0;
    query.org_x[i] = origin.x;
    query.org_y[i] = origin.y;
    query.org_z[i] = origin.z;
    query.dir_x[i] = direction.x;
    query.dir_y[i] = direction.y;
    query.dir_z[i] = direction.z;
    query.tnear[i] = 0.0f;
    query.tfar[i] = std::numeric_limits<float>::infinity();
    query.time[i] = 0.0f;
    query.mask[i] = ~0u;
    query.id[i] = static_cast<unsigned int>(i);
    query.flags[i] = 0;
  }
}

template <int Size, typename Query>
inline void FillIntersection(const RayLanes& rays, int first, Query& query, int* valid)
{
  FillRays<Size>(rays, first, query.ray, valid);
  CSLF_LANE_LOOP
  for (int i = 0; i < Size; ++i)
  {
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
}

template <int Size, typename Query>
inline void ReadHits(const Query& query, int first, HitLanes& hits)
{
  CSLF_LANE_LOOP
  for (int i = 0; i < Size; ++i)
  {
    const float away = query.hit.Ng_x[i] * query.ray.dir_x[i] +
      query.hit.Ng_y[i] * query.ray.dir_y[i] + query.hit.Ng_z[i] * query.ray.dir_z[i];
    hits.Distance[first + i] = query.ray.tfar[i];
    hits.U[first + i] = query.hit.u[i];
    hits.V[first + i] = query.hit.v[i];
    hits.Mesh[first + i] = query.hit.geomID[i];
    hits.Triangle[first + i] = query.hit.primID[i];
    hits.Instance[first + i] = query.hit.instID[0][i];
    hits.Back[first + i] = away > 0.0f ? -1 : 0;
  }
}

CSLF_VECTORIZE void Fill(const RayLanes& rays, RTCRayHit16& query, int* valid)
{
  FillIntersection<LaneCount>(rays, 0, query, valid);
}

CSLF_VECTORIZE void Fill(const RayLanes& rays, int first, RTCRayHit8& query, int* valid)
{
  FillIntersection<LaneCount / 2>(rays, first, query, valid);
}

CSLF_VECTORIZE void Fill(const ShadowLanes& shadows, RTCRay16& query, int* valid)
{
  FillRays<LaneCount>(shadows.Rays, 0, query, valid);
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    query.tfar[i] = shadows.Distance[i] * ShadowLength;
  }
}

CSLF_VECTORIZE void Read(const RTCRayHit16& query, HitLanes& hits)
{
  ReadHits<LaneCount>(query, 0, hits);
}

CSLF_VECTORIZE void Read(const RTCRayHit8& query, int first, HitLanes& hits)
{
  ReadHits<LaneCount / 2>(query, first, hits);
}

void ReportError(void* user, RTCError, const char* text)
{
  auto* error = static_cast<std::string*>(user);
  if (error->empty())
  {
    *error = std::string("Embree: ") + (text ? text : "unknown error");
  }
}

template <typename Value>
Value* MakeBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count)
{
  return static_cast<Value*>(
    rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Value), count));
}

bool FillTriangles(RTCGeometry geometry, const Mesh& mesh)
{
  auto* vertices = MakeBuffer<glm::vec3>(
    geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.Vertices.size());
  auto* triangles = MakeBuffer<glm::uvec3>(
    geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.Triangles.size());
  if (vertices && triangles)
  {
    std::copy(mesh.Vertices.begin(), mesh.Vertices.end(), vertices);
    std::copy(mesh.Triangles.begin(), mesh.Triangles.end(), triangles);
  }
  return vertices && triangles;
}

/// Spheres around vertices, or tubes around pairs of vertices.
bool FillRound(RTCGeometry geometry, const Mesh& mesh)
{
  const std::size_t count = mesh.Vertices.size();
  auto* vertices =
    MakeBuffer<glm::vec4>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, count);
  if (!vertices)
  {
    return false;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    vertices[i] = glm::vec4(mesh.Vertices[i], mesh.Radii[i]);
  }
  if (mesh.Shape == Mesh::Shapes::Tubes)
  {
    auto* starts = MakeBuffer<std::uint32_t>(
      geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, mesh.GetNumberOfShapes());
    for (std::uint32_t i = 0; starts && i < mesh.GetNumberOfShapes(); ++i)
    {
      starts[i] = 2 * i;
    }
    return starts != nullptr;
  }
  return true;
}

void AddGeometry(RTCDevice device, RTCScene scene, const Mesh& mesh, unsigned int id)
{
  const RTCGeometryType type = mesh.Shape == Mesh::Shapes::Triangles ? RTC_GEOMETRY_TYPE_TRIANGLE
    : mesh.Shape == Mesh::Shapes::Spheres ? RTC_GEOMETRY_TYPE_SPHERE_POINT
                                          : RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE;
  const EmbreeGeometry geometry(rtcNewGeometry(device, type));
  if (!geometry)
  {
    return;
  }
  const bool filled = mesh.Shape == Mesh::Shapes::Triangles ? FillTriangles(geometry.get(), mesh)
                                                            : FillRound(geometry.get(), mesh);
  if (filled)
  {
    FilterHits(geometry.get(), mesh);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene, geometry.get(), id);
  }
}

void AddInstance(
  RTCDevice device, RTCScene scene, RTCScene part, const MeshInstance& instance, unsigned int id)
{
  const EmbreeGeometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE));
  rtcSetGeometryInstancedScene(geometry.get(), part);
  const glm::vec3 columns[4] = { instance.Linear[0], instance.Linear[1], instance.Linear[2],
    instance.Offset };
  rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(scene, geometry.get(), id);
}

/// Prepares meshes, which must not move in memory, and makes their lights.
LocalLights PrepareMeshes(std::vector<Mesh>& meshes, const std::vector<PointLight>& points)
{
  for (Mesh& mesh : meshes)
  {
    mesh.PrepareRounding();
    mesh.PrepareEmission();
  }
  return { meshes, points };
}
}

/// Reports the progress of commits. Embree calls it from all of its threads.
class CommitMonitor
{
public:
  explicit CommitMonitor(const Progress& progress)
    : Report(progress)
  {
  }

  /// Throws Aborted if the work shall end. Its progress is then between those shares.
  void Commit(RTCScene scene, double first, double last)
  {
    this->First = first;
    this->Last = last;
    if (this->Report)
    {
      OrAbort(this->Report)(first);
      rtcSetSceneProgressMonitorFunction(scene, CommitMonitor::Note, this);
    }
    rtcCommitScene(scene);
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
    if (this->IsStopped)
    {
      throw Aborted();
    }
  }

private:
  static bool Note(void* self, double share)
  {
    auto* monitor = static_cast<CommitMonitor*>(self);
    if (!monitor->IsStopped && std::this_thread::get_id() == monitor->Caller)
    {
      const double all = monitor->First + (monitor->Last - monitor->First) * share;
      monitor->IsStopped = !monitor->Report(std::min(all, monitor->Last));
    }
    return !monitor->IsStopped;
  }

  const Progress& Report;
  std::thread::id Caller = std::this_thread::get_id();
  std::atomic<bool> IsStopped{ false };
  double First = 0.0;
  double Last = 1.0;
};

struct Scene::Acceleration
{
  EmbreeDevice Device;
  int PacketWidth = 0;
  std::vector<EmbreeScene> Parts; // of meshes that have instances
  EmbreeScene World;
};

Scene::Scene(std::vector<Mesh> meshes, LightSet lights, const Progress& progress,
  std::shared_ptr<const VolumeSet> volumes)
  : Meshes(std::move(meshes))
  , Lights(std::move(lights))
  , Locals(PrepareMeshes(this->Meshes, this->Lights.Points))
  , Tree(std::make_unique<Acceleration>())
  , Volumes(volumes && !volumes->IsEmpty() ? std::move(volumes) : nullptr)
{
  std::size_t triangles = 0;
  std::size_t shapes = 0;
  for (const Mesh& mesh : this->Meshes)
  {
    shapes += mesh.GetNumberOfShapes() * std::max<std::size_t>(mesh.Instances.size(), 1);
    this->FirstTriangles.push_back(triangles);
    triangles += mesh.CanHoldLattice() ? mesh.Triangles.size() : 0;
  }
  // Without a configuration, because Embree's "threads" would bind every other user of TBB as well.
  this->Tree->Device.reset(rtcNewDevice(nullptr));
  RTCDevice device = this->Tree->Device.get();
  if (!device)
  {
    this->Error = "Embree cannot be started on this machine.";
    return;
  }
  rtcSetDeviceErrorFunction(device, ReportError, &this->Error);
  this->Tree->PacketWidth = GetPacketWidth(device);
  // The high-quality builder references triangles more than once, but attenuated rays must meet
  // each only once.
  const bool translucent = std::any_of(this->Meshes.begin(), this->Meshes.end(),
    [](const Mesh& mesh) { return mesh.IsTranslucent(); });
  const auto makeScene = [device, translucent]
  {
    EmbreeScene scene(rtcNewScene(device));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(
      scene.get(), translucent ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_HIGH);
    return scene;
  };
  CommitMonitor monitor(progress);
  this->Tree->World = makeScene();
  RTCScene world = this->Tree->World.get();
  // Instances are numbered after the meshes.
  auto next = static_cast<std::uint32_t>(this->Meshes.size());
  for (std::uint32_t i = 0; i < this->Meshes.size(); ++i)
  {
    Mesh& mesh = this->Meshes[i];
    if (mesh.Instances.empty())
    {
      AddGeometry(device, world, mesh, i);
      continue;
    }
    this->Tree->Parts.push_back(makeScene());
    RTCScene part = this->Tree->Parts.back().get();
    AddGeometry(device, part, mesh, i);
    const auto count = static_cast<double>(this->Meshes.size());
    monitor.Commit(part, PartsShare * i / count, PartsShare * (i + 1) / count);
    mesh.FirstInstance = next;
    for (const MeshInstance& instance : mesh.Instances)
    {
      AddInstance(device, world, part, instance, next++);
    }
  }
  monitor.Commit(world, this->Tree->Parts.empty() ? 0.0 : PartsShare, 1.0);
  this->Small = shapes <= SmallCount;
}

Scene::~Scene() = default;

void Scene::SetNeutral(bool isNeutral)
{
  for (Mesh& mesh : this->Meshes)
  {
    mesh.NeutralAlbedo = -1.0f;
    if (isNeutral && mesh.FindMap() && !mesh.Material.Unlit)
    {
      mesh.NeutralAlbedo = mesh.MeasureAlbedo();
    }
  }
}

Box Scene::GetBounds() const
{
  RTCBounds bounds;
  rtcGetSceneBounds(this->Tree->World.get(), &bounds);
  Box box{ { bounds.lower_x, bounds.lower_y, bounds.lower_z },
    { bounds.upper_x, bounds.upper_y, bounds.upper_z } };
  if (this->Volumes)
  {
    const Box volumes = this->Volumes->GetBounds();
    box = { glm::min(box.Low, volumes.Low), glm::max(box.High, volumes.High) };
  }
  return box;
}

std::uint32_t Scene::GetInstance(std::uint32_t mesh, std::uint32_t geometry) const
{
  return geometry == RTC_INVALID_GEOMETRY_ID ? TrianglePoint::None
                                             : geometry - this->Meshes[mesh].FirstInstance;
}

Hit Scene::Intersect(const Ray& ray) const
{
  Hit hit;
  if (!IsTraceable(ray))
  {
    return hit;
  }
  RTCRayHit query;
  query.ray = ToEmbree(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  EmbreeIntersect(this->Tree->World.get(), EmbreeQuery(Passing::ByChance), query);
  if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID)
  {
    const glm::vec3 normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
    hit = { query.ray.tfar, query.hit.u, query.hit.v, query.hit.geomID, query.hit.primID,
      this->GetInstance(query.hit.geomID, query.hit.instID[0]),
      glm::dot(normal, ray.Direction) > 0.0f };
  }
  return hit;
}

void Scene::Intersect(RayPacket& packet) const
{
  this->Trace(packet, nullptr);
}

void Scene::Intersect(RayPacket& packet, RayPacket& veils) const
{
  std::fill_n(veils.Query.hit.geomID, RayPacket::Size, RTC_INVALID_GEOMETRY_ID);
  this->Trace(packet, &veils.Query);
  for (int i = 0; packet.MeetsVeils && i < RayPacket::Size; ++i)
  {
    veils.SetRay(i, packet.GetRay(i));
    veils.Query.hit.geomID[i] =
      packet.IsHit(i) ? RTC_INVALID_GEOMETRY_ID : veils.Query.hit.geomID[i];
  }
  this->FindInstances(veils);
}

void Scene::Trace(RayPacket& packet, RTCRayHit16* veils) const
{
  alignas(64) int valid[RayPacket::Size];
  PrepareQuery(packet.Query, packet.Active, valid);
  EmbreeQuery rule(packet.MinimumOpacity > 0.0f ? Passing::ByOpacity : Passing::ByChance);
  rule.MinimumOpacity = packet.MinimumOpacity;
  rule.Veils = veils;
  packet.MeetsVeils = false;
  rule.MeetsVeils = &packet.MeetsVeils;
  EmbreeIntersect16(
    this->Tree->World.get(), this->Tree->PacketWidth, rule, true, valid, packet.Query);
  this->FindInstances(packet);
  packet.MeetsVolumes = this->Volumes && this->Volumes->MayMeet(packet);
  packet.MeetsVeils |= packet.MeetsVolumes;
}

void Scene::FindInstances(RayPacket& packet) const
{
  RTCHit16& hit = packet.Query.hit;
  for (int i = 0; !this->Tree->Parts.empty() && i < RayPacket::Size; ++i)
  {
    if (packet.IsHit(i))
    {
      hit.instID[0][i] = this->GetInstance(hit.geomID[i], hit.instID[0][i]);
    }
  }
}

void Scene::FindInstances(HitLanes& hits) const
{
  for (int i = 0; i < LaneCount; ++i)
  {
    if (hits.IsValid(i))
    {
      hits.Instance[i] = this->GetInstance(hits.Mesh[i], hits.Instance[i]);
    }
  }
}

void Scene::Intersect(const RayLanes& rays, HitLanes& hits) const
{
  RTCScene world = this->Tree->World.get();
  const EmbreeQuery rule(Passing::ByChance);
  alignas(64) int valid[LaneCount];
  if (this->Small || this->Tree->PacketWidth < LaneCount / 2)
  {
    RTCRayHit16 query;
    Fill(rays, query, valid);
    EmbreeIntersect16(world, this->Tree->PacketWidth, rule, this->Small, valid, query);
    Read(query, hits);
  }
  else
  {
    // Incoherent rays are traced a little faster in smaller packets.
    for (int first = 0; first < LaneCount; first += LaneCount / 2)
    {
      RTCRayHit8 query;
      Fill(rays, first, query, valid);
      EmbreeIntersectPacket(world, rule, false, valid, query);
      Read(query, first, hits);
    }
  }
  if (!this->Tree->Parts.empty())
  {
    this->FindInstances(hits);
  }
}

void Scene::FindTransmittances(ShadowLanes& shadows) const
{
  RTCRay16 query;
  alignas(64) int valid[LaneCount];
  Fill(shadows, query, valid);
  std::fill_n(shadows.Transmittance.Values, LaneCount, 1.0f);
  EmbreeQuery rule(Passing::Attenuated);
  rule.Transmittance = shadows.Transmittance.Values;
  EmbreeOccluded16(this->Tree->World.get(), this->Tree->PacketWidth, rule, valid, query);
  for (int i = 0; i < LaneCount; ++i)
  {
    if (!valid[i] || query.tfar[i] < 0.0f)
    {
      shadows.Transmittance[i] = 0.0f;
    }
  }
  if (this->Volumes)
  {
    this->Volumes->Attenuate(shadows.Rays, shadows.Distance, shadows.Transmittance);
  }
}

SurfaceHit Scene::GetSurface(const Ray& ray, const Hit& hit) const
{
  const Mesh& mesh = this->Meshes[hit.Mesh];
  TrianglePoint place = hit.GetPlace();
  SurfaceHit surface;
  Locate(mesh, ray, hit, place, surface);

  // Its contents.
  const MaterialPoint point = mesh.GetMaterialPoint(place);
  surface.Material = &mesh.Material;
  surface.BaseColor = point.BaseColor;
  surface.Metallic = point.Metallic;
  surface.Alpha = point.Alpha;
  surface.Emission = glm::vec3(0.0f);
  if (mesh.Material.IsEmissive())
  {
    surface.Emission = mesh.GetEmission(place);
  }
  return surface;
}

SurfaceHit Scene::GetSurface(const Hit& hit) const
{
  const Mesh& mesh = this->Meshes[hit.Mesh];
  const glm::uvec3& corners = mesh.Triangles[hit.Triangle];
  const glm::vec3 places[3] = { mesh.Vertices[corners.x], mesh.Vertices[corners.y],
    mesh.Vertices[corners.z] };
  const glm::vec3 front = FindFront(places);
  return this->GetSurface({ glm::vec3(0.0f), hit.Back ? front : -front }, hit);
}
}
