// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Radiance caching: lattices hold what they are given and grow where they must; the cached light is
// that of path tracing, for diffuse, glossy and mirror surfaces, at every depth, on both sides.
#include "PathTracing/RadianceCache/cslfLatticeBuilder.h"
#include "PathTracing/RadianceCache/cslfRadianceCache.h"
#include "PathTracing/RadianceCache/cslfSurfaceLattice.h"
#include "cslfIntegratorComparison.h"
#include "cslfTestTransport.h"
#include "vtkCSLFCornellBoxSource.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFViewTracer.h"

#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMinimalStandardRandomSequence.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSphereSource.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace
{
using Comparison = cslf::testing::IntegratorComparison;
using cslf::testing::MakeDiffuse;
using cslf::testing::MakeRectangle;

glm::vec3 Linear(float u, float v)
{
  return { 1.0f + 2.0f * u - 3.0f * v, u, 5.0f * v };
}

/// Fills a brick with a function of its triangle's coordinates.
void Fill(cslf::SurfaceLattice& lattice, std::size_t brick, std::uint32_t level,
  const glm::vec2& corner, float size)
{
  const int splits = 1 << level;
  std::vector<glm::vec3> values;
  for (int j = 0; j <= splits; ++j)
  {
    for (int i = 0; i <= splits - j; ++i)
    {
      const glm::vec2 point = corner + size * glm::vec2(i, j) / static_cast<float>(splits);
      values.push_back(Linear(point.x, point.y));
    }
  }
  lattice.SetBrick(brick, level, values);
}

/// A linear function must come back exactly, through bricks of any level and parts of bricks.
void TestLattice()
{
  cslf::SurfaceLattice lattice({ 1, 0 });
  CSLF_CHECK(lattice.GetNumberOfTriangles() == 2 && lattice.GetNumberOfRoots() == 2 * 4 + 2);
  for (const bool back : { false, true })
  {
    Fill(lattice, lattice.GetBrickIndex(0, back, 0), 0, { 0.0f, 0.0f }, 0.5f);
    Fill(lattice, lattice.GetBrickIndex(0, back, 1), 2, { 0.5f, 0.5f }, -0.5f);
    Fill(lattice, lattice.GetBrickIndex(0, back, 2), 1, { 0.5f, 0.0f }, 0.5f);
    const std::size_t parts = lattice.SplitBrick(lattice.GetBrickIndex(0, back, 3));
    Fill(lattice, parts, 0, { 0.0f, 0.5f }, 0.25f);
    Fill(lattice, parts + 1, 1, { 0.25f, 0.75f }, -0.25f);
    Fill(lattice, parts + 2, 2, { 0.25f, 0.5f }, 0.25f);
    Fill(lattice, parts + 3, 0, { 0.0f, 0.75f }, 0.25f);
  }
  vtkNew<vtkMinimalStandardRandomSequence> random;
  float worst = 0.0f;
  for (int i = 0; i < 10000; ++i)
  {
    auto u = static_cast<float>(random->GetNextRangeValue(0.0, 1.0));
    auto v = static_cast<float>(random->GetNextRangeValue(0.0, 1.0));
    if (u + v > 1.0f)
    {
      u = 1.0f - u;
      v = 1.0f - v;
    }
    worst = std::max(worst, glm::distance(lattice.Get(0, i % 2 == 1, u, v), Linear(u, v)));
    CSLF_CHECK(lattice.Get(1, i % 2 == 1, u, v) == glm::vec3(0.0f));
  }
  CSLF_CHECK(worst < 1e-5f);
}

/// Estimates of a function that is known.
class ExactEstimator : public cslf::SurfaceEstimator
{
public:
  explicit ExactEstimator(std::function<glm::vec3(const cslf::Hit&)> value)
    : Value(std::move(value))
  {
  }

  std::vector<cslf::SurfaceEstimate> Estimate(const Request& request) override
  {
    std::vector<cslf::SurfaceEstimate> estimates;
    for (const cslf::SurfacePoint& point : request.Points)
    {
      estimates.emplace_back(this->Value(point.Place));
    }
    return estimates;
  }

private:
  std::function<glm::vec3(const cslf::Hit&)> Value;
};

/// A lattice of an edge between light and shadow: right beside the edge, and with few points.
void TestRefinement()
{
  const cslf::Scene scene({ MakeRectangle(glm::vec3(0.0f), { 1.0f, 0.0f, 0.0f },
                            { 0.0f, 1.0f, 0.0f }, MakeDiffuse(1.0f)) },
    cslf::LightSet());
  const cslf::OpenSides sides(scene, cslf::PathIntegrator(scene, {}), 0, 0.01f);
  const cslf::LatticeLayout layout(scene, sides, 0.01f);
  const auto getLight = [](const glm::vec3& point, float brightness)
  {
    const bool lit = point.x + 0.3f * point.y > 0.123f;
    return glm::vec3(lit ? brightness * (1.0f - 0.2f * point.y * point.y) : 0.0f);
  };
  cslf::LatticeSettings settings;
  settings.Tolerance = 0.01f;
  settings.FirstLevel = 1;
  const auto getPosition = [&scene](const cslf::Hit& place)
  {
    const cslf::Mesh& mesh = scene.GetMeshes()[place.Mesh];
    return mesh.Interpolate(mesh.Vertices, place.GetPlace());
  };
  for (const float brightness : { 1.0f, 20.0f })
  {
    int calls = 0;
    ExactEstimator estimator(
      [&](const cslf::Hit& place)
      {
        ++calls;
        return place.Back ? glm::vec3(0.5f) : getLight(getPosition(place), brightness);
      });
    cslf::LatticeBuilder builder(scene, sides, layout, settings, estimator);
    CSLF_CHECK(builder.Build([](double) { return true; }));
    CSLF_CHECK(builder.GetNumberOfEstimates() == static_cast<std::size_t>(calls));
    // A grid of this spacing would have 80000 points on two sides. Bright light needs finer edges.
    CSLF_CHECK(calls < (brightness > 1.0f ? 60000 : 12000));

    const cslf::SurfaceLattice lattice = builder.TakeLattice();
    double farError = 0.0;
    double bleeding = 0.0;
    vtkNew<vtkMinimalStandardRandomSequence> random;
    constexpr int count = 20000;
    for (int i = 0; i < count; ++i)
    {
      cslf::Hit place;
      place.Mesh = 0;
      place.Triangle = i % 2;
      place.U = static_cast<float>(random->GetNextRangeValue(0.0, 0.5));
      place.V = static_cast<float>(random->GetNextRangeValue(0.0, 0.5));
      const glm::vec3 point = getPosition(place);
      const float error =
        lattice.Get(place.Triangle, false, place.U, place.V).x - getLight(point, brightness).x;
      const float toEdge = std::abs(point.x + 0.3f * point.y - 0.123f);
      farError = std::max<double>(farError, toEdge > 0.02f ? std::abs(error) : 0.0);
      bleeding += std::abs(error) / count;
      CSLF_CHECK(lattice.Get(place.Triangle, true, place.U, place.V).x == 0.5f);
    }
    CSLF_CHECK(farError < 0.01 * brightness);
    // The width of the edge shrinks as the light grows.
    CSLF_CHECK(bleeding < 0.006);
  }

  // Abort.
  ExactEstimator dark([](const cslf::Hit&) { return glm::vec3(0.0f); });
  cslf::LatticeBuilder aborted(scene, sides, layout, settings, dark);
  CSLF_CHECK(!aborted.Build([](double) { return false; }));
}

/// Keys of points differ, however many triangles and charts there are and however long a chart is.
void TestKeys()
{
  using Builder = cslf::LatticeBuilder;
  constexpr std::size_t one = 1;
  std::set<std::uint64_t> keys;
  std::size_t count = 0;
  // 26 bits are for triangles and sides.
  for (const std::size_t domain : { 0 * one, one, (one << 25) - 1, one << 25, (one << 25) + 1,
         one << 26, one << 27, one << 28, one << 31 })
  {
    for (const int column : { 0, 1, 1 << 17, 1 << 18, 1 << 19 })
    {
      for (const int row : { 0, 1, 1 << 17, 1 << 18 })
      {
        for (const bool back : { false, true })
        {
          for (const bool isMean : { false, true })
          {
            const std::uint64_t key = Builder::MakeKey(domain, back, column, row, isMean);
            keys.insert(key);
            ++count;
            // 2 is for those of vertices, and 3 for hashes.
            const bool isSmall = domain < (one << 25) && column < 1 << 18 && row < 1 << 18;
            CSLF_CHECK(key >> 62 == (isSmall ? (isMean ? 1u : 0u) : 3u));
          }
        }
      }
    }
  }
  CSLF_CHECK(keys.size() == count);
  // The noise of scenes depends on them.
  CSLF_CHECK(Builder::MakeKey(5, true, 3, 2, false) == 0xb000080003u);

  // Indices of bricks and values have 31 bits.
  cslf::SurfaceLattice::RequireIndex(0x7fffffff);
  std::string reason;
  try
  {
    cslf::SurfaceLattice::RequireIndex(0x80000000);
  }
  catch (const std::length_error& error)
  {
    reason = error.what();
  }
  CSLF_CHECK(reason.find("use path tracing") != std::string::npos);
}

/// A bumpy sheet of many triangles.
cslf::Mesh MakeSheet(std::uint32_t width)
{
  cslf::Mesh mesh;
  mesh.Material = MakeDiffuse(0.5f);
  const auto scale = 1.0f / static_cast<float>(width);
  for (std::uint32_t row = 0; row <= width; ++row)
  {
    for (std::uint32_t column = 0; column <= width; ++column)
    {
      const float x = scale * static_cast<float>(column);
      const float y = scale * static_cast<float>(row);
      mesh.Vertices.emplace_back(x, y, 0.02f * std::sin(40.0f * x) * std::sin(40.0f * y));
      const std::uint32_t corner = row * (width + 1) + column;
      if (row < width && column < width)
      {
        mesh.Triangles.emplace_back(corner, corner + 1, corner + width + 1);
        mesh.Triangles.emplace_back(corner + 1, corner + width + 2, corner + width + 1);
      }
    }
  }
  return mesh;
}

/// Finding where light is to be stored takes long if there are many triangles. It reports its
/// progress meanwhile, and ends as soon as it shall.
void TestLayoutProgress()
{
  const cslf::Scene scene({ MakeSheet(200) }, cslf::LightSet());
  cslf::CacheSettings settings;
  settings.Paths.MaximumDepth = 0; // no light, so that there is no other work
  std::vector<double> reports;
  std::size_t most = 1000000;
  const auto goOn = [&reports, &most](double progress)
  {
    reports.push_back(progress);
    return reports.size() < most;
  };
  CSLF_CHECK(cslf::RadianceCache(scene, settings).Build(goOn));
  // At most 4000 of the 80000 triangles between two reports.
  std::cout << reports.size() << " reports\n";
  CSLF_CHECK(reports.size() > 20);
  CSLF_CHECK(std::is_sorted(reports.begin(), reports.end()));
  CSLF_CHECK(std::set<double>(reports.begin(), reports.end()).size() > 20);
  for (const std::size_t end : { 1, 5, 20 })
  {
    reports.clear();
    most = end;
    CSLF_CHECK(!cslf::RadianceCache(scene, settings).Build(goOn));
    CSLF_CHECK(reports.size() == end);
  }
}

void TestDepths()
{
  vtkNew<vtkCSLFCornellBoxSource> box;
  box->Update();
  Comparison comparison(box->GetOutput(), 0.4, 0.2, 4.0);
  for (vtkCSLFViewTracer* tracer : { comparison.Reference.Get(), comparison.Cached.Get() })
  {
    tracer->GetEnvironment()->SetModeToNone();
  }
  for (const int depth : { 0, 1, 2, 8 })
  {
    comparison.Reference->SetMaximumDepth(depth);
    comparison.Cached->SetMaximumDepth(depth);
    CSLF_CHECK(comparison.GetPSNR() > 40.0);
  }
  CSLF_CHECK(comparison.Cached->GetNumberOfCacheRays() > 0);
  CSLF_CHECK(comparison.Cached->GetNumberOfCachePoints() > 0);

  // The cache is kept while only the rest changes.
  const vtkTypeUInt64 points = comparison.Cached->GetNumberOfCachePoints();
  comparison.Cached->SetSamples(1);
  comparison.Cached->Update();
  CSLF_CHECK(comparison.Cached->GetNumberOfCacheRays() == 0);
  CSLF_CHECK(comparison.Cached->GetNumberOfCachePoints() == points);
}

/// No light is gathered on surfaces that only shine.
void TestBlack()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(32);
  sphere->SetPhiResolution(32);
  sphere->Update();
  vtkTypeUInt64 rays[2];
  for (const bool isBlack : { false, true })
  {
    vtkCSLFMaterial::SetEmission(sphere->GetOutput(), 0.5, 0.5, 0.5);
    const double color = isBlack ? 0.0 : 0.5;
    vtkCSLFMaterial::SetBaseColor(sphere->GetOutput(), color, color, color);
    Comparison comparison(sphere->GetOutput(), 0.4, 0.2, 3.0);
    CSLF_CHECK(comparison.GetPSNR() > 45.0);
    rays[isBlack ? 1 : 0] = comparison.Cached->GetNumberOfCacheRays();
  }
  std::cout << "rays for a shining sphere " << rays[0] << ", for a black one " << rays[1] << "\n";
  CSLF_CHECK(rays[1] < rays[0] / 10);
}

/// Diffuse, glossy and mirror surfaces.
void TestMaterials()
{
  for (const double metallic : { 0.0, 0.5, 1.0 })
  {
    for (const double roughness : { 0.0, 0.4 })
    {
      vtkNew<vtkCSLFCornellBoxSource> box;
      box->Update();
      auto* block = vtkPolyData::SafeDownCast(box->GetOutput()->GetBlock(6));
      vtkCSLFMaterial::SetIndexOfRefraction(block, 1.5);
      vtkCSLFMaterial::SetMetallic(block, metallic);
      vtkCSLFMaterial::SetRoughness(block, roughness);
      Comparison comparison(box->GetOutput(), 0.4, 0.2, 4.0);
      // With 256 samples, most of the difference would be noise of the reference.
      comparison.Reference->SetSamples(1024);
      std::cout << "metallic " << metallic << ", roughness " << roughness << ": "
                << comparison.GetPSNR() << " dB\n";
      CSLF_CHECK(comparison.GetPSNR() > 38.0);
    }
  }
}

/// A convex body under uniform light is uniform, smooth or flat, and the noise target is kept.
void TestUniform()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(32);
  sphere->SetPhiResolution(16);
  sphere->Update();
  for (const bool smooth : { true, false })
  {
    if (!smooth)
    {
      sphere->GetOutput()->GetPointData()->SetNormals(nullptr);
    }
    Comparison comparison(sphere->GetOutput(), 0.0, 0.0, 2.0);
    comparison.Cached->SetColorType(VTK_FLOAT);
    comparison.Cached->Update();
    vtkDataArray* colors = comparison.Cached->GetOutput()->GetPointData()->GetScalars();
    const vtkIdType center = 16 * 32 + 16;
    const double albedo = std::pow((0.8 + 0.055) / 1.055, 2.4);
    const double tolerance = smooth ? 0.01 : 1e-4;
    CSLF_CHECK_NEAR(colors->GetComponent(center, 1), albedo, tolerance);
    comparison.Cached->SetNoiseTarget(0.01);
    comparison.Cached->Update();
    CSLF_CHECK(comparison.Cached->GetNumberOfRays() < 64u * 32u * 32u / 2u);
  }
}

/// The same values for any number of threads.
void TestDeterminism()
{
  vtkNew<vtkCSLFCornellBoxSource> box;
  box->Update();
  vtkNew<vtkImageData> pictures[2];
  for (int i = 0; i < 2; ++i)
  {
    vtkSMPTools::Initialize(i + 1);
    Comparison comparison(box->GetOutput(), 0.4, 0.2, 4.0);
    comparison.Cached->SetColorType(VTK_FLOAT);
    comparison.Cached->Update();
    pictures[i]->DeepCopy(comparison.Cached->GetOutput());
  }
  vtkSMPTools::Initialize(0);
  vtkDataArray* first = pictures[0]->GetPointData()->GetScalars();
  vtkDataArray* second = pictures[1]->GetPointData()->GetScalars();
  bool equal = true;
  for (vtkIdType i = 0; i < first->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < 4; ++c)
    {
      equal = equal && first->GetComponent(i, c) == second->GetComponent(i, c);
    }
  }
  CSLF_CHECK(equal);
}
}

int TestCSLFRadianceCache(int, char*[])
{
  TestLattice();
  TestRefinement();
  TestKeys();
  TestLayoutProgress();
  TestDepths();
  TestBlack();
  TestMaterials();
  TestUniform();
  TestDeterminism();
  return cslf::testing::Result();
}
