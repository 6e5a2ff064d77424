// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The list of differences between a light field and VTK's window. The warnings of
 * vtkCSLFSceneImporter and the table in Documentation/WindowAndBake.md are made from it.
 */
#ifndef cslfImportedScene_h
#define cslfImportedScene_h

#include "SceneData/cslfMaterialProblems.h"
#include "cslfJoin.h"
#include "vtkCSLFModule.h" // for export macro

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <vtkBoundingBox.h>
#include <vtkDataSet.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>
#include <vtkType.h>

namespace cslf
{
/// The differences, in the order of the table. A new one needs its row in cslfImportedScene.cxx,
/// which does not compile without it.
enum class ImportLimit
{
  // Props.
  OtherProps,
  OtherMappers,
  NoGeometry,
  SourceTableTrees,
  GraphIcons,
  Splats,
  Followers,
  // Surfaces.
  Shaders,
  ProjectiveMatrices,
  ForcedOpaque,
  BackfaceProperties,
  CulledEdges,
  ClippedLines,
  Coats,
  Anisotropy,
  PartMetals,
  OpposedNormals,
  Layers,
  PropertyTextures,
  TexturedTables,
  Widths,
  LineNormals,
  StickEnds,
  Diagonals,
  Coplanar,
  // Volumes.
  VolumeBlending,
  VolumeGradients,
  VolumeMasks,
  VolumeCropping,
  DependentComponents,
  IndependentComponents,
  ResampledVolumes,
  VolumeShading,
  VolumeSurfaces,
  // Lights.
  CubeMapEnvironments,
  EnvironmentImages,
  ClassicEnvironments,
  RenderPasses,
  Shadows,
  Shading,
  Highlights,
  UnlitLines,
  Headlights,
  Count
};

/// A row of the table.
struct ImportLimitText
{
  ImportLimit Limit;
  const char* Name;   ///< as named in the warning
  const char* Window; ///< the appearance in VTK's window
  const char* Bake;   ///< the appearance in the light field
  bool Warned; ///< whether importing such a scene gives a warning; otherwise the difference always
               ///< exists
};

/// The row of a limit.
VTKCSLF_EXPORT const ImportLimitText& GetText(ImportLimit limit);

/// The limits that an import has met, with details such as the classes of props.
using MetLimits = std::map<ImportLimit, std::set<std::string>>;

/// The limits as the text of a warning.
std::string ToText(const MetLimits& limits);

/// The window's parameters for a block, which FinishAppearances converts to a material.
struct BlockAppearance
{
  vtkSmartPointer<vtkProperty> Property;      ///< null if the material is complete
  vtkSmartPointer<vtkTexture> Texture;        ///< the actor's
  std::optional<std::array<double, 3>> Color; ///< replaces the property's
  double Opacity = 1.0;
  bool HasTable = false; ///< whether the block's texture is that of a lookup table
  bool IsUnlit = false;  ///< whether the window shows only its colours, without lights
};

/// Polygonal data with its material, and the widths of its lines and points.
struct ImportedBlock
{
  vtkSmartPointer<vtkPolyData> Data;
  double LineWidth = 1.0; ///< in pixels
  double PointSize = 1.0;
  BlockAppearance Appearance;
};

struct ImportedScene
{
  std::vector<ImportedBlock> Blocks;
  std::vector<vtkSmartPointer<vtkDataSet>> Volumes; ///< with the arrays of vtkCSLFVolume
  vtkBoundingBox VolumeBounds;                      ///< of the volumes, in the world
  vtkNew<vtkMultiBlockDataSet> Lights;              ///< lights and environment, as field data
  bool HasExactColors = false; ///< whether blocks get their own colours, without lights
  std::function<bool(const char* array)> KeepsArray; ///< whether blocks keep it; may be empty
  bool HasEnvironment = false;                       ///< whether an image lights it
  MetLimits Limits;                                  ///< parts that a renderer shows differently
  std::set<std::string> Omitted; ///< other parts that cannot be represented, in words
  vtkIdType BrokenGlyphs = 0;    ///< with positions or indices of sources that are not finite

  MaterialProblems
    Materials; ///< of materials that the data contains; values are checked when the scene is traced

  /// Records a limit, perhaps with a detail such as the class of a prop.
  void Meet(ImportLimit limit, const std::string& detail = std::string())
  {
    std::set<std::string>& details = this->Limits[limit];
    if (!detail.empty())
    {
      details.insert(detail);
    }
  }

  /// The parts that cannot be represented, separated by commas.
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
