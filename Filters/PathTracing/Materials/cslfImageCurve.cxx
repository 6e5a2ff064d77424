// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfImageCurve.h"

#include "cslfColor.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

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
}
