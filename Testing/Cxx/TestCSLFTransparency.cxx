// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Opacity and glass, compared with closed forms.
#include "PathTracing/Materials/cslfGGX.h"
#include "PathTracing/Texels/cslfTexelRenderer.h"
#include "RandomNumbers/cslfSampling.h"
#include "cslfTestTransport.h"
#include "cslfTesting.h"

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkUnsignedShortArray.h>

#include <cmath>
#include <utility>
#include <vector>

namespace
{
using namespace cslf::testing;

cslf::SurfaceMaterial MakeGlass(float ior, float roughness, float base = 1.0f)
{
  cslf::SurfaceMaterial material(glm::vec3(base), 0.0f, roughness, ior, Dark);
  material.Transmission = 1.0f;
  return material;
}

/// A sphere of radius 1 as triangles, counterclockwise from outside, with exact normals.
cslf::Mesh MakeSphere(const cslf::SurfaceMaterial& material)
{
  constexpr int rings = 64;
  constexpr int sectors = 128;
  cslf::Mesh mesh;
  for (int i = 0; i <= rings; ++i)
  {
    for (int j = 0; j < sectors; ++j)
    {
      const float theta = cslf::Pi * i / rings;
      const float phi = 2.0f * cslf::Pi * j / sectors;
      mesh.Vertices.emplace_back(
        std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    }
  }
  for (std::uint32_t i = 0; i < rings; ++i)
  {
    for (std::uint32_t j = 0; j < sectors; ++j)
    {
      const std::uint32_t a = i * sectors + j;
      const std::uint32_t b = i * sectors + (j + 1) % sectors;
      mesh.Triangles.emplace_back(a, a + sectors, b + sectors);
      mesh.Triangles.emplace_back(a, b + sectors, b);
    }
  }
  mesh.Normals = mesh.Vertices;
  mesh.Material = material;
  return mesh;
}

/// Coverage, radiance and depth of one texel that faces down at the origin.
struct Texel
{
  float Color[4];
  unsigned short Depth;
};

Texel Render(const cslf::Scene& scene, int samples)
{
  cslf::RenderSettings settings;
  settings.Samples = samples;
  settings.Paths.MaximumDepth = 1;
  cslf::RayGrid grid;
  grid.Origin = { -0.05, -0.05, 2.0 };
  grid.OriginX = { 0.1, 0.0, 0.0 };
  grid.OriginY = { 0.0, 0.1, 0.0 };
  grid.Direction = { 0.0, 0.0, -4.0 };
  vtkNew<vtkFloatArray> color;
  color->SetNumberOfComponents(4);
  color->SetNumberOfTuples(1);
  vtkNew<vtkUnsignedShortArray> depth;
  depth->SetNumberOfTuples(1);
  cslf::ViewpointSamples output;
  output.SetArray(cslf::KnownChannel::Color, color);
  output.SetArray(cslf::KnownChannel::Depth, depth);
  const cslf::PictureLayout layout{ 1, 1, 1, 0, 1 };
  const cslf::TexelRenderer renderer(
    scene, layout, settings, [&grid](int, int) { return grid; }, output);
  CSLF_CHECK(renderer.Render([](double) { return true; }));
  Texel texel{};
  color->GetTypedTuple(0, texel.Color);
  texel.Depth = depth->GetValue(0);
  return texel;
}

double ToDepth(double z)
{
  return 65535.0 * (2.0 - z) / 4.0;
}

void TestCoverage()
{
  // One sheet, and two of them: opacities are probabilities.
  constexpr int samples = 1 << 14;
  const double error = 4.0 * 0.5 / std::sqrt(samples);
  for (float opacity : { 0.0f, 0.25f, 0.6f, 1.0f })
  {
    cslf::SurfaceMaterial upper = MakeDiffuse(0.8f);
    upper.Opacity = opacity;
    std::vector<cslf::Mesh> meshes;
    meshes.push_back(MakeRectangle({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, upper));
    const cslf::Scene one(meshes, MakeUniformLight(1.0f));
    const Texel single = Render(one, samples);
    CSLF_CHECK_NEAR(single.Color[3], opacity, opacity * (1.0f - opacity) > 0.0f ? error : 0.0);
    CSLF_CHECK_NEAR(single.Color[0], 0.8 * single.Color[3], 1e-3);
    CSLF_CHECK_NEAR(single.Depth, opacity > 0.0f ? ToDepth(1.0) : 65535.0, 1.0);

    cslf::SurfaceMaterial lower = MakeDiffuse(0.0f);
    lower.Opacity = 0.5f;
    meshes.push_back(MakeRectangle({ 0, 0, -1 }, { 1, 0, 0 }, { 0, 1, 0 }, lower));
    const cslf::Scene two(meshes, MakeUniformLight(1.0f));
    const Texel both = Render(two, samples);
    CSLF_CHECK_NEAR(both.Color[3], 1.0 - 0.5 * (1.0 - opacity), error);
    // The depth is that of the first surface with a coverage of at least a half.
    CSLF_CHECK_NEAR(both.Depth, ToDepth(opacity >= 0.5f ? 1.0 : -1.0), 1.0);
  }

  // Without such a surface, it is that of the last one: those in front count as air everywhere.
  std::vector<cslf::Mesh> veils;
  for (const float z : { 0.5f, -1.0f, 1.0f })
  {
    cslf::SurfaceMaterial veil = MakeDiffuse(0.8f);
    veil.Opacity = 0.4f;
    veils.push_back(MakeRectangle({ 0, 0, z }, { 1, 0, 0 }, { 0, 1, 0 }, veil));
  }
  CSLF_CHECK_NEAR(Render(cslf::Scene(veils, MakeUniformLight(1.0f)), 16).Depth, ToDepth(-1.0), 1.0);

  // A cut-off makes opacities 0 or 1.
  for (float cutoff : { 0.2f, 0.3f })
  {
    cslf::SurfaceMaterial material = MakeDiffuse(0.8f);
    material.Opacity = 0.25f;
    material.OpacityCutoff = cutoff;
    std::vector<cslf::Mesh> meshes;
    meshes.push_back(MakeRectangle({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, material));
    meshes.push_back(MakeRectangle({ 3, 0, -1 }, { 1, 0, 0 }, { 0, 1, 0 }, MakeDiffuse(1.0f)));
    const cslf::Scene scene(meshes, MakeUniformLight(1.0f));
    CSLF_CHECK(Render(scene, 16).Color[3] == (cutoff < 0.25f ? 1.0f : 0.0f));
  }
}

void TestShadows()
{
  // Two sheets between a point light and a surface attenuate it without noise; glass blocks it.
  cslf::LightSet lights;
  lights.Points.push_back({ { 0, 0, 3 }, glm::vec3(9.0f) });
  const auto trace = [&lights](const cslf::SurfaceMaterial& material)
  {
    std::vector<cslf::Mesh> meshes;
    meshes.push_back(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, MakeDiffuse(0.5f)));
    for (float height : { 1.0f, 2.0f })
    {
      meshes.push_back(
        MakeRectangle({ 0.05f, 0.02f, height }, { 0.3f, 0, 0 }, { 0, 0.3f, 0 }, material));
    }
    const cslf::Scene scene(std::move(meshes), lights);
    cslf::PathSettings direct;
    direct.MaximumDepth = 1;
    return Trace(scene, LookAt({ 0.8f, 0, 0.1f }, Dark), direct, 16);
  };
  for (float opacity : { 0.0f, 0.3f, 1.0f })
  {
    cslf::SurfaceMaterial material = MakeDiffuse(0.8f);
    material.Opacity = opacity;
    const Estimate estimate = trace(material);
    CSLF_CHECK_NEAR(estimate.Mean, 0.5 / cslf::Pi * (1.0 - opacity) * (1.0 - opacity), 1e-4);
    CSLF_CHECK_NEAR(estimate.Error, 0.0, 1e-6);
  }
  CSLF_CHECK(trace(MakeGlass(1.5f, 0.0f)).Mean == 0.0);
}

cslf::Mesh MakeRound(bool isTube, const cslf::SurfaceMaterial& material)
{
  cslf::Mesh mesh;
  mesh.Shape = isTube ? cslf::Mesh::Shapes::Tubes : cslf::Mesh::Shapes::Spheres;
  mesh.Vertices = { { 0, 0, 1 } };
  mesh.Radii = { 0.4f };
  if (isTube)
  {
    mesh.Vertices.emplace_back(0.2f, 0.9f, 1.0f);
    mesh.Radii.push_back(0.3f);
  }
  mesh.Material = material;
  return mesh;
}

void TestRoundShapes()
{
  // A sphere or a tube is one surface: the light that passes it agrees with its alpha, in all its
  // instances. A lamp inside is behind one surface, too.
  for (const bool isTube : { false, true })
  {
    for (const bool isInstance : { false, true })
    {
      for (const float opacity : { 0.25f, 0.6f, 1.0f })
      {
        cslf::SurfaceMaterial material = MakeDiffuse(0.0f);
        material.Opacity = opacity;
        cslf::Mesh round = MakeRound(isTube, material);
        if (isInstance)
        {
          cslf::MeshInstance instance;
          instance.Linear = { { 0.8f, 0.1f, 0 }, { 0, 1.1f, 0 }, { 0, 0.2f, 0.7f } };
          instance.Offset = { 0.02f, -0.2f, 0.3f };
          round.Instances = { instance };
        }
        std::vector<cslf::Mesh> meshes;
        meshes.push_back(MakeRectangle({ 0, 0, 0 }, { 3, 0, 0 }, { 0, 3, 0 }, MakeDiffuse(0.5f)));
        meshes.push_back(round);
        for (const float height : { 3.0f, 1.0f })
        {
          cslf::LightSet lights;
          lights.Points.push_back({ { 0, 0, height }, glm::vec3(height * height) });
          const cslf::Scene scene(meshes, lights);
          cslf::PathSettings direct;
          direct.MaximumDepth = 1;
          const Estimate lit = Trace(scene, LookAt({ 0.9f, 0, 0.1f }, Dark), direct, 16);
          CSLF_CHECK_NEAR(lit.Mean, 0.5 / cslf::Pi * (1.0 - opacity), 1e-4);
        }
        const cslf::Scene alone({ round }, {});
        constexpr int samples = 1 << 12;
        CSLF_CHECK_NEAR(Render(alone, samples).Color[3], opacity, 4.0 * 0.5 / std::sqrt(samples));
      }
    }
  }
}

/// Instances too small for floats to distinguish their corners, under an environment image: no
/// direction becomes NaN.
void TestTinyInstances()
{
  cslf::EnvironmentImage pixels{ 16, 8, std::vector<glm::vec3>(128, glm::vec3(0.5f)) };
  cslf::LightSet lights;
  lights.Surroundings = { pixels, 1.0f, cslf::EnvironmentAxes() };
  for (const float size : { 1e-6f, 1e-9f, 1e-14f, 1e-20f, 1e-30f })
  {
    std::vector<cslf::Mesh> meshes;
    meshes.push_back(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, MakeDiffuse(0.5f, 1.0f)));
    meshes.push_back(MakeRound(false, MakeDiffuse(0.5f, 1.0f)));
    meshes.push_back(MakeRound(true, MakeDiffuse(0.5f, 1.0f)));
    for (cslf::Mesh& mesh : meshes)
    {
      cslf::MeshInstance instance;
      instance.Linear = glm::mat3(size);
      instance.Offset = { 0.3f, 0.2f, 0.1f };
      mesh.Instances = { instance };
    }
    meshes.push_back(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, MakeDiffuse(1.0f)));
    const cslf::Scene scene(std::move(meshes), lights);
    const Estimate floor = Trace(scene, LookAt({ 0.1f, 0.1f, 1 }, { 0.1f, 0.1f, 0 }), {}, 1 << 10);
    CSLF_CHECK_NEAR(floor.Mean, 0.5, 0.05);
    // Surfaces at hits have valid directions at any size.
    for (std::uint32_t mesh = 0; mesh < 3; ++mesh)
    {
      cslf::Hit hit;
      hit.Distance = 0.9f;
      hit.Mesh = mesh;
      hit.Triangle = 0;
      hit.Instance = 0;
      const cslf::SurfaceHit surface =
        scene.GetSurface({ { 0.3f, 0.2f, 1.0f }, { 0, 0, -1 } }, hit);
      CSLF_CHECK_NEAR(glm::length(surface.ShadingNormal), 1.0, 1e-3);
      CSLF_CHECK(std::isfinite(surface.LeavePosition.x + surface.PassPosition.z));
    }
  }
  const glm::vec3 none(std::nanf(""));
  CSLF_CHECK(lights.Surroundings.GetRadiance(none) == glm::vec3(0.0f));
  CSLF_CHECK(lights.Surroundings.Pdf(none) == 0.0f);
}

void TestTranslucentLamp()
{
  // A lamp of opacity 0.4 lights a floor like one with 0.4 times the radiance, by each estimator.
  const auto trace = [](float opacity, float radiance, bool light, bool surface)
  {
    cslf::SurfaceMaterial lamp = MakeDiffuse(0.0f, radiance);
    lamp.Opacity = opacity;
    std::vector<cslf::Mesh> meshes;
    meshes.push_back(MakeRectangle({ 0, 0, 0 }, { 9, 0, 0 }, { 0, 9, 0 }, MakeDiffuse(0.5f)));
    meshes.push_back(MakeRectangle({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, lamp));
    const cslf::Scene scene(std::move(meshes), {});
    cslf::PathSettings settings;
    settings.MaximumDepth = 1;
    settings.LightSampling = light;
    settings.BSDFSampling = surface;
    return Trace(scene, LookAt({ 3, 0, 0.5f }, { 0.5f, 0.2f, 0 }), settings, 1 << 15);
  };
  const double expected = trace(1.0f, 0.4f, true, true).Mean;
  for (int estimators : { 1, 2, 3 })
  {
    const Estimate estimate = trace(0.4f, 1.0f, (estimators & 1) != 0, (estimators & 2) != 0);
    CSLF_CHECK_NEAR(estimate.Mean, expected, 4.0 * estimate.Error + 0.002 * expected);
  }
}

void TestGlassSphere()
{
  cslf::PathSettings settings;
  settings.MaximumDepth = 64;
  for (float ior : { 1.0f, 1.33f, 1.5f, 2.4f })
  {
    // A clear sphere in uniform light is invisible.
    std::vector<cslf::Mesh> meshes;
    meshes.push_back(MakeSphere(MakeGlass(ior, 0.0f)));
    const cslf::Scene clear(std::move(meshes), MakeUniformLight(1.0f));
    for (float height : { 0.0f, 0.3f, 0.7f, 0.95f })
    {
      const cslf::Ray ray{ { 2, 0, height }, { -1, 0, 0 } };
      CSLF_CHECK_NEAR(Trace(clear, ray, settings, 1 << 14).Mean, 1.0, 0.01);
    }

    // Tinted, through the middle: reflected by the front, or transmitted n times with n - 1
    // reflections inside.
    constexpr double tint = 0.6;
    std::vector<cslf::Mesh> tinted;
    tinted.push_back(MakeSphere(MakeGlass(ior, 0.0f, tint)));
    const cslf::Scene scene(std::move(tinted), MakeUniformLight(1.0f));
    const double r = cslf::DielectricFresnel(1.0f, ior);
    const double through = (1.0 - r) * tint * (1.0 - r) * tint / (1.0 - r);
    const cslf::Ray middle{ { 2, 0.013f, 0.017f }, { -1, 0, 0 } };
    const Estimate estimate = Trace(scene, middle, settings, 1 << 14);
    CSLF_CHECK_NEAR(estimate.Mean, r + through, 4.0 * estimate.Error + 0.002);
  }

  // A rough one reflects and transmits no more than it gets.
  std::vector<cslf::Mesh> rough;
  rough.push_back(MakeSphere(MakeGlass(1.5f, 0.5f)));
  const cslf::Scene scene(std::move(rough), MakeUniformLight(1.0f));
  const double radiance = Trace(scene, { { 2, 0, 0.3f }, { -1, 0, 0 } }, settings, 1 << 14).Mean;
  CSLF_CHECK(radiance < 1.01 && radiance > 0.7);
}

void TestRefraction()
{
  // A plane of glass under a sky that is brighter above: the direction of the refracted ray is
  // known.
  cslf::LightSet lights;
  lights.Surroundings =
    cslf::Environment(Dark, glm::vec3(2.0f), cslf::EnvironmentAxes::FromUp(glm::dvec3(0, 0, 1)));
  constexpr float ior = 1.5f;
  std::vector<cslf::Mesh> meshes;
  meshes.push_back(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, MakeGlass(ior, 0.0f)));
  const cslf::Scene scene(std::move(meshes), lights);
  for (float cosine : { 0.2f, 0.6f, 0.95f })
  {
    const double sine2 = 1.0 - cosine * cosine;
    for (bool inside : { false, true })
    {
      const double eta = inside ? 1.0 / ior : ior;
      const double sky = inside ? -1.0 : 1.0; // the side towards which the ray is reflected
      const double r = cslf::DielectricFresnel(cosine, static_cast<float>(eta));
      const double refracted = std::sqrt(std::max(0.0, 1.0 - sine2 / (eta * eta)));
      const double expected =
        r * (1.0 + sky * cosine) + (1.0 - r) / (eta * eta) * (1.0 - sky * refracted);
      const glm::vec3 from(std::sqrt(1.0f - cosine * cosine), 0, inside ? -cosine : cosine);
      const Estimate estimate = Trace(scene, LookAt(from, Dark), {}, 1 << 14);
      CSLF_CHECK_NEAR(estimate.Mean, expected, 4.0 * estimate.Error + 1e-3);
    }
  }
}

void TestEstimatorsAgree()
{
  // A lamp below a rough pane, seen from above.
  std::vector<cslf::Mesh> meshes;
  meshes.push_back(
    MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, MakeGlass(1.5f, 0.7f, 0.8f)));
  meshes.push_back(
    MakeRectangle({ 0, 0, -0.5f }, { 0.3f, 0, 0 }, { 0, 0.3f, 0 }, MakeDiffuse(0.5f, 2.0f)));
  meshes.push_back(
    MakeRectangle({ 0, 0.4f, 0.8f }, { 0.1f, 0, 0 }, { 0, 0.1f, 0 }, MakeDiffuse(0.5f, 9.0f)));
  const cslf::Scene scene(std::move(meshes), {});
  const cslf::Ray ray = LookAt({ -0.8f, 0.1f, 0.9f }, { 0.1f, 0, 0 });
  cslf::PathSettings settings;
  settings.MaximumDepth = 4;
  const auto [both, surface] = CheckEstimators(scene, ray, settings, 1 << 17);
  CSLF_CHECK(both.Mean > 0.0 && both.Error < 0.02 * both.Mean);
}
}

int TestCSLFTransparency(int, char*[])
{
  TestCoverage();
  TestShadows();
  TestRoundShapes();
  TestTinyInstances();
  TestTranslucentLamp();
  TestGlassSphere();
  TestRefraction();
  TestEstimatorsAgree();
  return cslf::testing::Result();
}
