// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfNovelViews.h"

#include "Console/cslfMessages.h"
#include "Options/cslfCameraOptions.h"
#include "Options/cslfNovelViewOptions.h"
#include "Pictures/cslfCameraPath.h"
#include "Pictures/cslfPictures.h"
#include "Scenes/cslfSceneFiles.h"

#include "vtkCSLFImageQuality.h"
#include "vtkCSLFToneMapping.h"

#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkImageStencilData.h>
#include <vtkMath.h>
#include <vtkNew.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace cslf::tool
{
namespace
{
/// Turns a spiral's next point by the golden angle, which spreads the points evenly.
const double GoldenAngle = vtkMath::Pi() * (3.0 - std::sqrt(5.0));
}

std::vector<vtkSmartPointer<vtkCamera>> MakeNovelViews(
  const Cube& cube, int count, int seed, bool isCornellBox)
{
  std::mt19937 generator(static_cast<unsigned int>(seed));
  const auto random = [&] { return generator() / 4294967296.0; };
  const double lowest = isCornellBox ? std::cos(glm::radians(SwingAngle)) : -1.0;
  const double edge = std::max({ cube.Edges.x, cube.Edges.y, cube.Edges.z });
  const double firstAngle = 2.0 * vtkMath::Pi() * random();
  std::vector<vtkSmartPointer<vtkCamera>> cameras;
  for (int view = 0; view < count; ++view)
  {
    const double cosine = 1.0 - (1.0 - lowest) * (view + random()) / count;
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const double angle = firstAngle + view * GoldenAngle;
    const glm::dvec3 direction(sine * std::cos(angle), sine * std::sin(angle), cosine);
    cameras.push_back(MakeCamera(cube.Center + DefaultDistance * edge * direction, cube.Center,
      { 0.0, 1.0, 0.0 }, DefaultViewAngle));
  }
  return cameras;
}

double ComputeChangePSNR(vtkImageData* truthBefore, vtkImageData* pictureBefore,
  vtkImageData* truth, vtkImageData* picture, vtkImageStencilData* stencil)
{
  constexpr double peak = 255.0;
  constexpr double most = 60.0;
  const auto read = [](vtkImageData* image, int x, int y, int k) -> int
  { return static_cast<const unsigned char*>(image->GetScalarPointer(x, y, 0))[k]; };
  const int* size = truth->GetDimensions();
  double sum = 0.0;
  double count = 0.0;
  for (int y = 0; y < size[1]; ++y)
  {
    for (int x = 0; x < size[0]; ++x)
    {
      for (int k = 0; k < 3 && stencil->IsInside(x, y, 0); ++k)
      {
        const int before = read(pictureBefore, x, y, k) - read(truthBefore, x, y, k);
        const int difference = read(picture, x, y, k) - read(truth, x, y, k) - before;
        sum += 1.0 * difference * difference;
        count += 1.0;
      }
    }
  }
  return sum > 0.0 ? std::min(most, 10.0 * std::log10(peak * peak * count / sum)) : most;
}

vtkSmartPointer<vtkImageStencilData> MakeCubeStencil(
  const Cube& cube, vtkCamera* camera, int width, int height)
{
  const double* position = camera->GetPosition();
  const double* focalPoint = camera->GetFocalPoint();
  const double* up = camera->GetViewUp();
  const glm::dvec3 eye(position[0], position[1], position[2]);
  const glm::dvec3 forward =
    glm::normalize(glm::dvec3(focalPoint[0], focalPoint[1], focalPoint[2]) - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(up[0], up[1], up[2])));
  const glm::dvec3 above = glm::cross(right, forward);
  const double tangent = std::tan(0.5 * glm::radians(camera->GetViewAngle()));
  const glm::dvec3 eyeCC = cube.PointToCube(eye);
  const auto meetsCube = [&](int x, int y)
  {
    const double s = tangent * (2.0 * (x + 0.5) - width) / height;
    const double t = tangent * (2.0 * (y + 0.5) - height) / height;
    const auto ray = RayToCoordinates(eyeCC, cube.VectorToCube(forward + s * right + t * above));
    return ray && ray->ExitDistance > 0.0;
  };

  auto stencil = vtkSmartPointer<vtkImageStencilData>::New();
  stencil->SetExtent(0, width - 1, 0, height - 1, 0, 0);
  stencil->AllocateExtents();
  for (int y = 0; y < height; ++y)
  {
    // The cube is convex, so each row of its picture is one interval.
    int first = 0;
    int last = width - 1;
    while (first < width && !meetsCube(first, y))
    {
      ++first;
    }
    while (last > first && !meetsCube(last, y))
    {
      --last;
    }
    if (first < width)
    {
      stencil->InsertNextExtent(first, last, y, 0);
    }
  }
  return stencil;
}

std::vector<NovelView> TraceNovelViews(
  const SceneOptions& options, const Scene& scene, const Cube& cube, const NovelViewOptions& novel)
{
  std::vector<NovelView> views;
  TruthTracer tracer(options, scene, novel.TruthFolder);
  for (const auto& camera : MakeNovelViews(cube, novel.Views, novel.Seed, options.HasCornellBox()))
  {
    const int number = static_cast<int>(views.size());
    const Truth truth = tracer.Trace(
      camera, novel.Size, novel.Samples, novel.Seed + number, vtkNew<vtkCSLFToneMapping>());
    const auto stencil = MakeCubeStencil(cube, camera, novel.Size, novel.Size);
    views.push_back({ camera, truth.Picture, stencil, ComputeNoiseFloor(truth, stencil) });
  }
  return views;
}

ViewQuality MeasureViews(FieldRenderer& renderer, int lookup, const std::vector<NovelView>& views)
{
  ViewQuality result;
  for (const NovelView& view : views)
  {
    vtkNew<vtkCSLFImageQuality> quality;
    quality->SetInputData(0, view.Picture);
    quality->SetInputData(1, renderer.Render(view.Camera, lookup));
    quality->SetStencilData(view.Stencil);
    quality->Update();
    ThrowOnError();
    result.PSNR.push_back(quality->GetPSNR());
    result.SSIM.push_back(quality->GetSSIM());
  }
  return result;
}
}
