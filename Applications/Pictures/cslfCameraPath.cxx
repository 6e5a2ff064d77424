// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfCameraPath.h"

#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfNumberChecks.h"
#include "Files/cslfFileSystem.h"
#include "Files/cslfJSONFile.h"
#include "Options/cslfCameraOptions.h"

#include <vtkCamera.h>
#include <vtkCameraInterpolator.h>
#include <vtkMath.h>
#include <vtkNew.h>

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>

namespace cslf::tool
{
namespace
{
using Cameras = std::vector<vtkSmartPointer<vtkCamera>>;

glm::dvec3 ToVector(const double* values)
{
  return { values[0], values[1], values[2] };
}

/// Cameras turned from `start` by an angle, in degrees, for each frame.
Cameras TurnCameras(vtkCamera* start, int frames, const std::function<double(double)>& getAngle)
{
  Cameras cameras;
  for (int frame = 0; frame < frames; ++frame)
  {
    auto camera = vtkSmartPointer<vtkCamera>::New();
    camera->DeepCopy(start);
    camera->Azimuth(getAngle(static_cast<double>(frame) / frames));
    cameras.push_back(camera);
  }
  return cameras;
}

nlohmann::json ReadPathFile(const std::string& fileName)
{
  std::error_code failure;
  if (!std::filesystem::is_regular_file(ToPath(fileName), failure))
  {
    throw Failure("There is no camera path " + fileName + ".");
  }
  return cslf::ReadJSON(fileName);
}

/// A point or vector of three numbers.
std::optional<glm::dvec3> ReadVector(const nlohmann::json& json)
{
  const bool isVector = json.is_array() && json.size() == 3 &&
    std::all_of(
      json.begin(), json.end(), [](const nlohmann::json& value) { return value.is_number(); });
  return isVector ? std::make_optional(glm::dvec3(
                      json[0].get<double>(), json[1].get<double>(), json[2].get<double>()))
                  : std::nullopt;
}

/// A key camera: position, focal point and view up.
vtkSmartPointer<vtkCamera> ReadCamera(
  const nlohmann::json& json, double viewAngle, const std::string& name)
{
  std::vector<glm::dvec3> vectors;
  for (const nlohmann::json& item : json.is_array() ? json : nlohmann::json::array())
  {
    if (const auto vector = ReadVector(item))
    {
      vectors.push_back(*vector);
    }
  }
  if (vectors.size() != 3 || json.size() != 3)
  {
    throw Failure(name + " is not a position, a focal point and a view-up, three numbers each.");
  }
  if (!(glm::length(vectors[1] - vectors[0]) > 0.0) || !(glm::length(vectors[2]) > 0.0))
  {
    throw Failure(name +
      " has no direction: position and focal point must differ, and view-up must not be zero.");
  }
  return MakeCamera(vectors[0], vectors[1], vectors[2], viewAngle);
}

/// A spline through the key cameras, which are at equal distances in time.
Cameras ReadPath(const std::string& fileName, int frames, double viewAngle)
{
  const nlohmann::json keys = ReadPathFile(fileName);
  if (!keys.is_array() || keys.size() < 2)
  {
    throw Failure(
      fileName + " is not a camera path: it must be a JSON array of two or more cameras.");
  }
  vtkNew<vtkCameraInterpolator> interpolator;
  interpolator->SetInterpolationTypeToSpline();
  for (std::size_t key = 0; key < keys.size(); ++key)
  {
    const std::string name = fileName + ": camera " + std::to_string(key);
    interpolator->AddCamera(static_cast<double>(key), ReadCamera(keys[key], viewAngle, name));
  }
  Cameras cameras;
  const double step =
    frames > 1 ? static_cast<double>(keys.size() - 1) / static_cast<double>(frames - 1) : 0.0;
  for (int frame = 0; frame < frames; ++frame)
  {
    vtkNew<vtkCamera> between;
    interpolator->InterpolateCamera(frame * step, between);
    const glm::dvec3 position = ToVector(between->GetPosition());
    const glm::dvec3 focalPoint = ToVector(between->GetFocalPoint());
    if (!(glm::length(focalPoint - position) > 0.0))
    {
      throw Failure(fileName + ": frame " + std::to_string(frame) + " has no direction.");
    }
    cameras.push_back(MakeCamera(position, focalPoint, ToVector(between->GetViewUp()), viewAngle));
  }
  return cameras;
}
}

Cameras MakeOrbit(vtkCamera* start, int frames)
{
  return TurnCameras(start, frames, [](double part) { return 360.0 * part; });
}

Cameras MakeSwing(vtkCamera* start, int frames)
{
  const glm::dvec3 up = glm::normalize(ToVector(start->GetViewUp()));
  const glm::dvec3 direction =
    glm::normalize(ToVector(start->GetPosition()) - ToVector(start->GetFocalPoint()));
  const double lowest = std::cos(glm::radians(SwingAngle));
  if (direction.z < lowest)
  {
    throw Failure("A swing starts within 35 degrees of +Z, as seen from the focal point.");
  }
  // The z of the rotated direction is a + b cos(angle - middle). The swing is that of a pendulum,
  // between the two angles where the direction leaves the cap around +Z.
  const double a = glm::dot(direction, up) * up.z;
  const double alongCosine = direction.z - a;
  const double alongSine = glm::cross(up, direction).z;
  const double b = std::hypot(alongCosine, alongSine);
  const double middle = std::atan2(alongSine, alongCosine);
  const double reach = b > 0.0 ? std::acos(std::clamp((lowest - a) / b, -1.0, 1.0)) : vtkMath::Pi();
  const double phase = reach > 0.0 ? std::asin(std::clamp(-middle / reach, -1.0, 1.0)) : 0.0;
  return TurnCameras(start, frames,
    [=](double part)
    { return glm::degrees(middle + reach * std::sin(phase + 2.0 * vtkMath::Pi() * part)); });
}

void CameraPathOptions::AddTo(CLI::App& command)
{
  const std::string group = "Camera path";
  command
    .add_option("--path", this->Path,
      "orbit: a full turn that begins at the camera; swing: back and forth within 35 degrees of "
      "+Z; or a JSON file of key cameras: [[position, focal point, view up], ...]")
    ->type_name(FilePlaceholder)
    ->check(Suggest("orbit, swing"))
    ->group(group);
  command.add_option("--frames", this->Frames, "number of pictures along the path")
    ->check(Between(1, 1000000))
    ->capture_default_str()
    ->group(group);
}

Cameras CameraPathOptions::MakeCameras(vtkCamera* start) const
{
  return this->Path == OrbitName ? MakeOrbit(start, this->Frames)
    : this->Path == SwingName    ? MakeSwing(start, this->Frames)
                                 : ReadPath(this->Path, this->Frames, start->GetViewAngle());
}
}
