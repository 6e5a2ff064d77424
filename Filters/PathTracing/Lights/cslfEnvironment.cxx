// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfEnvironment.h"

#include "Images/cslfImageFiles.h"
#include "RandomNumbers/cslfSampling.h"
#include "cslfColor.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

namespace cslf
{
namespace
{
bool StartsWith(const std::string& text, const char* prefix)
{
  return text.rfind(prefix, 0) == 0;
}

/// The exponent in a name such as "gamma2.2" or "g22_rec709_scene"; 0 for other names.
double FindGamma(const std::string& name)
{
  if (StartsWith(name, "gamma"))
  {
    // Not strtod, which takes the decimal comma of the program's language.
    double gamma = 0.0;
    std::from_chars(name.data() + 5, name.data() + name.size(), gamma);
    return gamma;
  }
  const bool isShort = name.size() > 2 && name[0] == 'g' && std::isdigit(name[1]) &&
    std::isdigit(name[2]) && (name.size() == 3 || name[3] == '_');
  return isShort ? (10 * (name[1] - '0') + (name[2] - '0')) / 10.0 : 0.0;
}
}

ImageCurve::ImageCurve(const std::string& colorSpace, bool isFloat)
  : IsSRGB(!isFloat)
{
  std::string name = colorSpace;
  std::transform(name.begin(), name.end(), name.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  const double gamma = FindGamma(name);
  // The curve of Rec. 709 video is close to sRGB's.
  if (StartsWith(name, "srgb") || name == "rec709")
  {
    this->IsSRGB = true;
  }
  else if (std::isfinite(gamma) && gamma > 0.0)
  {
    this->IsSRGB = false;
    this->Gamma = gamma;
  }
  else if (StartsWith(name, "lin") || name == "scene_linear" || name == "acescg" ||
    StartsWith(name, "aces2065") || name == "raw" || name == "data")
  {
    this->IsSRGB = false;
  }
}

double ImageCurve::ToLinear(double value) const
{
  if (this->IsSRGB)
  {
    return SRGBToLinear(value);
  }
  return this->Gamma == 1.0 ? value : std::pow(std::max(value, 0.0), this->Gamma);
}

namespace
{
/// More are refused, so that a file cannot ask for much memory: twice as many as 16K images have.
constexpr std::size_t MaximumPixels = std::size_t(1) << 28;

/// The integral of the interpolated image over each pixel, times the pixel's solid angle. It is
/// above 0 wherever the image is.
std::vector<double> MakeImportance(const EnvironmentImage& image)
{
  const int width = image.Width;
  const int height = image.Height;
  const auto luminance = [&](int x, int y)
  {
    const int row = std::clamp(y, 0, height - 1);
    const int column = (x + width) % width;
    return double(Luminance(image.Pixels[std::size_t(row) * width + column]));
  };
  constexpr double kernel[3] = { 0.125, 0.75, 0.125 };
  std::vector<double> weights(image.Pixels.size(), 0.0);
  for (int y = 0; y < height; ++y)
  {
    const double solidAngle = std::cos(Pi * y / height) - std::cos(Pi * (y + 1) / height);
    for (int x = 0; x < width; ++x)
    {
      double sum = 0.0;
      for (int j = 0; j < 3; ++j)
      {
        for (int i = 0; i < 3; ++i)
        {
          sum += kernel[i] * kernel[j] * luminance(x + i - 1, y + j - 1);
        }
      }
      weights[std::size_t(y) * width + x] = sum * solidAngle;
    }
  }
  return weights;
}

/// Whether no component is NaN.
bool IsDirection(const glm::vec3& direction)
{
  return std::isfinite(direction.x + direction.y + direction.z);
}
}

EnvironmentAxes EnvironmentAxes::FromUp(const glm::dvec3& up)
{
  const glm::dvec3 unit = glm::normalize(up);
  glm::dvec3 right = glm::dvec3(1.0, 0.0, 0.0) - unit.x * unit;
  if (glm::length(right) < 1e-6)
  {
    right = glm::dvec3(0.0, 0.0, 1.0) - unit.z * unit;
  }
  right = glm::normalize(right);
  return { glm::vec3(right), glm::vec3(unit), glm::vec3(glm::cross(right, unit)) };
}

bool ReadEnvironmentImage(const std::string& fileName, EnvironmentImage& image, std::string& error)
{
  std::string reason;
  const auto input = OpenImage({ fileName }, reason);
  if (!input)
  {
    error = "The environment image \"" + fileName + "\" cannot be read: " + reason;
    return false;
  }
  const ImageHeader& header = input->GetHeader();
  const std::size_t count = std::size_t(header.Width) * header.Height;
  if (count > MaximumPixels)
  {
    error = "The environment image \"" + fileName + "\" has more than " +
      std::to_string(MaximumPixels) + " pixels.";
    return false;
  }
  std::vector<float> values(count * header.Channels);
  if (values.empty() || !input->Read(PixelType::Floats, values.data(), reason))
  {
    error = "The environment image \"" + fileName + "\" cannot be read: " + reason;
    return false;
  }
  image.Width = header.Width;
  image.Height = header.Height;
  image.Pixels.resize(count);
  const auto space = header.Attributes.find(ColorSpaceAttribute);
  const ImageCurve curve(
    space == header.Attributes.end() ? std::string() : space->second, header.HasFloats);
  for (std::size_t i = 0; i < count; ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      const float value = values[i * header.Channels + (header.Channels >= 3 ? c : 0)];
      const auto linear = static_cast<float>(curve.ToLinear(value));
      image.Pixels[i][c] = std::isfinite(linear) ? std::max(linear, 0.0f) : 0.0f;
    }
  }
  return true;
}

Environment::Environment(const glm::vec3& bottom, const glm::vec3& top, const EnvironmentAxes& axes)
  : Gradient{ bottom, top, axes.Up }
  , Axes(axes)
{
}

Environment::Environment(EnvironmentImage image, float intensity, const EnvironmentAxes& axes)
  : Axes(axes)
  , Image(std::move(image))
{
  for (glm::vec3& pixel : this->Image.Pixels)
  {
    pixel *= intensity;
  }
  this->Importance =
    Distribution2D(MakeImportance(this->Image), this->Image.Width, this->Image.Height);
}

glm::vec2 Environment::ToImage(const glm::vec3& direction) const
{
  const float x = glm::dot(direction, this->Axes.Right);
  const float y = glm::dot(direction, this->Axes.Up);
  const float z = glm::dot(direction, this->Axes.Front);
  return { std::atan2(z, x) * 0.5f * InversePi + 0.5f,
    std::acos(std::clamp(y, -1.0f, 1.0f)) * InversePi };
}

glm::vec3 Environment::Interpolate(const glm::vec2& point) const
{
  const float x = point.x * static_cast<float>(this->Image.Width) - 0.5f;
  const float y = point.y * static_cast<float>(this->Image.Height) - 0.5f;
  const int column = static_cast<int>(std::floor(x));
  const int row = static_cast<int>(std::floor(y));
  const float weightX = x - static_cast<float>(column);
  const float weightY = y - static_cast<float>(row);
  const auto pixel = [this](int i, int j) -> const glm::vec3&
  {
    const int wrapped = (i + this->Image.Width) % this->Image.Width;
    const int clamped = std::clamp(j, 0, this->Image.Height - 1);
    return this->Image.Pixels[std::size_t(clamped) * this->Image.Width + wrapped];
  };
  return (1.0f - weightY) *
    ((1.0f - weightX) * pixel(column, row) + weightX * pixel(column + 1, row)) +
    weightY * ((1.0f - weightX) * pixel(column, row + 1) + weightX * pixel(column + 1, row + 1));
}

glm::vec3 Environment::GetRadiance(const glm::vec3& direction) const
{
  if (!IsDirection(direction))
  {
    return glm::vec3(0.0f);
  }
  if (this->Image.Pixels.empty())
  {
    return this->Gradient.Get(direction);
  }
  return this->Interpolate(this->ToImage(direction));
}

LightSample Environment::Sample(const glm::vec2& u) const
{
  float pdf = 0.0f;
  const glm::vec2 point = this->Importance.Sample(u, pdf);
  const float azimuth = (point.x - 0.5f) * 2.0f * Pi;
  const float sine = std::sin(Pi * point.y);
  LightSample sample;
  if (sine > 0.0f)
  {
    sample.Direction = sine * std::cos(azimuth) * this->Axes.Right +
      std::cos(Pi * point.y) * this->Axes.Up + sine * std::sin(azimuth) * this->Axes.Front;
    sample.Radiance = this->Interpolate(point);
    sample.Pdf = pdf / (2.0f * Pi * Pi * sine);
  }
  return sample;
}

float Environment::Pdf(const glm::vec3& direction) const
{
  if (!IsDirection(direction))
  {
    return 0.0f;
  }
  const glm::vec2 point = this->ToImage(direction);
  const float sine = std::sin(Pi * point.y);
  return sine > 0.0f ? this->Importance.GetPdf(point) / (2.0f * Pi * Pi * sine) : 0.0f;
}
}
