// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How a scene from files looks: the array and the colour map that colour it, the light of a scene
 * without lights of its own, and which side is up.
 */
#ifndef cslfSceneLook_h
#define cslfSceneLook_h

#include "cslfJSON.h"

#include <vtkSmartPointer.h>

#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <vector>

class vtkCSLFEnvironment;
class vtkDataArray;
class vtkDataObject;
class vtkPolyData;

namespace CLI
{
class App;
}

namespace cslf::tool
{
/// The directions of a scene for someone who stands in front of it.
struct SceneAxes
{
  glm::dvec3 Right;
  glm::dvec3 Up;
  glm::dvec3 Front; ///< towards the viewer

  glm::dvec3 Get(const glm::dvec3& parts) const
  {
    return parts.x * this->Right + parts.y * this->Up + parts.z * this->Front;
  }
};

class SceneLook
{
public:
  /// Adds --color-by, --color-map, --range, --light and --up.
  void AddTo(CLI::App& command);

  /// Chooses the scalars of surfaces, the polygonal data of all files, and maps them to colours.
  /// Returns the legend, a list of "array", "component", "range" and "map". Throws a Failure if an
  /// array does not exist.
  nlohmann::json SetColors(const std::vector<vtkPolyData*>& surfaces) const;

  /// Whether the command line chooses the light.
  bool IsLightGiven() const { return !this->Light.empty(); }

  /// Sets the sky. `hasLights` says whether the files contain lights.
  void SetUpSky(bool hasLights, vtkCSLFEnvironment* sky) const;

  /// A data object with the lights besides the sky; null if there are none.
  vtkSmartPointer<vtkDataObject> MakeLights() const;

  /// Whether the command line says which direction is up.
  bool IsUpGiven() const { return !this->Up.empty(); }

  SceneAxes GetAxes() const;

private:
  std::optional<int> ChooseArray(const std::vector<vtkPolyData*>& surfaces) const;
  nlohmann::json MapArrays(const std::string& name, const std::vector<vtkDataArray*>& arrays,
    std::optional<int> chosen) const;

  std::string ColorBy;
  std::string ColorMap;
  std::vector<double> Range;
  std::string Light;
  std::string Up;
};

/// A legend in words, one line for each array.
std::string DescribeLegend(const nlohmann::json& legend);

/// Whether a data object, or one of its blocks, contains lights or an environment.
bool HasLights(vtkDataObject* data);
}

#endif
