// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfArithmetic.h"

#include "PathTracing/Scene/cslfFingerprint.h"
#include "PathTracing/Scene/cslfScene.h"
#include "PathTracing/Shapes/cslfMesh.h"
#include "Pipeline/cslfFieldArrays.h"
#include "cslfTexelRenderer.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <utility>
#include <vector>

namespace cslf
{
namespace
{
constexpr int PictureSide = 32;
constexpr int PictureSamples = 4;
constexpr int HashDigits = 16;

/// A smooth, wavy, glossy surface.
Mesh MakeWaves()
{
  constexpr std::uint32_t side = 12;
  Mesh waves;
  for (std::uint32_t y = 0; y <= side; ++y)
  {
    for (std::uint32_t x = 0; x <= side; ++x)
    {
      const float u = 1.3f * static_cast<float>(x) / side - 0.65f;
      const float v = 1.3f * static_cast<float>(y) / side - 0.65f;
      waves.Vertices.emplace_back(u, v, 0.1f * std::sin(7.0f * u) * std::cos(5.0f * v));
      waves.Normals.push_back(
        glm::normalize(glm::vec3(-0.7f * std::cos(7.0f * u), 0.3f * v, 1.0f)));
      const std::uint32_t corner = y * (side + 1) + x;
      if (x < side && y < side)
      {
        waves.Triangles.emplace_back(corner, corner + 1, corner + side + 1);
        waves.Triangles.emplace_back(corner + 1, corner + side + 2, corner + side + 1);
      }
    }
  }
  waves.Material = SurfaceMaterial(glm::vec3(0.7f, 0.6f, 0.5f), 0.3f, 0.5f, 1.5f, glm::vec3(0.0f));
  return waves;
}

Mesh MakeSpheres()
{
  Mesh spheres;
  spheres.Shape = Mesh::Shapes::Spheres;
  spheres.Vertices = { { 0.3f, 0.2f, 0.3f }, { -0.3f, 0.1f, 0.35f }, { 0.0f, -0.4f, 0.3f } };
  spheres.Radii = { 0.21f, 0.17f, 0.23f };
  return spheres;
}

std::string TracePicture()
{
  std::vector<Mesh> meshes;
  meshes.push_back(MakeWaves());
  meshes.push_back(MakeSpheres());
  LightSet lights;
  lights.Surroundings = Environment(glm::vec3(0.1f, 0.2f, 0.3f), glm::vec3(0.9f, 0.8f, 0.7f),
    EnvironmentAxes::FromUp(glm::dvec3(0.1, 0.2, 1.0)));
  lights.Directional.push_back(
    { glm::normalize(glm::vec3(0.3f, 0.4f, -1.0f)), glm::vec3(0.5f, 0.6f, 0.7f) });
  const Scene scene(std::move(meshes), std::move(lights));

  const double step = 1.4 / PictureSide;
  const RayGrid rays{ { -0.7, -0.7, 1.5 }, { step, 0.0, 0.0 }, { 0.0, step, 0.0 },
    { 0.1, 0.05, -3.0 }, { 0.001, 0.0, 0.0 }, { 0.0, 0.001, 0.0 } };
  constexpr int texels = PictureSide * PictureSide;
  ViewpointSamples output;
  for (const auto& [id, type] : { std::pair(KnownChannel::Color, VTK_FLOAT),
         std::pair(KnownChannel::Depth, VTK_UNSIGNED_SHORT) })
  {
    output.SetArray(id, MakeArray(MakeChannel(id, type), texels));
  }
  RenderSettings settings;
  settings.Samples = PictureSamples;
  const PictureLayout layout{ PictureSide, PictureSide, 1, 0, 1 };
  const TexelRenderer renderer(
    scene, layout, settings, [&rays](int, int) { return rays; }, output);
  renderer.Render([](double) { return true; });
  Fingerprint hash;
  const auto* colors = output.Get<float>(KnownChannel::Color);
  const auto* depths = output.Get<unsigned short>(KnownChannel::Depth);
  hash.Add(std::vector<float>(colors, colors + 4 * texels));
  hash.Add(std::vector<unsigned short>(depths, depths + texels));
  return hash.Finish().substr(0, HashDigits);
}
}

const std::string& GetArithmetic()
{
  static const std::string arithmetic = TracePicture();
  return arithmetic;
}
}
