// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Opens FFmpeg's encoders, and makes sure that they know what they are told: FFmpeg itself only
 * logs what its libraries do not know, and goes on without.
 */
#ifndef cslfEncoderContext_h
#define cslfEncoderContext_h

#include "Coding/cslfVideoEncoders.h"
#include "vtkCSLFModule.h"

#include <string>

namespace cslf
{
/// An open encoder of frames of a track with these options, or null with what is wrong, in one
/// line that names the option where it is one that the encoder does not know or take.
///
/// Each library's options are checked once in a process. For that moment FFmpeg's log goes through
/// a callback, and afterwards to FFmpeg's own: a program that has another sets it again.
VTKCSLF_EXPORT AVHandle<AVCodecContext> OpenEncoder(const VideoEncoder& encoder, const Track& track,
  int resolution, const EncoderOptions& options, std::string& error);
}

#endif
