// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfBenchmarks.h"

#include "PathTracing/Rays/cslfEmbree.h"
#include "PathTracing/Rays/cslfRayGrid.h"
#include "PathTracing/Scene/cslfSceneBuilder.h"
#include "PathTracing/Texels/cslfSamplePlaces.h"
#include "RandomNumbers/cslfSampleStream.h"
#include "cslfDescription.h"
#include "vtkCSLFCornellBoxSource.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFSampler.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkSMPTools.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <limits>
#include <vector>

namespace cslf
{
namespace benchmarks
{
namespace
{
constexpr int Viewpoints = 17;
constexpr int Resolution = 128;
constexpr int Samples = 4;

/// The slab: viewpoints around the middle of the face that the box opens to.
constexpr int SlabSlices = 4;
constexpr int FrontFace = 4;

/// The side of a square with as many texels as a packet has rays: the renderer's blocks.
constexpr int BlockSide = 4;

/// The data that a ray query needs of a packet.
struct Rays
{
  float OriginX[RayPacket::Size];
  float OriginY[RayPacket::Size];
  float OriginZ[RayPacket::Size];
  float DirectionX[RayPacket::Size];
  float DirectionY[RayPacket::Size];
  float DirectionZ[RayPacket::Size];

  explicit Rays(const RayPacket& packet)
  {
    std::copy_n(packet.Query.ray.org_x, RayPacket::Size, this->OriginX);
    std::copy_n(packet.Query.ray.org_y, RayPacket::Size, this->OriginY);
    std::copy_n(packet.Query.ray.org_z, RayPacket::Size, this->OriginZ);
    std::copy_n(packet.Query.ray.dir_x, RayPacket::Size, this->DirectionX);
    std::copy_n(packet.Query.ray.dir_y, RayPacket::Size, this->DirectionY);
    std::copy_n(packet.Query.ray.dir_z, RayPacket::Size, this->DirectionZ);
  }
};

/// Adds a packet of rays.
void AddPacket(const RayGrid& grid, const SamplePlaces& places, std::vector<Rays>& rays)
{
  RayPacket packet;
  PacketScale scale;
  SetRays(grid, places.TileX, places.TileY, packet, scale);
  rays.emplace_back(packet);
}

/// The rays of a tile, in the renderer's packets: `Samples` per texel, with one packet for 2 x 2
/// texels, and one ray to each texel's centre for its depth.
void AddTileRays(const RayGrid& grid, int slice, int tile, std::vector<Rays>& rays)
{
  for (int row = 0; row < Resolution; row += BlockSide)
  {
    for (int column = 0; column < Resolution; column += BlockSide)
    {
      TexelPlaces texels;
      SamplePlaces centers;
      for (int texel = 0; texel < RayPacket::Size; ++texel)
      {
        const int x = column + TexelPlaces::GetColumn(texel);
        const int y = row + TexelPlaces::GetRow(texel);
        const auto scramble = SampleStream::MakeScramble(
          SampleStream::HashTexel(0, slice, tile * Resolution + x, y), Dimension::Pixel);
        texels.X[texel] = static_cast<float>(x);
        texels.Y[texel] = static_cast<float>(y);
        texels.Low[texel] = scramble.Low;
        texels.High[texel] = scramble.High;
        centers.TileX[texel] = texels.X[texel] + 0.5f;
        centers.TileY[texel] = texels.Y[texel] + 0.5f;
      }
      SamplePlaces places[Samples];
      FindPlaces(TexelGroup(RayPacket::Size / Samples), Samples, 0, texels, places);
      for (const SamplePlaces& packet : places)
      {
        AddPacket(grid, packet, rays);
      }
      AddPacket(grid, centers, rays);
    }
  }
}

/// Only the ray queries of the slab's rays.
class BareQueries
{
public:
  BareQueries(const BuiltScene& scene, const Layout& layout, const Cube& box, int firstSlice)
    : Device(rtcNewDevice(nullptr))
    , Tree(rtcNewScene(this->Device.get()))
  {
    for (const Mesh& mesh : scene.World->GetMeshes())
    {
      this->AddMesh(mesh);
    }
    rtcCommitScene(this->Tree.get());
    for (int slice = firstSlice; slice < firstSlice + SlabSlices; ++slice)
    {
      for (int tile = 0; tile < TileCount; ++tile)
      {
        AddTileRays(
          MakeFieldRays(layout, box, scene.Frame, slice, tile), slice, tile, this->Packets);
      }
    }
  }

  double CountRays() const { return static_cast<double>(this->Packets.size()) * RayPacket::Size; }

  /// The seconds for all queries on VTK's threads.
  double Measure()
  {
    std::atomic<long long> hits{ 0 };
    const auto start = std::chrono::steady_clock::now();
    vtkSMPTools::For(0, static_cast<vtkIdType>(this->Packets.size()),
      [&](vtkIdType begin, vtkIdType end) { hits += this->Intersect(begin, end); });
    const auto end = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(hits.load());
    return std::chrono::duration<double>(end - start).count();
  }

private:
  void AddMesh(const Mesh& mesh)
  {
    const EmbreeGeometry geometry(rtcNewGeometry(this->Device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    void* vertices = rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0,
      RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.Vertices.size());
    void* triangles = rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0,
      RTC_FORMAT_UINT3, sizeof(glm::uvec3), mesh.Triangles.size());
    std::memcpy(vertices, mesh.Vertices.data(), mesh.Vertices.size() * sizeof(glm::vec3));
    std::memcpy(triangles, mesh.Triangles.data(), mesh.Triangles.size() * sizeof(glm::uvec3));
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(this->Tree.get(), geometry.get());
  }

  /// The number of hits of a range of packets.
  long long Intersect(vtkIdType begin, vtkIdType end) const
  {
    alignas(64) int valid[RayPacket::Size];
    std::fill_n(valid, RayPacket::Size, -1);
    const EmbreeQuery query(Passing::ByChance);
    long long hits = 0;
    for (vtkIdType k = begin; k < end; ++k)
    {
      alignas(64) RTCRayHit16 rayHit;
      const Rays& rays = this->Packets[k];
      std::memcpy(rayHit.ray.org_x, rays.OriginX, sizeof(rays.OriginX));
      std::memcpy(rayHit.ray.org_y, rays.OriginY, sizeof(rays.OriginY));
      std::memcpy(rayHit.ray.org_z, rays.OriginZ, sizeof(rays.OriginZ));
      std::memcpy(rayHit.ray.dir_x, rays.DirectionX, sizeof(rays.DirectionX));
      std::memcpy(rayHit.ray.dir_y, rays.DirectionY, sizeof(rays.DirectionY));
      std::memcpy(rayHit.ray.dir_z, rays.DirectionZ, sizeof(rays.DirectionZ));
      std::fill_n(rayHit.ray.tnear, RayPacket::Size, 0.0f);
      std::fill_n(rayHit.ray.tfar, RayPacket::Size, std::numeric_limits<float>::infinity());
      std::fill_n(rayHit.ray.time, RayPacket::Size, 0.0f);
      std::fill_n(rayHit.ray.mask, RayPacket::Size, ~0u);
      std::fill_n(rayHit.ray.flags, RayPacket::Size, 0u);
      std::fill_n(rayHit.hit.geomID, RayPacket::Size, RTC_INVALID_GEOMETRY_ID);
      std::fill_n(rayHit.hit.instID[0], RayPacket::Size, RTC_INVALID_GEOMETRY_ID);
      EmbreeIntersect16(
        this->Tree.get(), GetPacketWidth(this->Device.get()), query, true, valid, rayHit);
      for (const unsigned int geometry : rayHit.hit.geomID)
      {
        hits += geometry != RTC_INVALID_GEOMETRY_ID;
      }
    }
    return hits;
  }

  EmbreeDevice Device;
  EmbreeScene Tree;
  std::vector<Rays> Packets;
};

void CompareCachedRendering(benchmark::State& state)
{
  // Prepare both sides. A first rendering fills the cache.
  vtkNew<vtkCSLFCornellBoxSource> box;
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputConnection(box->GetOutputPort());
  sampler->GetEnvironment()->SetModeToNone();
  sampler->SetViewpoints(Viewpoints);
  sampler->SetResolution(Resolution);
  sampler->SetSamples(Samples);
  const Layout layout(Viewpoints, Resolution);
  const int first = layout.SliceOf({ FrontFace, Viewpoints / 2, Viewpoints / 2 });
  int slab[6];
  layout.GetWholeExtent(slab);
  slab[4] = first;
  slab[5] = first + SlabSlices - 1;
  sampler->UpdateExtent(slab);
  SceneOptions options;
  options.FindScalars = [](vtkPolyData*, bool&) -> vtkDataArray* { return nullptr; };
  const BuiltScene scene = BuildScene({ box->GetOutputDataObject(0) }, options);
  BareQueries bare(scene, layout, Cube::FromBounds(scene.Bounds, sampler->GetOffset()), first);
  bare.Measure();

  // Measure them alternately.
  double bareSeconds = 0.0;
  double cachedSeconds = 0.0;
  for (auto _ : state)
  {
    bareSeconds += bare.Measure();
    sampler->Modified();
    sampler->UpdateExtent(slab);
    cachedSeconds += sampler->GetRenderSeconds();
    state.SetIterationTime(sampler->GetRenderSeconds());
  }
  const double rays = bare.CountRays() * static_cast<double>(state.iterations());
  state.counters["bare_rays_per_second"] = rays / bareSeconds;
  state.counters["cached_rays_per_second"] = rays / cachedSeconds;
  state.counters["ratio"] = bareSeconds / cachedSeconds;
}
}

void AddCachedRendering()
{
  benchmark::RegisterBenchmark("cached-rendering/cornell-box", CompareCachedRendering)
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();
}
}
}
