// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The colours of points or cells, from arrays of colours or through lookup tables, and the textures
 * of vtkCSLFMaterial as those of the tracer.
 */
#ifndef cslfSurfaceColors_h
#define cslfSurfaceColors_h

#include "PathTracing/Materials/cslfTexture.h"
#include "PathTracing/Shapes/cslfMesh.h"
#include "Pipeline/cslfColorMap.h"

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

class vtkDataArray;
class vtkLookupTable;
class vtkScalarsToColors;
class vtkUnsignedCharArray;

namespace cslf
{
struct MappedColors
{
  std::vector<glm::vec3> Colors; ///< linear
  std::vector<float> Opacities;  ///< empty if all are 1
};

/// A lookup table as a texture, for scalars that are interpolated before they are mapped.
struct MappedTable
{
  std::shared_ptr<const ColorMap> Map; ///< null if the array must be mapped first
  std::shared_ptr<const Texture> Colors;
  std::string Name;              ///< identifies the map
  std::vector<glm::vec2> Places; ///< of the array's tuples, on the texture
};

/// Maps the arrays of all blocks of a scene in the same way.
class SurfaceColors
{
public:
  /// `lookupTable` may be null.
  explicit SurfaceColors(vtkScalarsToColors* lookupTable);

  /// Announces an array: arrays without a lookup table share a default one over all their values.
  void AddToRange(vtkDataArray* array);

  /// Whether an array or its lookup table contains colours.
  bool CanMap(vtkDataArray* array) const;

  /// A colour for each tuple of an array that can be mapped. Unsigned chars of 3 or 4 components
  /// are sRGB colours themselves; all other arrays are mapped. Threads may call it at once.
  MappedColors Map(vtkDataArray* array);

  /// The table and the places on it of an array that can be mapped, unless it holds colours or its
  /// table is one of categories or has no range. Threads may call it at once.
  MappedTable FindPlaces(vtkDataArray* array);

private:
  /// Null for the default one.
  vtkScalarsToColors* FindTable(vtkDataArray* array) const;

  /// The default one as well.
  vtkScalarsToColors* GetTable(vtkDataArray* array);

  vtkSmartPointer<vtkUnsignedCharArray> MapThroughTable(vtkDataArray* array);

  vtkScalarsToColors* LookupTable;
  vtkSmartPointer<vtkLookupTable> DefaultTable;
  double Range[2];
  /// The maps of tables, without names, and their textures.
  std::map<vtkScalarsToColors*, std::pair<ColorMap, std::shared_ptr<const Texture>>> Maps;
  std::mutex Mapping; ///< tables do not allow several threads
};
}

class vtkDataObject;

namespace cslf
{
/// The CSLF:DisplayedWhite of a material; 0 in all components unless all are above 0.
glm::vec3 GetDisplayedWhite(vtkDataObject* material);

/// Reads each image once, even if many blocks share its pixels.
class TextureReader
{
public:
  MaterialTextures Read(vtkDataObject* material);

private:
  using Key = std::tuple<const void*, int, int, int, TextureWrap, TextureWrap, bool,
    std::array<std::uint8_t, 4>, TextureKind, float, float, float>;

  std::shared_ptr<const Texture> ReadSlot(vtkDataObject* material, int slot, TextureKind kind);

  /// The textures and their pixels, which are kept because the address of freed pixels could be
  /// reused.
  std::map<Key, std::pair<vtkSmartPointer<vtkDataArray>, std::shared_ptr<const Texture>>> Known;
};
}

#endif
