// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The transfer function of an image file, from the name of the colour space that OpenImageIO
 * reports. The names differ between its versions: "sRGB", "Linear", "Gamma2.2" up to 2.4; then
 * "lin_srgb" and "lin_rec709" as well; since 3.1 "srgb_rec709_scene", "lin_rec709_scene",
 * "g22_rec709_scene".
 */
#ifndef cslfImageCurve_h
#define cslfImageCurve_h

#include "vtkCSLFModule.h" // for export macro

#include <string>

namespace cslf
{
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
}

#endif
