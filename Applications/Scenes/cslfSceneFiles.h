// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Scenes: the INPUT of `sample`, `trace` and `evaluate`, and its light.
 */
#ifndef cslfSceneFiles_h
#define cslfSceneFiles_h

#include "Options/cslfOptionTable.h"
#include "cslfJSON.h"
#include "cslfSceneLook.h"
#include "cslfSceneParts.h"
#include "vtkCSLFEnvironment.h"

#include <vtkSmartPointer.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

class vtkCSLFPathTracer;
class vtkDataObject;
class vtkPolyData;

namespace CLI
{
class App;
}

namespace cslf::tool
{
/// A scene in memory: a data object for each scene by name, and one for all files.
class Scene
{
public:
  std::vector<vtkSmartPointer<vtkDataObject>> Parts;
  nlohmann::json Legend; ///< what colours files, see SceneLook

  /// The bounds of all cells with their radii, and of their instances, in VTK's order. A unit box
  /// around the origin if there are none.
  void GetBounds(double bounds[6]) const;

  /// Visits the polygonal data of all parts.
  void ForEachPolyData(const std::function<void(vtkPolyData*)>& visit) const;
};

/// A scene's files and the material and light options of the command line. Copies share the light.
class SceneOptions
{
public:
  /// The files as positional arguments, material and light.
  void AddTo(CLI::App& command);

  /// The same, but the files, as arguments or with --scene, are optional.
  void AddOptionalTo(CLI::App& command);

  /// Adds a scene before those of the command line.
  void AddFirst(const std::string& input) { this->Inputs.insert(this->Inputs.begin(), input); }

  /// Takes defaults for the command line from a field's sampling parameters.
  void TakeDefaults(const nlohmann::json& sampling);

  /// Reads the inputs, at the time that the command line chooses, and gives them their materials.
  /// Throws a Failure.
  Scene Read() const;

  /// Gives a path tracer the scene and its light.
  void Apply(const Scene& scene, vtkCSLFPathTracer* tracer) const;

  /// The times of the inputs, ascending: those of all inputs that have any. Throws a Failure.
  std::vector<double> FindTimes() const;

  /// The time that the command line chooses.
  std::optional<double> GetTime() const;

  /// Reads the inputs at a time.
  Scene ReadAt(std::optional<double> time) const;

  /// Gives a path tracer the scene at these times, which its pipeline can request, and its light.
  /// Returns what colours it. The options must outlive the tracer.
  vtkCSLFSceneLook* ApplySeries(const std::vector<double>& times, vtkCSLFPathTracer* tracer) const;

  /// Throws a Failure if writing a file would replace one of the inputs or the environment image.
  void RequireOther(const std::string& output) const;

  const SceneLook& GetLook() const { return this->Look; }

  /// The first of the inputs.
  const std::string& GetFirst() const { return this->Inputs.front(); }

  bool IsEmpty() const { return this->Inputs.empty(); }

  /// Whether the Cornell box is among the inputs.
  bool HasCornellBox() const;

private:
  void AddLightAndMaterialTo(CLI::App& command);
  void ChooseLight(const std::string& name);
  std::vector<vtkSmartPointer<vtkDataObject>> ReadParts(
    std::optional<double> time, bool areFiles) const;
  void ApplyLight(vtkCSLFPathTracer* tracer) const;
  void RequireEnvironment() const;
  void SetMaterial(vtkDataObject* part) const;

  void TakeLight(const nlohmann::json& environment);
  bool IsFile(std::size_t input) const;

  std::vector<std::string> Inputs;
  SceneLook Look;
  std::optional<double> Roughness;
  std::optional<double> Metallic;
  std::optional<std::vector<double>> BaseColor;
  double PointRadius = options::PointRadius.Default;
  vtkSmartPointer<vtkCSLFEnvironment> Light = vtkSmartPointer<vtkCSLFEnvironment>::New();
  bool IsLightChosen = false; ///< otherwise it depends on the inputs
  double Exposure = options::Exposure.Default;
  int Colors = options::Colors.Default;
  int MaximumDepth = options::MaximumDepth.Default;
  CLI::App* Command = nullptr; ///< that light and material were added to
};
}

#endif
