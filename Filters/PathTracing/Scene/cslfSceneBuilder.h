// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Converts VTK's data objects to the traced scene.
 */
#ifndef cslfSceneBuilder_h
#define cslfSceneBuilder_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfScene.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkPolyData;
class vtkScalarsToColors;

namespace cslf
{
struct SceneOptions
{
  /// Finds the array that colours a block's surface, or null, and whether it belongs to the cells.
  std::function<vtkDataArray*(vtkPolyData*, bool& ofCells)> FindScalars;

  /// Whether geometries keep arrays of that name. May be empty: then they keep none.
  std::function<bool(const std::string& array)> KeepsArray;

  /// Maps arrays that contain no colours. Null for the array's own table, or a default one.
  vtkScalarsToColors* LookupTable = nullptr;

  /// Whether surfaces show their own colours instead of light.
  bool ExactColors = false;

  Environment Surroundings; ///< unless an input has its own

  ///@{
  /// The progress of reading the inputs, and then of building the tree. May be empty.
  Progress Reading;
  Progress Building;
  ///@}

  /// Whether the inputs are pieces of a scene that must not depend on the division into pieces.
  bool InPieces = false;

  /// The rank of each input, in ascending order. Empty if all come from one.
  std::vector<int> Ranks;
};

struct BuiltScene
{
  std::unique_ptr<Scene> World; ///< null if the scene cannot be used
  SceneFrame Frame;
  double Bounds[6] = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 }; ///< of all shapes, in the world
  bool HasEnvironment = false;                         ///< whether an input contains it
  bool IsEmpty = false;                                ///< whether nothing is visible
  bool IsAborted = false;                              ///< whether a progress has ended the work
  std::string Error;                                   ///< the reason, in one line
  std::string Warning;                                 ///< the omitted parts, in one line, or empty
  std::string ArraysFingerprint; ///< identifies the arrays that a geometry keeps
  std::string Fingerprint;       ///< identifies the scene: a hash of everything visible
};

/// Builds the scene from polygonal data and composite data sets of polygonal data and volumes.
VTKCSLF_EXPORT BuiltScene BuildScene(
  const std::vector<vtkDataObject*>& inputs, const SceneOptions& options);

/// The bounds of that scene, with the radii of lines and points, without building it. False if
/// there is nothing to trace.
VTKCSLF_EXPORT bool FindSceneBounds(const std::vector<vtkDataObject*>& inputs, double bounds[6]);
}

#endif
