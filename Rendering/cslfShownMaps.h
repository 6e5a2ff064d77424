// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The maps in which the mapped points of a geometry are shown: its own, or those that a mapper's
 * user asks for.
 */
#ifndef cslfShownMaps_h
#define cslfShownMaps_h

#include "Pipeline/cslfColorMap.h"
#include "Pipeline/cslfSurfaceArray.h"
#include "cslfDescription.h"

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

class vtkPolyData;
class vtkScalarsToColors;

namespace cslf
{
struct GeometryMesh;

/// What a map shows instead of the scalars of its points.
struct ShownArray
{
  int Number = -1;   ///< of the array, or negative for the scalars
  int Component = 0; ///< negative for the magnitude

  bool operator==(const ShownArray& other) const
  {
    return this->Number == other.Number && this->Component == other.Component;
  }
};

/// Maps, with their colours as an image. Never changes: others have another address.
class ShownMaps
{
public:
  /// Given what each map shows.
  ShownMaps(std::vector<ColorMap> maps, std::vector<ShownArray> arrays);

  const std::vector<ColorMap>& GetMaps() const { return this->Maps; }

  /// What each map shows.
  const std::vector<ShownArray>& GetArrays() const { return this->Arrays; }

  /// Whether points have the same places on both.
  bool HasPlacesOf(const ShownMaps& other) const;

  /// The place of a point on its map; none without a map.
  glm::vec2 GetPlace(const MappedPoints& points, std::size_t point) const;

  /// Of each point the place on its map, and the number of the map, from 0, or -1 without one.
  std::vector<glm::vec3> ListPlaces(const MappedPoints& points) const;

  ///@{
  /// Linear colours: of each map a row of its columns, and one of what is not a number. Rows are
  /// filled up with their last colour. Of images there are the place of the first pixel among those
  /// of all images, and the size; then whether each axis repeats, whether the image is smooth,
  /// and 2.
  int GetWidth() const { return this->Width; }
  int GetHeight() const { return 2 * static_cast<int>(this->Maps.size()); }
  const std::vector<glm::vec4>& GetImage() const { return this->Image; }
  ///@}

  ///@{
  /// The pixels of all images beside each other. None without images.
  int GetPixelWidth() const { return this->PixelWidth; }
  int GetPixelHeight() const { return this->PixelHeight; }
  const std::vector<MapImage::Pixel>& GetPixels() const { return this->Pixels; }
  ///@}

  /// The colour at a place of a map, as ColorMap::GetColor.
  glm::vec3 GetColor(std::size_t map, const glm::vec2& place) const;

private:
  void PlaceImages();

  std::vector<ColorMap> Maps;
  std::vector<ShownArray> Arrays; // of the maps
  int Width = 1;
  std::vector<glm::vec4> Image;
  int PixelWidth = 0;
  int PixelHeight = 0;
  std::vector<MapImage::Pixel> Pixels;
};

/// What a mapper shows of an actor by the geometry alone, for exporters.
struct ShownGeometry
{
  Description Field;
  vtkPolyData* Geometry = nullptr;
  std::shared_ptr<const GeometryMesh> Mesh;
  std::shared_ptr<const ShownMaps> Maps; ///< null without mapped points
};

/// What a mapper's user asks for.
struct MapChoice
{
  vtkScalarsToColors* Table = nullptr;        ///< instead of the maps' colours
  vtkMTimeType TableTime = 0;                 ///< when it was changed last
  bool UsesTableRange = false;                ///< if there is one
  std::optional<std::array<double, 2>> Range; ///< otherwise, instead of the maps' own
  std::string Array;                          ///< that is meant; empty for the scalars of all maps
  int Component = 0;                          ///< of that, unless its text tells
  std::optional<glm::dvec3> Plain;            ///< a colour, sRGB-encoded, instead of all maps

  bool operator==(const MapChoice& other) const;

  bool Selects(const ColorMap& map) const;
};

/// The component of arrays that a table maps; negative for the magnitude.
int GetTableComponent(vtkScalarsToColors* table);

/// A lookup table that maps like a map, unless somebody else changes it.
class MapTable
{
public:
  MapTable();

  vtkLookupTable* Get() const { return this->Table; }

  /// Whether somebody else has changed it.
  bool IsChanged() const;

  /// Makes it that of a map over another range, if this can be, unless it is changed.
  void Update(const ColorMap& map, const double range[2]);

private:
  vtkSmartPointer<vtkLookupTable> Table;
  vtkMTimeType Time = 0; ///< when it was made
  ColorMap Map;
};

/// Applies choices to the maps of a geometry. Keeps what it has made, because actors that share a
/// mapper may choose in turn.
class MapChooser
{
public:
  /// Null without geometry or mapped points. The same object for the same choice. `problem` says
  /// why something that was chosen for the first time is not shown; otherwise it is not changed.
  std::shared_ptr<const ShownMaps> Choose(const std::shared_ptr<const GeometryMesh>& geometry,
    const MapChoice& choice, std::string& problem);

  /// The map in which the field itself shows what a choice selects: the first one of its scalars,
  /// or for other arrays the first colours there are, over the range of the array. There must be
  /// mapped points.
  const ColorMap& FindMap(
    const std::shared_ptr<const GeometryMesh>& geometry, const MapChoice& choice);

private:
  /// Other arrays that were selected.
  struct KnownArray
  {
    std::string Text;
    int Component = 0;
    ShownArray Array;
    ColorMap Map;
    std::vector<char> HasMap; ///< whether points with each map have the array
  };

  void SetGeometry(const std::shared_ptr<const GeometryMesh>& geometry);
  const KnownArray* FindArray(const MapChoice& choice);

  std::shared_ptr<const GeometryMesh> Geometry;
  std::vector<std::unique_ptr<KnownArray>> Known;
  std::vector<std::pair<MapChoice, std::shared_ptr<const ShownMaps>>> Made;
};
}

#endif
