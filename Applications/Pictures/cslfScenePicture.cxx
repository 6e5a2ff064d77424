// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfScenePicture.h"

#include "Console/cslfMessages.h"
#include "Fields/cslfOutputFiles.h"
#include "Files/cslfFileSystem.h"
#include "Options/cslfCameraOptions.h"
#include "SceneImport/cslfBlockAppearances.h"
#include "Scenes/cslfSceneFiles.h"
#include "cslfPictures.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFViewTracer.h"

#include <vtkBoundingBox.h>
#include <vtkCamera.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <system_error>

namespace cslf::tool
{
namespace
{
constexpr int Width = 960;
constexpr int Height = 720;
constexpr int Samples = 64;
constexpr double NoiseTarget = 0.01;

// PNG's keyword for what made a file.
constexpr const char* SoftwareKey = "Software";
constexpr const char* Software = "cslf sample";

/// The points that a view must contain: all of them, or the corners of the bounds of instances.
void ForEachPoint(const Scene& scene, const std::function<void(const glm::dvec3&)>& visit)
{
  scene.ForEachPolyData(
    [&visit](vtkPolyData* surface)
    {
      if (surface->GetFieldData()->HasArray(vtkCSLFInstances::InstanceMatrix()))
      {
        const vtkBoundingBox box = GetPlacedBounds(surface);
        for (int corner = 0; box.IsValid() && corner < 8; ++corner)
        {
          double point[3];
          box.GetCorner(corner, point);
          visit({ point[0], point[1], point[2] });
        }
        return;
      }
      for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
      {
        double point[3];
        surface->GetPoint(i, point);
        if (std::isfinite(point[0] + point[1] + point[2]))
        {
          visit({ point[0], point[1], point[2] });
        }
      }
    });
}

/// A camera in a direction whose picture a scene fills.
struct Framing
{
  vtkSmartPointer<vtkCamera> Camera;
  double Extent = 0.0; ///< of the scene across the direction

  Framing(const Scene& scene, const glm::dvec3& direction, const glm::dvec3& upright, double aspect)
  {
    constexpr double viewAngle = 30.0;
    constexpr double margin = 1.06;
    double bounds[6];
    scene.GetBounds(bounds);
    const glm::dvec3 size(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]);
    const glm::dvec3 middle =
      0.5 * glm::dvec3(bounds[0] + bounds[1], bounds[2] + bounds[3], bounds[4] + bounds[5]);
    const glm::dvec3 towards = glm::normalize(direction);
    const glm::dvec3 right = glm::normalize(glm::cross(upright, towards));
    const glm::dvec3 across[2] = { right, glm::cross(towards, right) };
    const double slope = std::tan(vtkMath::RadiansFromDegrees(0.5 * viewAngle));
    const double slopes[2] = { aspect * slope, slope };

    // How far the points reach across, and beyond the planes through the middle that are parallel
    // to the picture's edges.
    glm::dvec2 low(std::numeric_limits<double>::max());
    glm::dvec2 high(std::numeric_limits<double>::lowest());
    glm::dvec2 before = high;
    glm::dvec2 behind = high;
    ForEachPoint(scene,
      [&](const glm::dvec3& point)
      {
        const glm::dvec3 place = point - middle;
        const double near = glm::dot(place, towards);
        for (int i = 0; i < 2; ++i)
        {
          const double along = glm::dot(place, across[i]);
          low[i] = std::min(low[i], along);
          high[i] = std::max(high[i], along);
          before[i] = std::max(before[i], slopes[i] * near - along);
          behind[i] = std::max(behind[i], slopes[i] * near + along);
        }
      });
    this->Extent = glm::length(high - low);
    double distance = glm::length(size) > 0.0 ? 0.1 * glm::length(size) : 5.0;
    glm::dvec3 center = middle;
    for (int i = 0; i < 2; ++i)
    {
      distance = std::max(distance, 0.5 * (before[i] + behind[i]) / slopes[i]);
      center += 0.5 * (behind[i] - before[i]) * across[i];
    }
    this->Camera =
      tool::MakeCamera(center + margin * distance * towards, center, upright, viewAngle);
  }
};

/// A view through the opening of the Cornell box, which it fills.
vtkSmartPointer<vtkCamera> MakeInnerCamera(const Scene& scene, const SceneAxes& axes, double aspect)
{
  constexpr glm::dvec3 inward(0.3, 0.2, 1.0);
  return Framing(scene, axes.Get(inward), axes.Up, aspect).Camera;
}

/// A view from the front, a little from the right and above, that a scene fills. Flat scenes are
/// seen from a side on which they are not edge-on.
vtkSmartPointer<vtkCamera> MakeCamera(const Scene& scene, const SceneAxes& axes, double aspect)
{
  // The usual direction, and how much that with the largest outline of the scene's box counts.
  constexpr glm::dvec3 usual(0.5, 0.4, 1.0);
  constexpr double weight = 0.7;

  double bounds[6];
  scene.GetBounds(bounds);
  const glm::dvec3 size(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]);
  const auto measure = [&size](const glm::dvec3& axis)
  { return glm::length(axis * size) / std::max(glm::length(size), VTK_DBL_MIN); };
  const double width = measure(axes.Right);
  const double height = measure(axes.Up);
  const double depth = measure(axes.Front);
  const glm::dvec3 areas(height * depth, width * depth, width * height);
  const double area = glm::length(areas);
  glm::dvec3 parts = glm::normalize(usual);
  parts += area > 0.0 ? weight / area * areas : glm::dvec3(0.0);
  const Framing fromRight(scene, axes.Get(parts), axes.Up, aspect);
  // Lines may be seen end on.
  parts.x = -parts.x;
  const Framing fromLeft(scene, axes.Get(parts), axes.Up, aspect);
  return (fromRight.Extent < 0.5 * fromLeft.Extent ? fromLeft : fromRight).Camera;
}

bool IsOwnPicture(const std::string& fileName)
{
  const SeparateMessages messages;
  vtkNew<vtkPNGReader> reader;
  if (!reader->CanReadFile(fileName.c_str()))
  {
    return false;
  }
  reader->SetFileName(fileName.c_str());
  reader->UpdateInformation();
  int chunks[2] = { 0, 0 };
  reader->GetTextChunks(SoftwareKey, chunks);
  bool isOwn = false;
  for (int i = chunks[0]; i < chunks[1]; ++i)
  {
    const char* value = reader->GetTextValue(i);
    isOwn = isOwn || (value && std::strcmp(value, Software) == 0);
  }
  return isOwn;
}
}

void WriteScenePicture(
  const std::string& fileName, const SceneOptions& options, const Scene& scene, bool replacesOthers)
{
  vtkNew<vtkCSLFViewTracer> tracer;
  options.Apply(scene, tracer);
  // Without a cache, whose points for all surfaces take longer than one picture's paths.
  tracer->SetIntegratorToPathTracing();
  tracer->SetSamples(Samples);
  tracer->SetNoiseTarget(NoiseTarget);
  tracer->SetSize(Width, Height);
  const SceneAxes axes = options.GetLook().GetAxes();
  constexpr double aspect = double(Width) / Height;
  tracer->SetCamera(options.HasCornellBox() ? MakeInnerCamera(scene, axes, aspect)
                                            : MakeCamera(scene, axes, aspect));
  {
    const ProgressBar bar(tracer, "Tracing the picture");
    tracer->Update();
  }
  ThrowOnError();
  const auto picture = DropAlpha(tracer->GetOutput(), CameraOptions().GetBackground().data());
  if (LowerExtension(fileName) != ".png")
  {
    WritePicture(fileName, picture);
    return;
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(picture);
  writer->AddText(SoftwareKey, Software);
  writer->WriteToMemoryOn();
  writer->Write();
  ThrowOnError();
  const vtkSmartPointer<vtkUnsignedCharArray> bytes = writer->GetResult();
  WriteWholeBytes(bytes->GetPointer(0), bytes->GetNumberOfValues(), fileName,
    replacesOthers || IsOwnPicture(fileName));
}

void RequireReplaceable(const std::string& fileName)
{
  std::error_code failure;
  const std::filesystem::path path = ToPath(fileName);
  const auto status = std::filesystem::symlink_status(path, failure);
  if (std::filesystem::exists(status) &&
    !(std::filesystem::is_regular_file(status) && IsOwnPicture(fileName)))
  {
    throw Failure(fileName +
      " exists: choose another name with --output or --picture, or replace it with --overwrite.");
  }
}
}
