// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A scene whose pieces lie on several ranks, brought together on each.
 */
#ifndef cslfSceneGather_h
#define cslfSceneGather_h

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkDataObject;
class vtkMultiProcessController;

namespace cslf
{
/// All ranks' inputs, in the order of the ranks. Field data describes the whole of an object, so
/// pieces may repeat it: the lights of an object, or of one leaf of a composite one, are taken from
/// the first rank that has some there. All ranks call it together. On failure returns false and
/// says why, in a sentence.
bool GatherScene(vtkMultiProcessController* controller, const std::vector<vtkDataObject*>& inputs,
  std::vector<vtkSmartPointer<vtkDataObject>>& scene, std::string& error);
}

#endif
