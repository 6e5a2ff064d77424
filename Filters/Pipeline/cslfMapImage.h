// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Images that give surfaces their base colours.
 */
#ifndef cslfMapImage_h
#define cslfMapImage_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfJSONForward.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace cslf
{
/**
 * An opaque image whose pixels are sRGB-encoded. Places on it are measured in pixels from its lower
 * left corner, so that the middle of the first pixel is (0.5, 0.5). Beyond its edges it repeats, or
 * they go on. Never changes: others have another address.
 */
class VTKCSLF_EXPORT MapImage
{
public:
  using Pixel = std::array<std::uint8_t, 4>;

  struct Layout
  {
    int Width = 0;
    int Height = 0;
    std::array<bool, 2> Repeats{}; ///< along x, along y
    int Steps = 16;                ///< of a pixel, of which places of points are multiples
    bool IsSmooth = true;  ///< bilinear interpolation of linear values; else a pixel has one colour
    bool IsJPEG = false;   ///< how it is encoded
    std::size_t Bytes = 0; ///< of the encoded image
  };

  /// Encodes an image of linear colours, given that of a place: as planes of differences, or as
  /// JPEG if that takes fewer bytes after compression and changes colours little. Its pixels are
  /// those that decoders find. Of the layout, what says how it is encoded does not matter.
  static std::shared_ptr<const MapImage> Make(
    const Layout& layout, const std::function<glm::vec3(const glm::dvec2& place)>& getColor);

  /// Decodes it. Throws std::exception if the bytes do not fit.
  static std::shared_ptr<const MapImage> Read(
    const Layout& layout, std::vector<unsigned char> encoded);

  ///@{
  /// Says as JSON what it is, without its pixels, and the opposite, which throws std::exception.
  static void Describe(const Layout& layout, nlohmann::json& json);
  static Layout ReadLayout(const nlohmann::json& json);
  ///@}

  const Layout& GetLayout() const { return this->Own; }

  /// The bytes of a JPEG file without more than one scan of all components; or the red, green and
  /// blue components of all pixels, each less that of the pixel before, modulo 256.
  const std::vector<unsigned char>& GetEncoded() const { return this->Encoded; }

  /// Rows from the lowest to the highest.
  const std::vector<Pixel>& GetPixels() const { return this->Pixels; }

  /// The colour at a place, linear.
  glm::vec3 GetColor(const glm::dvec2& place) const;

private:
  const Pixel& Get(double column, double row) const;

  Layout Own;
  std::vector<unsigned char> Encoded;
  std::vector<Pixel> Pixels;
};
}

#endif
