// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * From VTK's data objects to the scene that is traced.
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
  /// Finds the array that colours a block's surface, or null; says whether it is of the cells.
  std::function<vtkDataArray*(vtkPolyData*, bool& ofCells)> FindScalars;

  /// What maps arrays that hold no colours; null for the array's own, or a default one.
  vtkScalarsToColors* LookupTable = nullptr;

  Environment Surroundings; ///< unless an input brings its own

  /// Whether the inputs are pieces, cut no matter how, of a scene that is to be the same always.
  bool InPieces = false;

  /// Of each input, the rank that it comes from, in ascending order; empty if all come from one.
  std::vector<int> Ranks;
};

struct BuiltScene
{
  std::unique_ptr<Scene> World; ///< null where the scene cannot be used
  SceneFrame Frame;
  double Bounds[6] = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 }; ///< of the triangles, in the world
  bool HasEnvironment = false;                         ///< whether an input brought it
  bool IsEmpty = false;                                ///< whether there is nothing to be seen
  std::string Error;                                   ///< why not, in one line
  std::string Warning;                                 ///< what was left out, in one line, or empty
  std::string Fingerprint; ///< tells the scene from others: a hash of all that is seen of it
};

/// Builds the scene of polygonal data and composite data sets of such.
VTKCSLF_EXPORT BuiltScene BuildScene(
  const std::vector<vtkDataObject*>& inputs, const SceneOptions& options);
}

#endif
