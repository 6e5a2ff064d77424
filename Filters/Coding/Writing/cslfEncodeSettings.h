// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The user's settings of a coded file, their checks, and the encoder that they need.
 */
#ifndef cslfEncodeSettings_h
#define cslfEncodeSettings_h

#include "Coding/Codecs/cslfVideoEncoders.h"
#include "Coding/RateControl/cslfRateControl.h"
#include "cslfDescription.h"
#include "cslfJSON.h"

#include <string>

namespace cslf
{
/// The user's settings.
struct EncodeSettings
{
  std::string Preset;
  std::string PixelFormat; ///< FFmpeg's name, or "auto"
  double CRF = 0.0;
  double CoverageCRF = 0.0;
  double DepthCRF = 0.0;
  int GroupLength = MaximumGroupLength;
  bool Lossless = false;
  bool DepthFromGeometry = true;
  RateTarget Target{}; ///< replaces CRF, unless its kind is Factor
  int KeyViewStep = 1; ///< see KeyViews; 0: found for NovelViewPSNR, see ChooseKeyViews
  double NovelViewPSNR = 0.0;
  std::string Codec = "hevc";

  /// The constant rate factor of a plane; that of bytes of numbers, which are lossless, is 0.
  double GetCRF(Plane plane) const;

  /// Whether readers may compute what a geometry tells.
  bool ComputesDepth() const { return this->DepthFromGeometry && !this->Lossless; }
};

/// The settings of the coded groups, and the versions of the libraries.
nlohmann::json DescribeSettings(const EncodeSettings& settings);

/// Why a file of that name cannot be written, in one line; empty if it can. Touches no file.
std::string FindError(const std::string& fileName);

/// Why frames of that resolution cannot be coded with these settings, likewise.
std::string FindError(const EncodeSettings& settings, int resolution);

/// Why a field cannot be coded, in one line; empty if it can.
std::string FindError(const Description& field);

/// Why it cannot be coded with these settings, which have passed the checks above, likewise.
std::string FindError(const EncodeSettings& settings, const Description& field);

/// The encoder and the format of colour that settings ask for. The encoder is null if this FFmpeg
/// has none.
struct EncoderChoice
{
  const VideoEncoder* Encoder = nullptr;
  AVPixelFormat Color = AV_PIX_FMT_NONE;
};

EncoderChoice ChooseEncoder(const EncodeSettings& settings, bool isRadiance, int resolution);

/// Whether a field's colour is float.
bool HasRadiance(const Description& field);
}

#endif
