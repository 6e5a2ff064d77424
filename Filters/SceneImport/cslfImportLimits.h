// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The list of differences between a light field and VTK's window. The warnings of
 * vtkCSLFSceneImporter and the table in Documentation/WindowAndBake.md are made from it.
 */
#ifndef cslfImportLimits_h
#define cslfImportLimits_h

#include "vtkCSLFModule.h" // for export macro

#include <map>
#include <set>
#include <string>

namespace cslf
{
/// The differences, in the order of the table. A new one needs its row in cslfImportLimits.cxx,
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
  StickEnds,
  Diagonals,
  Coplanar,
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
}

#endif
