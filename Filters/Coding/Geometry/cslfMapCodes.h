// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Colour maps, scalars and light of a geometry's points, as files store them.
 */
#ifndef cslfMapCodes_h
#define cslfMapCodes_h

#include "Pipeline/cslfColorMap.h"
#include "cslfJSONForward.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cslf
{
class MapCodes
{
public:
  /// Two bytes of a place on a map, the number of the map or 0, and 0.
  static constexpr std::size_t PointSize = 4;

  MapCodes() = default;
  explicit MapCodes(const MappedPoints& points);

  bool IsEmpty() const { return this->Maps.empty(); }

  /// Replaces the colours of mapped points on a side, of four bytes, by their light.
  void PutLight(const MappedPoints& points, int side, std::vector<unsigned char>& colors) const;

  ///@{
  /// What the header says of the maps, and the opposite. Throws std::exception.
  void Describe(nlohmann::json& header) const;
  static MapCodes Read(const nlohmann::json& header);
  ///@}

  ///@{
  /// The colours of all maps as bytes that compress well, their number, and the opposite.
  std::vector<unsigned char> PackColors() const;
  std::size_t GetColorSize() const;
  void UnpackColors(const unsigned char* bytes);
  ///@}

  /// The points, with light from codes of colours as in PutLight. Throws std::exception.
  MappedPoints GetPoints(
    const std::vector<unsigned char>& colors, const std::vector<unsigned char>& backColors) const;

  std::vector<unsigned char> Points; ///< of PointSize bytes

private:
  static constexpr int MaximumSteps = 255;

  /// How places on a map become numbers.
  struct Scale
  {
    double First = 0.0; ///< columns
    double Last = 0.0;
    int Bits = 0;

    /// The largest number, which is what is not a number. Others are smaller.
    int GetNone() const { return (1 << this->Bits) - 1; }
    std::uint16_t ToCode(const glm::dvec2& place) const;
    glm::dvec2 ToPlace(int code, const ColorMap& map) const;
  };

  void Fit(const MappedPoints& points);

  std::vector<ColorMap> Maps;
  std::vector<Scale> Scales; // of the maps
  double MaximumLight = 1.0; // sRGB-encoded
  int LightSteps = MaximumSteps;
};
}

#endif
