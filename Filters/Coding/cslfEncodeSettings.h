// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a user may choose of a coded file, what is wrong with it, and which encoder it calls for.
 */
#ifndef cslfEncodeSettings_h
#define cslfEncodeSettings_h

#include "Coding/cslfRateControl.h"
#include "Coding/cslfVideoEncoders.h"
#include "cslfDescription.h"

#include <string>

namespace cslf
{
/// What a user may choose.
struct EncodeSettings
{
  std::string Preset;
  std::string PixelFormat; ///< FFmpeg's name, or "auto"
  double CRF = 0.0;
  double CoverageCRF = 0.0;
  double DepthCRF = 0.0;
  int GroupLength = MaximumGroupLength;
  bool Lossless = false;
  RateTarget Target{}; ///< in place of CRF, unless its kind is Factor
  int KeyViewStep = 1; ///< see KeyViews; 0 for what reaches NovelViewPSNR, see ChooseKeyViews
  double NovelViewPSNR = 0.0;
  std::string Codec = "hevc";
};

/// What keeps a file of that name from being written, in one line; empty where nothing does.
/// Touches no file.
std::string FindFault(const std::string& fileName);

/// What keeps frames of that resolution from being coded with these settings, likewise.
std::string FindFault(const EncodeSettings& settings, int resolution);

/// What keeps a field from being coded, in one line; empty where nothing does.
std::string FindFault(const Description& field);

/// What keeps it from being coded with these settings, which have passed the checks above,
/// likewise.
std::string FindFault(const EncodeSettings& settings, const Description& field);

/// The encoder and the format of colour that settings ask for. The encoder is null where this
/// FFmpeg has none.
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
