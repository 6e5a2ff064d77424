// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What an import has gathered so far.
 */
#ifndef cslfImportedScene_h
#define cslfImportedScene_h

#include "PathTracing/cslfMaterialProblems.h"
#include "PathTracing/cslfOldNames.h"
#include "cslfImportLimits.h"
#include "cslfJoin.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>
#include <vtkType.h>

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace cslf
{
/// What the window draws a block by. FinishLooks makes its material of it.
struct BlockLook
{
  vtkSmartPointer<vtkProperty> Property;      ///< null where the material is complete
  vtkSmartPointer<vtkTexture> Texture;        ///< the actor's
  std::optional<std::array<double, 3>> Color; ///< in place of the property's
  double Opacity = 1.0;
  bool HasTable = false; ///< whether the block's texture is that of a lookup table
  bool IsUnlit = false;  ///< whether the window shows its colours alone
};

/// Polygonal data with its material, and how wide its lines and points are drawn.
struct ImportedBlock
{
  vtkSmartPointer<vtkPolyData> Data;
  double LineWidth = 1.0; ///< in pixels
  double PointSize = 1.0;
  BlockLook Look;
};

struct ImportedScene
{
  std::vector<ImportedBlock> Blocks;
  vtkNew<vtkMultiBlockDataSet> Lights; ///< lights and environment, as field data
  bool HasEnvironment = false;         ///< whether an image lights it
  MetLimits Limits;                    ///< what a renderer shows in another way
  std::set<std::string> Omitted;       ///< what else cannot be represented, in words
  vtkIdType BrokenGlyphs = 0;          ///< with places or indices of sources that are not finite

  OldNames Old;               ///< of materials that data brings along
  MaterialProblems Materials; ///< likewise; values are checked when the scene is traced

  /// Notes a limit, perhaps with a detail such as the class of a prop.
  void Meet(ImportLimit limit, const std::string& detail = std::string())
  {
    std::set<std::string>& details = this->Limits[limit];
    if (!detail.empty())
    {
      details.insert(detail);
    }
  }

  /// What cannot be represented, with commas.
  std::string ListOmitted() const
  {
    std::set<std::string> all = this->Omitted;
    if (this->BrokenGlyphs > 0)
    {
      all.insert(std::to_string(this->BrokenGlyphs) +
        " glyph(s) with a place, orientation, scale or index that is not finite");
    }
    return Join(all);
  }
};
}

#endif
