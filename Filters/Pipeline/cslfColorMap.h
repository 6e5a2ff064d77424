// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How scalars become the base colours of surfaces, and the points of a geometry that have such.
 */
#ifndef cslfColorMap_h
#define cslfColorMap_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfMapImage.h"
#include "cslfSurfaceArray.h"

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkLookupTable;
class vtkPolyData;
class vtkScalarsToColors;

namespace cslf
{
/// What ColorMap::Component says of magnitudes.
constexpr const char* MagnitudeName = "Magnitude";

/// A lookup table as a row of colours. Scalars are interpolated before they are mapped, like VTK's
/// with vtkMapper::InterpolateScalarsBeforeMapping.
struct VTKCSLF_EXPORT ColorMap
{
  using Pixel = std::array<std::uint8_t, 4>; ///< red, green and blue, sRGB-encoded, and alpha

  std::string Array;     ///< the name of the scalars' array
  std::string Component; ///< which component, or Magnitude; empty if the array has only one
  double Range[2] = { 0.0, 1.0 };
  bool IsLogarithmic = false;
  std::vector<Pixel> Colors; ///< below the range, in equal steps within it, and above it
  Pixel NanColor{};          ///< of scalars that are not numbers

  /// Whether it has no scalars, but stands for the one colour of a surface: so light is apart from
  /// that, too.
  bool IsOneColor = false;

  /// If its width is not 0, an image takes the place of scalars and colours: see TexturePlacesName.
  /// The image is null where only this was read.
  MapImage::Layout Layout;
  std::shared_ptr<const MapImage> Image;

  bool IsImage() const { return this->Layout.Width > 0; }
  bool HasScalars() const { return !this->IsOneColor && !this->IsImage(); }

  int GetSteps() const { return static_cast<int>(this->Colors.size()) - 2; }
  bool IsOpaque() const;

  /// Array and component, as the name of an array.
  std::string GetScalarName() const;

  /// Between a value and what is not a number, there is no number from this share of the way on: as
  /// with VTK's mappers, whose texture coordinates 0.49 and 1 mean these, and 0.5 no number.
  static constexpr double NanShare = 0.02;

  /// A place on the map, which is interpolated linearly: first the column, from 1 at the beginning
  /// of the range to 1 + steps at its end, then 0, or 1 for values that are not numbers. Those on
  /// images are told by MapImage.
  glm::dvec2 GetPlace(double value) const;

  /// The value at a place.
  double GetValue(const glm::dvec2& place) const;

  /// By how much colours change at most, as the root mean square of sRGB-encoded components, for
  /// each column, over parts of the range that are not too short.
  double GetSteepness() const;

  /// The colour at a place, between colours the nearest, linear.
  glm::vec3 GetColor(const glm::dvec2& place) const;
};

/// The array of points whose two components are places on images, in steps of MapImage.
constexpr const char* TexturePlacesName = "CSLF:TexturePlaces";

/// The map that is an image.
ColorMap VTKCSLF_EXPORT MakeImageMap(std::shared_ptr<const MapImage> image);

/// The map that stands for one colour, sRGB-encoded.
ColorMap VTKCSLF_EXPORT MakeOneColor(const ColorMap::Pixel& color);

/// The name of an array of scalars in a geometry, which has arrays of its own.
std::string VTKCSLF_EXPORT NameScalars(const std::string& array);

/// The map of a lookup table, without names. It has no colours if the table is one of categories or
/// has no range.
VTKCSLF_EXPORT ColorMap MakeColorMap(vtkScalarsToColors* table);

/// The name of a component of an array, or of the magnitude if it is negative. Empty for arrays of
/// one component.
std::string VTKCSLF_EXPORT NameComponent(vtkDataArray* array, int component);

///@{
/// A lookup table that maps like a map: a new one, or one that was made so before.
VTKCSLF_EXPORT vtkSmartPointer<vtkLookupTable> MakeLookupTable(const ColorMap& map);
void UpdateLookupTable(const ColorMap& map, vtkLookupTable* table);
///@}

///@{
/// Says as JSON what maps are, without their colours, and the opposite, which throws
/// std::exception.
std::string VTKCSLF_EXPORT DescribeColorMap(const ColorMap& map);
ColorMap VTKCSLF_EXPORT ReadColorMap(const std::string& text);
///@}

///@{
/// Gives data maps with their colours, as field data, and reads them. None if it has none, or if
/// they do not fit.
void VTKCSLF_EXPORT AddColorMaps(const std::vector<ColorMap>& maps, vtkDataObject* data);
std::vector<ColorMap> VTKCSLF_EXPORT FindColorMaps(vtkDataObject* data);
///@}

/// The points of a geometry whose colours a map tells: see ColorMapName in cslfGeometryArrays.h.
struct MappedPoints
{
  std::vector<ColorMap> Maps;
  std::vector<std::uint8_t> Numbers; ///< of each point: 0 without a map, or 1 for the first
  std::vector<double> Scalars;       ///< of each point

  /// Other arrays, of all points.
  std::vector<SurfaceArray> Arrays;

  /// Of each point, on the front and on the back, the light that a white surface would reflect to
  /// everywhere, times exposure, sRGB-encoded, and above 1 by the same formula. Values between
  /// points are interpolated so.
  std::array<std::vector<glm::vec3>, 2> Light;

  bool IsEmpty() const { return this->Maps.empty(); }
  bool Has(std::size_t point) const { return !this->Numbers.empty() && this->Numbers[point] > 0; }
  const ColorMap& GetMap(std::size_t point) const { return this->Maps[this->Numbers[point] - 1]; }
  glm::dvec2 GetPlace(std::size_t point) const
  {
    const ColorMap& map = this->GetMap(point);
    return map.IsImage() ? this->GetTexturePlace(point) : map.GetPlace(this->Scalars[point]);
  }

  /// The array of places on images, or null.
  const SurfaceArray* FindTexturePlaces() const;
  glm::dvec2 GetTexturePlace(std::size_t point) const;
};

/// The colour of a surface with interpolated light, sRGB-encoded.
glm::dvec3 VTKCSLF_EXPORT ShowLight(
  const glm::dvec3& light, const ColorMap& map, const glm::dvec2& place);

/// The colour at a place of a triangle, sRGB-encoded. The corners are mapped points with one map,
/// and `weights` the barycentric coordinates.
glm::dvec3 VTKCSLF_EXPORT ShowPlace(const MappedPoints& points, int side,
  const std::array<std::size_t, 3>& corners, const glm::dvec3& weights);

///@{
/// Gives a geometry the arrays that tell of mapped points, one for each of its points, and reads
/// them. None if it has none, or if they do not fit.
void VTKCSLF_EXPORT AddMappedPoints(const MappedPoints& points, vtkPolyData* geometry);
MappedPoints VTKCSLF_EXPORT FindMappedPoints(vtkPolyData* geometry);
///@}
}

#endif
