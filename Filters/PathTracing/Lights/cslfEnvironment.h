// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Light from infinitely far away, from all directions.
 */
#ifndef cslfEnvironment_h
#define cslfEnvironment_h

#include "vtkCSLFModule.h" // for export macro

#include "RandomNumbers/cslfDistribution.h"
#include "cslfPointLight.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <string>
#include <vector>

namespace cslf
{
/// The transfer function of an image file, from the name of the colour space that OpenImageIO
/// reports. The names differ between its versions: "sRGB", "Linear", "Gamma2.2" up to 2.4; then
/// "lin_srgb" and "lin_rec709" as well; since 3.1 "srgb_rec709_scene", "lin_rec709_scene",
/// "g22_rec709_scene".
class VTKCSLF_EXPORT ImageCurve
{
public:
  /// The curve of a colour space. If the name is empty or does not define the curve, floats are
  /// linear and integers are sRGB. Primaries are assumed to be those of sRGB.
  ImageCurve(const std::string& colorSpace, bool isFloat);

  double ToLinear(double value) const;

private:
  bool IsSRGB = false;
  double Gamma = 1.0; // if it is not sRGB
};

/// The environment's axes in the world. `Right` is the world's x axis made perpendicular to `Up`,
/// as in a vtkRenderer with the default EnvironmentRight.
struct VTKCSLF_EXPORT EnvironmentAxes
{
  glm::vec3 Right{ 1.0f, 0.0f, 0.0f };
  glm::vec3 Up{ 0.0f, 1.0f, 0.0f };
  glm::vec3 Front{ 0.0f, 0.0f, 1.0f };

  /// `up` must not have length 0.
  static EnvironmentAxes FromUp(const glm::dvec3& up);
};

/// Light that varies linearly with the height of the direction's end.
struct SkyGradient
{
  glm::vec3 Bottom{ 0.0f };
  glm::vec3 Top{ 0.0f };
  glm::vec3 Up{ 0.0f, 1.0f, 0.0f };

  glm::vec3 Get(const glm::vec3& direction) const
  {
    const float height = 0.5f + 0.5f * glm::dot(direction, this->Up);
    return this->Bottom + height * (this->Top - this->Bottom);
  }
};

/// A linear lat-long image. Its first row is at the zenith.
struct EnvironmentImage
{
  int Width = 0;
  int Height = 0;
  std::vector<glm::vec3> Pixels;
};

/// Reads an image through OpenImageIO and makes it linear. On failure returns false and gives the
/// reason in one line.
VTKCSLF_EXPORT bool ReadEnvironmentImage(
  const std::string& fileName, EnvironmentImage& image, std::string& error);

/**
 * The radiance of every direction. A constant or a vertical gradient is left to the BSDF's own
 * samples: under a constant one, those of a diffuse or mirror surface have no noise except that of
 * visibility, which no sampling of the environment removes. An image is sampled in proportion to
 * its luminance.
 */
class VTKCSLF_EXPORT Environment
{
public:
  /// Darkness.
  Environment() = default;

  /// From `bottom` to `top`, linear in the height of the direction's end.
  Environment(const glm::vec3& bottom, const glm::vec3& top, const EnvironmentAxes& axes);

  /// A lat-long image oriented like VTK's environment textures: its middle column is the right
  /// axis, and the front axis is a quarter of the width further.
  Environment(EnvironmentImage image, float intensity, const EnvironmentAxes& axes);

  /// Whether Sample and Pdf are useful.
  bool CanSample() const { return this->Importance.GetTotal() > 0.0; }

  /// The image, without pixels if there is none.
  const EnvironmentImage& GetImage() const { return this->Image; }

  glm::vec3 GetRadiance(const glm::vec3& direction) const;

  /// The result of GetRadiance without an image.
  const SkyGradient& GetGradient() const { return this->Gradient; }

  const EnvironmentAxes& GetAxes() const { return this->Axes; }

  LightSample Sample(const glm::vec2& u) const;
  float Pdf(const glm::vec3& direction) const;

private:
  glm::vec2 ToImage(const glm::vec3& direction) const;
  glm::vec3 Interpolate(const glm::vec2& point) const;

  SkyGradient Gradient;
  EnvironmentAxes Axes;
  EnvironmentImage Image;
  Distribution2D Importance;
};
}

#endif
