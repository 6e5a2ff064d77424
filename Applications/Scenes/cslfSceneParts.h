// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reads the inputs of scenes: files of all kinds, collections and series of files, and scenes by
 * name.
 */
#ifndef cslfSceneParts_h
#define cslfSceneParts_h

#include <vtkDataObject.h>
#include <vtkSmartPointer.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

class vtkPolyData;

namespace cslf::tool
{
/// Whether a scene has that name, or a file's extension is that of scenes. Light fields may have
/// the same.
bool IsSceneName(const std::string& input);

/// Reads one file of a scene, or makes the scene of vtkCSLFSceneSource that has this name. Of a
/// file with time steps, reads the last one that is not later than the time, or the first one.
/// Throws a Failure if nothing is visible.
vtkSmartPointer<vtkDataObject> ReadScenePart(
  const std::string& input, std::optional<double> time = std::nullopt);

/// The times of a file, ascending. Empty if it has none. Throws a Failure.
std::vector<double> FindSceneTimes(const std::string& fileName);

/// Calls `visit` for each polydata of a data object.
void ForEachPolyData(vtkDataObject* part, const std::function<void(vtkPolyData*)>& visit);
}

#endif
