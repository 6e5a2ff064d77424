// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfOpenSides.h"

#include "PathTracing/cslfSampling.h"

#include <vtkSMPTools.h>

#include <glm/common.hpp>

#include <atomic>

namespace cslf
{
namespace
{
// Walks from each side, until one leads out. Where one in a hundred would, as into a body through a
// small hole, most sides are left to path tracing, which then seldom needs them.
constexpr std::uint32_t Walks = 16;

// The surfaces that a walk comes to.
constexpr int Steps = 4;

/// A walk over surfaces that are white, so that it ends nowhere by chance.
class Walk
{
public:
  Walk(const Scene& scene, const PathIntegrator& paths, const SampleStream& stream)
    : World(scene)
    , Paths(paths)
    , Stream(stream)
  {
  }

  /// Whether it finds a way out, or light.
  bool Escapes(Hit hit, std::uint64_t& rays)
  {
    SurfaceHit surface = this->World.GetSurface(hit);
    glm::vec3 outgoing = surface.GeometricNormal;
    for (int step = 0; step < Steps; ++step)
    {
      if (surface.Material->IsEmissive())
      {
        return true;
      }
      this->Stream.NextVertex();
      MaterialPoint point = surface.GetMaterialPoint();
      point.BaseColor = glm::vec3(1.0f);
      const Frame frame(surface.ShadingNormal);
      const BSDF bsdf(*surface.Material, point, frame.ToLocal(outgoing), surface.Inside);
      const ScatteringPoint lit{ surface, frame, bsdf, Lobes::All };
      BSDFSample sample;
      if (this->Paths.GetLight().Sample(lit, this->Stream, rays) != glm::vec3(0.0f))
      {
        return true;
      }
      if (!bsdf.Sample(
            this->Stream.Get1D(Dimension::Lobe), this->Stream.Get2D(Dimension::Direction), sample))
      {
        return false;
      }
      const Ray ray{ surface.GetStart(sample.Direction.z), frame.ToWorld(sample.Direction) };
      ++rays;
      hit = this->World.Intersect(ray);
      if (!hit.IsValid())
      {
        return true;
      }
      surface = this->World.GetSurface(ray, hit);
      outgoing = -ray.Direction;
    }
    return false;
  }

private:
  const Scene& World;
  const PathIntegrator& Paths;
  SampleStream Stream;
};

bool IsOpen(const Scene& scene, const PathIntegrator& paths, Hit place, std::uint64_t hash,
  std::uint64_t& rays)
{
  for (std::uint32_t i = 0; i < Walks; ++i)
  {
    const SampleStream stream(hash, i);
    const glm::vec2 point = SampleTriangle(stream.Get2D(Dimension::Pixel));
    place.U = point.x;
    place.V = point.y;
    if (Walk(scene, paths, stream).Escapes(place, rays))
    {
      return true;
    }
  }
  return false;
}
}

OpenSides::OpenSides(const Scene& scene, const PathIntegrator& paths, std::uint32_t seed)
{
  std::atomic<std::uint64_t> allRays{ 0 };
  for (std::uint32_t index = 0; index < scene.GetMeshes().size(); ++index)
  {
    const Mesh& mesh = scene.GetMeshes()[index];
    if (!mesh.CanHoldLattice())
    {
      continue;
    }
    const std::size_t first = this->Sides.size();
    this->Sides.resize(first + mesh.Triangles.size(), 0);
    vtkSMPTools::For(0, static_cast<vtkIdType>(mesh.Triangles.size()),
      [&](vtkIdType begin, vtkIdType end)
      {
        std::uint64_t rays = 0;
        for (vtkIdType i = begin; i < end; ++i)
        {
          for (const bool back : { false, true })
          {
            Hit place;
            place.Mesh = index;
            place.Triangle = static_cast<std::uint32_t>(i);
            place.Back = back;
            const std::uint64_t hash = MixBits(2 * (first + i) + (back ? 1 : 0), seed);
            if (IsOpen(scene, paths, place, hash, rays))
            {
              this->Sides[first + i] |= back ? Back : Front;
            }
          }
        }
        allRays += rays;
      });
  }
  this->Rays = allRays;
}
}
