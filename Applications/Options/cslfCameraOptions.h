// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The camera of a novel view, in world coordinates, and the picture's size and background, on the
 * command line.
 */
#ifndef cslfCameraOptions_h
#define cslfCameraOptions_h

#include "cslfCube.h"
#include "vtkCSLFToneMapping.h"

#include <glm/vec3.hpp>
#include <vtkSmartPointer.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

class vtkCamera;

namespace CLI
{
class App;
}

namespace cslf::tool
{
class ToneOptions
{
public:
  /// Adds --view-exposure and --tone-mapping.
  void AddTo(CLI::App& command);

  vtkCSLFToneMapping* Get() const { return this->Tone; }

private:
  vtkSmartPointer<vtkCSLFToneMapping> Tone = vtkSmartPointer<vtkCSLFToneMapping>::New();
};

/// A pixel of linear radiance, associated with its coverage `alpha`, as displayed over black.
void EncodeShown(vtkCSLFToneMapping* toneMapping, const glm::dvec3& radiance, double alpha,
  unsigned char color[3]);

///@{
/// The distance of default cameras from the cube's centre, in units of its longest edge: of a
/// picture, which contains the whole cube, and for measurements, where the cube fills it.
constexpr double PictureDistance = 2.4;
constexpr double MeasuringDistance = 2.0;
///@}

/// The default vertical view angle in degrees.
constexpr double DefaultViewAngle = 40.0;

/// The default background. Not black, so that dark things are seen.
constexpr const char* DefaultBackground = "#1a1a1f";

/// A camera at `position` that looks at `focalPoint`; `up` is replaced if it is parallel to the
/// view.
vtkSmartPointer<vtkCamera> MakeCamera(
  const glm::dvec3& position, const glm::dvec3& focalPoint, const glm::dvec3& up, double viewAngle);

class CameraOptions
{
public:
  void AddTo(CLI::App& command);

  /// The camera. The cube gives the defaults. Throws a Failure if the position is the focal point.
  vtkSmartPointer<vtkCamera> MakeCamera(const Cube& cube, double distance = PictureDistance) const;

  int GetWidth() const { return this->Size[0]; }
  int GetHeight() const { return this->Size[1]; }

  /// What is seen beside the scene: red, green and blue from 0 to 1, as displayed.
  std::array<double, 3> GetBackground() const;

private:
  std::optional<std::vector<double>> Position;
  std::optional<std::vector<double>> FocalPoint;
  std::vector<double> ViewUp{ 0.0, 1.0, 0.0 };
  double ViewAngle = DefaultViewAngle;
  std::vector<int> Size{ 512, 512 };
  std::string Background = DefaultBackground;
};
}

#endif
