// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The options of how a scene from files looks: see vtkCSLFSceneLook.
 */
#ifndef cslfSceneLook_h
#define cslfSceneLook_h

#include "Options/cslfColorOptions.h"
#include "cslfJSON.h"
#include "vtkCSLFSceneLook.h"

#include <vtkDataObject.h>
#include <vtkSmartPointer.h>

#include <glm/vec3.hpp>

#include <string>
#include <vector>

class vtkCSLFEnvironment;

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

/// Copies share the filter.
class SceneLook
{
public:
  /// Adds --color-by, --color-map, --range, --light and --up.
  void AddTo(CLI::App& command);

  /// What files look like, with the lights besides the sky. There may be no files. Throws a Failure
  /// if an array does not exist.
  vtkSmartPointer<vtkDataObject> Apply(
    const std::vector<vtkSmartPointer<vtkDataObject>>& files) const;

  /// The filter for a scene that changes over time, with the options' colours. Its input is to be
  /// connected. Throws a Failure.
  vtkCSLFSceneLook* SetUpFilter() const;

  /// What the colours of the last scene mean: a list of "array", "component", "range" and "map".
  nlohmann::json GetLegend() const;

  const ColorOptions& GetColors() const { return this->Colors; }

  /// Whether the command line chooses the light.
  bool IsLightGiven() const;

  /// Sets the sky for the last scene.
  void SetUpSky(vtkCSLFEnvironment* sky) const;

  SceneAxes GetAxes() const;

private:
  ColorOptions Colors;
  vtkSmartPointer<vtkCSLFSceneLook> Filter = vtkSmartPointer<vtkCSLFSceneLook>::New();
};

/// A legend in words, one line for each array.
std::string DescribeLegend(const nlohmann::json& legend);
}

#endif
