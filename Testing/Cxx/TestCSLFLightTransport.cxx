// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Scenes whose light is known in closed form, and estimators that must agree.
#include "RandomNumbers/cslfSampling.h"
#include "cslfTestTransport.h"
#include "cslfTesting.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <utility>
#include <vector>

namespace
{
using namespace cslf::testing;

/// The form factor from a point to a rectangle parallel to its surface, with one corner directly
/// above. It is an odd function of width and length.
double CornerFormFactor(double width, double length, double height)
{
  const double a = width / height;
  const double b = length / height;
  return (a / std::hypot(1.0, a) * std::atan(b / std::hypot(1.0, a)) +
           b / std::hypot(1.0, b) * std::atan(a / std::hypot(1.0, b))) /
    (2.0 * cslf::Pi);
}

void TestSquareLight()
{
  // A square of side 2, 1 above the floor: the irradiance below it and beside it.
  constexpr float radiance = 3.0f;
  constexpr float reflectance = 0.5f;
  std::vector<cslf::Mesh> meshes;
  meshes.push_back(MakeRectangle({ 0, 0, 0 }, { 9, 0, 0 }, { 0, 9, 0 }, MakeDiffuse(reflectance)));
  meshes.push_back(
    MakeRectangle({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, MakeDiffuse(0.0f, radiance)));
  const cslf::Scene scene(std::move(meshes), {});
  for (const glm::vec3& point :
    { glm::vec3(0, 0, 0), glm::vec3(0.5f, 0.2f, 0), glm::vec3(1, 0, 0), glm::vec3(2.5f, 0.7f, 0) })
  {
    double factor = 0.0;
    for (double x : { -1.0, 1.0 })
    {
      for (double y : { -1.0, 1.0 })
      {
        factor += x * y * CornerFormFactor(x - point.x, y - point.y, 1.0);
      }
    }
    const double expected = reflectance * radiance * factor;
    const cslf::Ray ray = LookAt(point + glm::vec3(0.3f, 0.1f, 0.4f), point);
    for (int mode = 1; mode < 4; ++mode)
    {
      cslf::PathSettings settings;
      settings.MaximumDepth = 1;
      settings.LightSampling = (mode & 1) != 0;
      settings.BSDFSampling = (mode & 2) != 0;
      const Estimate estimate = Trace(scene, ray, settings, 1 << 15);
      CSLF_CHECK_NEAR(estimate.Mean / expected, 1.0, 0.01);
    }
    cslf::PathSettings emission;
    emission.MaximumDepth = 0;
    CSLF_CHECK(Trace(scene, ray, emission, 16).Mean == 0.0);
  }
  // The light seen directly, from either side.
  CSLF_CHECK_NEAR(Trace(scene, LookAt({ 0, 0, 3 }, Dark), {}, 16).Mean, radiance, 1e-5);
  CSLF_CHECK_NEAR(Trace(scene, { { 0, 0, 0.5f }, { 0, 0, 1 } }, {}, 16).Mean, radiance, 1e-5);
}

void TestPunctualLights()
{
  cslf::LightSet lights;
  lights.Directional.push_back({ glm::normalize(glm::vec3(0, 3, -4)), glm::vec3(5.0f) });
  lights.Points.push_back({ { 1, 2, 2 }, glm::vec3(7.0f) });
  lights.Points.push_back({ { 0, 0, -1 }, glm::vec3(100.0f) }); // behind the floor
  std::vector<cslf::Mesh> meshes;
  meshes.push_back(MakeRectangle({ 0, 0, 0 }, { 9, 0, 0 }, { 0, 9, 0 }, MakeDiffuse(0.5f)));
  meshes.push_back(MakeRectangle({ 5, -3, 4 }, { 0.5f, 0, 0 }, { 0, 0.5f, 0 }, MakeDiffuse(0.0f)));
  const cslf::Scene scene(std::move(meshes), lights);
  cslf::PathSettings direct;
  direct.MaximumDepth = 1;
  const double sun = 5.0 * 0.8;
  const double bulb = 7.0 / 9.0 * (2.0 / 3.0);
  CSLF_CHECK_NEAR(
    Trace(scene, LookAt({ 0, 0, 1 }, Dark), direct, 16).Mean, 0.5 / cslf::Pi * (sun + bulb), 1e-4);
  // In the sun's shadow of the second rectangle.
  const double far2 = 16.0 + 4.0 + 4.0;
  CSLF_CHECK_NEAR(Trace(scene, LookAt({ 5, 0, 1 }, { 5, 0, 0 }), direct, 16).Mean,
    0.5 / cslf::Pi * 7.0 / far2 * (2.0 / std::sqrt(far2)), 1e-4);
}

void TestReflectionsUnderUniformLight()
{
  // No light gets between two infinite parallel planes; all light returns from a single one.
  std::vector<cslf::Mesh> plane;
  plane.push_back(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, MakeDiffuse(1.0f)));
  const cslf::Scene open(std::move(plane), MakeUniformLight(2.0f));
  CSLF_CHECK_NEAR(Trace(open, LookAt({ 1, 0, 1 }, Dark), {}, 256).Mean, 2.0, 1e-4);

  // Inside a closed cube whose walls emit 1 and reflect r, each reflection adds another r.
  std::vector<cslf::Mesh> walls;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (float side : { -1.0f, 1.0f })
    {
      glm::vec3 center(0.0f);
      glm::vec3 u(0.0f);
      glm::vec3 v(0.0f);
      center[axis] = side;
      u[(axis + 1) % 3] = 1.0f;
      v[(axis + 2) % 3] = 1.0f;
      walls.push_back(MakeRectangle(center, u, v, MakeDiffuse(0.5f, 1.0f)));
    }
  }
  const cslf::Scene closed(std::move(walls), MakeUniformLight(100.0f));
  for (int depth : { 0, 1, 3, 6 })
  {
    cslf::PathSettings settings;
    settings.MaximumDepth = depth;
    const Estimate estimate =
      Trace(closed, { { 0.1f, 0, 0 }, glm::normalize(glm::vec3(1, 2, 3)) }, settings, 1 << 15);
    CSLF_CHECK_NEAR(estimate.Mean, 2.0 - std::pow(0.5, depth), 0.01);
  }
}

/// A bright spot on a lat-long image over darkness.
cslf::Environment MakeSpotEnvironment()
{
  cslf::EnvironmentImage image{ 32, 16, std::vector<glm::vec3>(512, glm::vec3(0.1f)) };
  image.Pixels[4 * 32 + 9] = glm::vec3(60.0f);
  return { image, 1.0f, cslf::EnvironmentAxes::FromUp(glm::dvec3(0, 0, 1)) };
}

void TestEstimatorsAgree()
{
  // A floor and a lamp, with a metallic or diffuse wall between, under an environment image.
  for (const cslf::SurfaceMaterial& material :
    { MakeDiffuse(0.7f), cslf::SurfaceMaterial(glm::vec3(0.9f), 1.0f, 0.4f, 1.0f, Dark),
      cslf::SurfaceMaterial(glm::vec3(0.5f), 0.0f, 0.5f, 1.5f, Dark) })
  {
    std::vector<cslf::Mesh> meshes;
    meshes.push_back(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, material));
    meshes.push_back(MakeRectangle({ 1, 0, 0.5f }, { 0, 1, 0 }, { 0, 0, 0.5f }, MakeDiffuse(0.6f)));
    meshes.push_back(
      MakeRectangle({ 0, 0, 0.7f }, { 0.3f, 0, 0 }, { 0, 0.3f, 0 }, MakeDiffuse(0.2f, 2.0f)));
    cslf::LightSet lights;
    lights.Surroundings = MakeSpotEnvironment();
    const cslf::Scene scene(std::move(meshes), lights);
    const cslf::Ray ray = LookAt({ -0.9f, 0.1f, 0.3f }, { 0.5f, 0, 0 });
    cslf::PathSettings settings;
    settings.MaximumDepth = 4;
    const auto [both, surface] = CheckEstimators(scene, ray, settings, 1 << 18);
    CSLF_CHECK(both.Error < 0.01 * both.Mean && surface.Error < 0.05 * both.Mean);
    CSLF_CHECK(both.Error < std::sqrt(8.0) * surface.Error); // at as many samples
  }
}

void TestMirror()
{
  cslf::LightSet lights;
  lights.Surroundings = MakeSpotEnvironment();
  std::vector<cslf::Mesh> meshes;
  meshes.push_back(MakeRectangle(
    { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, cslf::SurfaceMaterial(White, 1.0f, 0.0f, 1.0f, Dark)));
  const cslf::Scene scene(std::move(meshes), lights);
  for (int i = 0; i < 100; ++i)
  {
    const glm::vec3 from = glm::normalize(
      glm::vec3(std::cos(0.7f * i), std::sin(0.7f * i), 0.1f + 0.02f * static_cast<float>(i)));
    const glm::vec3 mirrored(-from.x, -from.y, from.z);
    CSLF_CHECK_NEAR(Trace(scene, LookAt(from, Dark), {}, 16).Mean,
      lights.Surroundings.GetRadiance(mirrored).x, 1e-3);
  }
}
}

int TestCSLFLightTransport(int, char*[])
{
  TestSquareLight();
  TestPunctualLights();
  TestReflectionsUnderUniformLight();
  TestEstimatorsAgree();
  TestMirror();
  return cslf::testing::Result();
}
