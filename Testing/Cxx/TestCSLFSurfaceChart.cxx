// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Charts of radiance caching: the triangles that share one, and a cost of the cache that depends on
// the area of a surface, not on the number or length of its triangles.
#include "PathTracing/RadianceCache/cslfLatticeLayout.h"
#include "cslfIntegratorComparison.h"
#include "cslfTestTransport.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFRadianceCacheOptions.h"

#include <vtkAppendPolyData.h>
#include <vtkCylinderSource.h>
#include <vtkDiskSource.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>

#include <cmath>

namespace
{
using Comparison = cslf::testing::IntegratorComparison;

constexpr float Spacing = 0.05f;

/// A spiral ramp of many small triangles.
cslf::Mesh MakeRamp(float pitch)
{
  cslf::Mesh mesh;
  mesh.Material = cslf::testing::MakeDiffuse(0.5f);
  constexpr int steps = 100;
  constexpr int turns = 4;
  constexpr int rings = 16;
  for (int i = 0; i <= turns * steps; ++i)
  {
    const float turn = static_cast<float>(i) / steps;
    const auto angle = static_cast<float>(2.0 * vtkMath::Pi() * turn);
    for (int ring = 0; ring <= rings; ++ring)
    {
      const float radius = 0.3f + 0.3f * static_cast<float>(ring) / rings;
      mesh.Vertices.emplace_back(
        radius * std::cos(angle), radius * std::sin(angle), pitch * (turn - 0.5f * turns));
    }
  }
  for (std::uint32_t i = 0; i < turns * steps; ++i)
  {
    for (std::uint32_t ring = 0; ring < rings; ++ring)
    {
      const std::uint32_t a = i * (rings + 1) + ring;
      const std::uint32_t b = a + rings + 1;
      mesh.Triangles.emplace_back(a, a + 1, b + 1);
      mesh.Triangles.emplace_back(a, b + 1, b);
    }
  }
  return mesh;
}

/// Each triangle is on one chart, and the chart maps back to the triangle's position in space.
void TestLayout(cslf::Mesh mesh, std::size_t mostCharts)
{
  const cslf::Scene scene({ std::move(mesh) }, cslf::testing::MakeUniformLight(1.0f));
  const cslf::OpenSides sides(scene, cslf::PathIntegrator(scene, {}), 0, Spacing);
  const cslf::LatticeLayout layout(scene, sides, Spacing);
  CSLF_CHECK(layout.GetSpacing() == Spacing);
  CSLF_CHECK(!layout.GetCharts().empty() && layout.GetCharts().size() <= mostCharts);
  const cslf::Mesh& surface = scene.GetMeshes()[0];
  std::size_t members = 0;
  for (const cslf::SurfaceChart& chart : layout.GetCharts())
  {
    members += chart.GetMembers().size();
    for (const cslf::SurfaceChart::Member& member : chart.GetMembers())
    {
      constexpr float third = 1.0f / 3.0f;
      const glm::vec2 place =
        third * (chart.GetPlace(member, 0) + chart.GetPlace(member, 1) + chart.GetPlace(member, 2));
      CSLF_CHECK(place.x >= 0.0f && place.x <= static_cast<float>(chart.GetColumns()));
      CSLF_CHECK(place.y >= 0.0f && place.y <= static_cast<float>(chart.GetRows()));
      const bool back = (member.Sides & 1) == 0;
      const glm::vec3 expected =
        surface.Interpolate(surface.Vertices, { member.Triangle, third, third });
      const glm::vec3 found = surface.Interpolate(surface.Vertices, chart.Find(back, place));
      CSLF_CHECK(glm::distance(found, expected) < 2.0f * Spacing);
      const glm::vec2 corners[3] = { place, place + glm::vec2(1e-3f, 0.0f),
        place + glm::vec2(0.0f, 1e-3f) };
      CSLF_CHECK(chart.Overlaps(back, corners));
    }
  }
  CSLF_CHECK(members == surface.Triangles.size());
}

/// The cost of the cache of a scene under light from above, and the quality of its picture.
struct Cost
{
  double Rays;
  double PSNR;
};

Cost Measure(vtkPolyData* scene, double y)
{
  Comparison comparison(scene, 0.5 * y, y, 2.0 * y);
  for (vtkCSLFViewTracer* tracer : { comparison.Reference.Get(), comparison.Cached.Get() })
  {
    tracer->GetEnvironment()->SetModeToGradient();
  }
  comparison.Cached->GetCacheOptions()->SetSpacing(0.01);
  comparison.Cached->GetCacheOptions()->SetTolerance(0.005);
  const double psnr = comparison.GetPSNR();
  return { static_cast<double>(comparison.Cached->GetNumberOfCacheRays()), psnr };
}

/// Many thin triangles cost little more than few.
void CheckRefined(vtkPolyData* coarse, vtkPolyData* fine, double distance)
{
  const Cost few = Measure(coarse, distance);
  const Cost many = Measure(fine, distance);
  std::cout << "rays " << few.Rays << ", " << many.Rays << ", PSNR " << few.PSNR << ", "
            << many.PSNR << " dB\n";
  CSLF_CHECK(many.Rays < 1.5 * few.Rays);
  CSLF_CHECK(many.PSNR > 40.0 && many.PSNR > few.PSNR - 1.0);
}

void TestCylinders()
{
  vtkNew<vtkCylinderSource> coarse;
  vtkNew<vtkCylinderSource> fine;
  coarse->SetResolution(64);
  fine->SetResolution(2000);
  for (vtkCylinderSource* cylinder : { coarse.Get(), fine.Get() })
  {
    cylinder->SetHeight(10.0);
    cylinder->Update();
  }
  CheckRefined(coarse->GetOutput(), fine->GetOutput(), 8.0);
}

void TestFans()
{
  vtkNew<vtkPolyData> disks[2];
  for (const int index : { 0, 1 })
  {
    vtkNew<vtkDiskSource> disk;
    disk->SetCircumferentialResolution(index == 0 ? 64 : 4000);
    vtkNew<vtkTriangleFilter> triangles;
    triangles->SetInputConnection(disk->GetOutputPort());
    triangles->Update();
    disks[index]->ShallowCopy(triangles->GetOutput());
  }
  CheckRefined(disks[0], disks[1], 0.8);
}

/// A wavy sheet of small triangles, flat and smooth.
void TestSheets()
{
  vtkNew<vtkPolyData> sheets[2];
  for (const int index : { 0, 1 })
  {
    vtkNew<vtkPlaneSource> plane;
    plane->SetResolution(index == 0 ? 50 : 250, index == 0 ? 50 : 250);
    plane->SetPoint1(0.5, 0.0, 0.5);
    plane->SetOrigin(-0.5, 0.0, 0.5);
    plane->SetPoint2(-0.5, 0.0, -0.5);
    vtkNew<vtkTriangleFilter> triangles;
    triangles->SetInputConnection(plane->GetOutputPort());
    triangles->Update();
    sheets[index]->DeepCopy(triangles->GetOutput());
    sheets[index]->GetPointData()->Initialize();
    vtkPoints* points = sheets[index]->GetPoints();
    for (vtkIdType id = 0; id < points->GetNumberOfPoints(); ++id)
    {
      double* point = points->GetPoint(id);
      points->SetPoint(
        id, point[0], 0.1 * std::sin(9.0 * point[0]) * std::cos(7.0 * point[2]), point[2]);
    }
  }
  CheckRefined(sheets[0], sheets[1], 0.6);
}

/// Opaque triangles at the same place cost nothing, however many: those of tubes around lines that
/// stand still.
void TestCopies()
{
  vtkNew<vtkCylinderSource> cylinder;
  cylinder->SetResolution(16);
  vtkNew<vtkAppendPolyData> copies;
  for (int i = 0; i < 20; ++i)
  {
    copies->AddInputConnection(cylinder->GetOutputPort());
  }
  copies->Update();
  const Cost one = Measure(cylinder->GetOutput(), 2.0);
  const Cost many = Measure(copies->GetOutput(), 2.0);
  std::cout << "rays " << one.Rays << ", " << many.Rays << "\n";
  CSLF_CHECK(one.Rays == many.Rays && one.PSNR == many.PSNR);
}
}

int TestCSLFSurfaceChart(int, char*[])
{
  TestLayout(MakeRamp(0.2f), 200);
  TestLayout(MakeRamp(0.0f), 20); // four layers at one place
  TestCylinders();
  TestFans();
  TestSheets();
  TestCopies();
  return cslf::testing::Result();
}
