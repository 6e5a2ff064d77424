// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Writes the pictures of a camera path: a folder of numbered PNGs, or a video.
 */
#ifndef cslfFrameFiles_h
#define cslfFrameFiles_h

#include <memory>
#include <string>

class vtkImageData;

namespace cslf::tool
{
/// The formats, for help and errors.
constexpr const char* FrameFormats = "a folder, .mp4 or .mkv";

/// Takes one picture after the other. The result appears complete, with Finish, or not at all.
class FrameWriter
{
public:
  virtual ~FrameWriter() = default;

  /// Adds a picture of red, green and blue bytes. Throws a Failure.
  virtual void Add(vtkImageData* picture) = 0;

  /// Moves the result to its place. Throws a Failure.
  virtual void Finish() = 0;
};

/// A writer for pictures of this size: for a video with `frameRate` frames per second if the name
/// ends with .mp4 or .mkv, or for a folder if the name has no extension. Throws a Failure if the
/// destination is not writable or the format is unknown.
std::unique_ptr<FrameWriter> MakeFrameWriter(
  const std::string& output, int width, int height, double frameRate);
}

#endif
