// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfCameraOptions.h"

#include "Console/cslfMessages.h"
#include "Console/cslfNumberChecks.h"
#include "cslfColor.h"
#include "cslfTableOptions.h"

#include <vtkCamera.h>
#include <vtkColor.h>
#include <vtkNamedColors.h>
#include <vtkNew.h>

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace cslf::tool
{
void ToneOptions::AddTo(CLI::App& command)
{
  using Mapping = vtkCSLFToneMapping;
  Mapping* tone = this->Tone;
  AddOption(command, options::ViewExposure, tone, &Mapping::SetExposure, Positive());
  AddOption(command, options::ToneMapping, tone, &Mapping::SetCurve);
}

void EncodeShown(
  vtkCSLFToneMapping* toneMapping, const glm::dvec3& radiance, double alpha, unsigned char color[3])
{
  unsigned char encoded[4] = { 0, 0, 0, 0 };
  if (alpha > 0.0)
  {
    glm::dvec3 shown = radiance / alpha;
    toneMapping->MapTone(glm::value_ptr(shown), glm::value_ptr(shown));
    EncodeColor(alpha * shown, alpha, encoded);
  }
  std::copy_n(encoded, 3, color);
}

namespace
{
// From the front, a little to the right and above; inside the opening of the Cornell box.
const glm::dvec3 DefaultDirection(0.35, 0.25, 1.0);

constexpr int MaximumSize = 16384;

/// A colour of HTML, red, green and blue from 0 to 1. Nothing if it is none.
std::optional<std::array<double, 3>> FindColor(const std::string& text)
{
  vtkNew<vtkNamedColors> colors;
  const vtkColor4ub color = colors->HTMLColorToRGBA(text);
  return color.GetAlpha() == 255 ? std::make_optional(std::array<double, 3>{ color.GetRed() / 255.0,
                                     color.GetGreen() / 255.0, color.GetBlue() / 255.0 })
                                 : std::nullopt;
}

CLI::Validator Color()
{
  return CLI::Validator([](std::string& text)
    { return FindColor(text) ? std::string() : text + " is no colour such as white or #1a1a1f"; },
    "");
}

glm::dvec3 ToVector(const std::vector<double>& values)
{
  return { values[0], values[1], values[2] };
}
}

vtkSmartPointer<vtkCamera> MakeCamera(
  const glm::dvec3& position, const glm::dvec3& focalPoint, const glm::dvec3& up, double viewAngle)
{
  const glm::dvec3 view = glm::normalize(focalPoint - position);
  glm::dvec3 usedUp = up;
  if (!(glm::length(glm::cross(view, up)) > 1e-6 * glm::length(up)))
  {
    usedUp = std::abs(view.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
  }
  auto camera = vtkSmartPointer<vtkCamera>::New();
  camera->SetPosition(position.x, position.y, position.z);
  camera->SetFocalPoint(focalPoint.x, focalPoint.y, focalPoint.z);
  camera->SetViewUp(usedUp.x, usedUp.y, usedUp.z);
  camera->SetViewAngle(viewAngle);
  return camera;
}

void CameraOptions::AddTo(CLI::App& command)
{
  const std::string group = "Camera (world coordinates) and picture";
  command
    .add_option("--position", this->Position,
      "position of the camera (default: 2.4 cube edges in front of the centre)")
    ->expected(3)
    ->check(Finite())
    ->type_name("X Y Z")
    ->group(group);
  command
    .add_option(
      "--focal-point", this->FocalPoint, "point that the camera looks at (default: the centre)")
    ->expected(3)
    ->check(Finite())
    ->type_name("X Y Z")
    ->group(group);
  command.add_option("--view-up", this->ViewUp, "up direction of the picture")
    ->expected(3)
    ->check(Finite())
    ->type_name("X Y Z")
    ->capture_default_str()
    ->group(group);
  command.add_option("--view-angle", this->ViewAngle, "vertical view angle in degrees")
    ->check(Between(0.01, 179.0))
    ->capture_default_str()
    ->group(group);
  command.add_option("--size", this->Size, "size of the picture in pixels")
    ->expected(2)
    ->check(Between(1, MaximumSize))
    ->type_name("WIDTH HEIGHT")
    ->capture_default_str()
    ->group(group);
  command
    .add_option("--background", this->Background,
      "what is seen beside the scene: a colour of HTML, such as white or #1a1a1f")
    ->check(Color())
    ->type_name("COLOR")
    ->capture_default_str()
    ->group(group);
}

std::array<double, 3> CameraOptions::GetBackground() const
{
  return FindColor(this->Background).value_or(std::array<double, 3>{});
}

vtkSmartPointer<vtkCamera> CameraOptions::MakeCamera(const Cube& cube, double distance) const
{
  const double edge = std::max({ cube.Edges.x, cube.Edges.y, cube.Edges.z });
  const glm::dvec3 position = this->Position
    ? ToVector(*this->Position)
    : cube.Center + distance * edge * glm::normalize(DefaultDirection);
  const glm::dvec3 focalPoint = this->FocalPoint ? ToVector(*this->FocalPoint) : cube.Center;
  if (!(glm::length(focalPoint - position) > 0.0))
  {
    throw Failure("The camera's position and its focal point must differ.");
  }
  return tool::MakeCamera(position, focalPoint, ToVector(this->ViewUp), this->ViewAngle);
}
}
