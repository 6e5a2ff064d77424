// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pictures of small scenes by the texel renderer.
 */
#ifndef cslfTexelPicture_h
#define cslfTexelPicture_h

#include "PathTracing/Texels/cslfTexelRenderer.h"
#include "cslfTesting.h"

#include <vtkFloatArray.h>
#include <vtkNew.h>

#include <glm/vec4.hpp>

#include <cstdint>
#include <vector>

namespace cslf
{
namespace testing
{
/// The view of a parallel camera above the origin, of 2 x 2 units.
class TexelPicture
{
public:
  TexelPicture(const Scene& scene, int size, double height)
    : World(scene)
    , Size(size)
    , Height(height)
  {
  }

  std::vector<float> Render(const RenderSettings& settings, std::uint64_t* rays = nullptr)
  {
    vtkNew<vtkFloatArray> colors;
    colors->SetNumberOfComponents(4);
    colors->SetNumberOfTuples(this->Size * this->Size);
    ViewpointSamples output;
    output.SetArray(KnownChannel::Color, colors);
    RayGrid grid;
    const double step = 2.0 / this->Size;
    grid.Origin = { -1.0, -1.0, this->Height };
    grid.OriginX = { step, 0.0, 0.0 };
    grid.OriginY = { 0.0, step, 0.0 };
    grid.Direction = { 0.0, 0.0, -1.0 };
    const TexelRenderer renderer(
      this->World, { this->Size, this->Size, 1, 0, 1 }, settings,
      [&grid](int, int) { return grid; }, output);
    CSLF_CHECK(renderer.Render([](double) { return true; }));
    if (rays)
    {
      *rays = renderer.GetNumberOfRays();
    }
    return { colors->Begin(), colors->End() };
  }

  /// The mean of all texels.
  glm::dvec4 GetMean(const RenderSettings& settings, std::uint64_t* rays = nullptr)
  {
    const std::vector<float> colors = this->Render(settings, rays);
    glm::dvec4 mean(0.0);
    for (std::size_t i = 0; i < colors.size(); i += 4)
    {
      mean += glm::dvec4(colors[i], colors[i + 1], colors[i + 2], colors[i + 3]);
    }
    return mean / (colors.size() / 4.0);
  }

private:
  const Scene& World;
  int Size;
  double Height;
};

}
}

#endif
