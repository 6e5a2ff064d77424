// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Opens FFmpeg's encoders, and makes sure that they know their options. FFmpeg itself only logs
 * options that its libraries do not know, and ignores them.
 */
#ifndef cslfEncoderContext_h
#define cslfEncoderContext_h

#include "Coding/Codecs/cslfVideoEncoders.h"
#include "vtkCSLFModule.h"

#include <string>

namespace cslf
{
/// An open encoder of frames of a track with these options, or null with the reason in one line. It
/// names the option if the encoder does not know or accept it.
///
/// Each library's options are checked once in a process. During the check, FFmpeg's log goes
/// through a callback, and afterwards to FFmpeg's default callback. A program with its own callback
/// must set it again.
VTKCSLF_EXPORT AVHandle<AVCodecContext> OpenEncoder(const VideoEncoder& encoder, const Track& track,
  int resolution, const EncoderOptions& options, std::string& error);
}

#endif
