// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A field's geometry as streams of numbers, before they are compressed: see cslfGeometryCodec.h.
 */
#ifndef cslfGeometryStreams_h
#define cslfGeometryStreams_h

#include "cslfArrayCodes.h"
#include "cslfBodyGroups.h"
#include "cslfCube.h"
#include "cslfJSONForward.h"
#include "cslfMapCodes.h"

#include <vtkSmartPointer.h>

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

class vtkPolyData;

namespace cslf
{
/// The limits of the bits of a coordinate. Files that do not state them have the most.
constexpr int MaximumPositionBits = 16;
constexpr int MinimumPositionBits = 12;

/// Colours of bytes have this many steps: fewer if they are only for what no viewpoint sees.
constexpr int ExactSteps = 255;
constexpr int ColorSteps = 63;

/// The flags of exact colours, with padding.
constexpr std::size_t FlagsSize = 4;

/// Three coordinates and padding.
constexpr std::size_t PositionSize = 8;

/// The bytes of a colour's component.
constexpr std::size_t GetCodeSize(bool areHalves)
{
  return areHalves ? sizeof(std::uint16_t) : 1;
}

///@{
/// The kinds of colours.
constexpr const char* ByteColors = "srgb6";
constexpr const char* ExactByteColors = "srgb8";
constexpr const char* HalfColors = "linear16f";
constexpr const char* MappedColors = "light8"; ///< as srgb8, but those of mapped points are light
///@}

/// What the header calls the arrays.
constexpr const char* ArraysKey = "arrays";

/// The streams of a geometry before and after they are compressed.
struct GeometryStreams
{
  std::size_t Points = 0;
  std::vector<unsigned int> Corners;
  int PositionBits = MaximumPositionBits;
  glm::dvec3 Low{ -1.0 }; ///< the bounds of the positions in CC, which are exact
  glm::dvec3 High{ 1.0 };
  std::vector<unsigned char> Positions;
  std::vector<unsigned char> Colors;     ///< none if the geometry has none
  std::vector<unsigned char> BackColors; ///< none without others
  std::vector<unsigned char> Flags;      ///< none if no colour is exact
  bool AreHalves = false;
  bool HasFlags = false;
  BodyGroups Bodies;                     ///< their points and triangles come after the others
  MapCodes Maps;                         ///< with the points that are not those of bodies
  std::vector<unsigned char> BodyPlaces; ///< the others, as in MapCodes
  std::vector<ArrayCodes> Arrays;        ///< likewise; none without maps
  std::vector<std::vector<unsigned char>> BodyArrays;

  /// The streams of triangles, in files of fields with that resolution.
  static GeometryStreams Make(vtkPolyData* triangles, const Cube& box, int resolution);

  /// Takes the bodies that are one mesh at several places out of the streams. The colours of floats
  /// have no such form.
  void TakeBodies(vtkPolyData* geometry, vtkPolyData* triangles, const Cube& box);

  ///@{
  /// What the header says of them and of a geometry's field data, and the opposite.
  nlohmann::json Describe(vtkPolyData* geometry) const;
  vtkSmartPointer<vtkPolyData> ToPolyData(const nlohmann::json& header, const Cube& box) const;
  ///@}

  int GetColorSteps() const { return this->HasFlags ? ExactSteps : ColorSteps; }
  std::size_t GetColorSize() const { return 4 * GetCodeSize(this->AreHalves); }
  double GetPositionSteps() const { return (1 << this->PositionBits) - 1; }
};

///@{
/// Little-endian on all machines.
template <typename Value>
void StoreNumber(Value value, unsigned char* place)
{
  for (std::size_t byte = 0; byte < sizeof(Value); ++byte)
  {
    place[byte] = static_cast<unsigned char>(value >> (8 * byte));
  }
}

template <typename Value>
Value LoadNumber(const unsigned char* place)
{
  Value value = 0;
  for (std::size_t byte = 0; byte < sizeof(Value); ++byte)
  {
    value = static_cast<Value>(value | static_cast<Value>(place[byte]) << (8 * byte));
  }
  return value;
}
///@}

/// Adds or subtracts the codes of other colours, each modulo its range.
void CombineCodes(std::vector<unsigned char>& codes, const std::vector<unsigned char>& others,
  bool areHalves, int sign);

/// Adds green to red and blue, or subtracts it.
void CombineWithGreen(std::vector<unsigned char>& codes, bool areHalves, int sign);

/// Throws std::invalid_argument if a file is damaged.
void RequireSound(bool condition);
}

#endif
