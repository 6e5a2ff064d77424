// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Where the pictures of a camera path go: a folder of numbered PNGs, or a video.
 */
#ifndef cslfFrameFiles_h
#define cslfFrameFiles_h

#include <memory>
#include <string>

class vtkImageData;

namespace cslf
{
namespace tool
{
/// The formats, for help and errors.
constexpr const char* FrameFormats = "a folder, .mp4 or .mkv";

/// Takes one picture after the other. What it makes appears whole, with Finish, or not at all.
class FrameWriter
{
public:
  virtual ~FrameWriter() = default;

  /// Adds a picture of red, green and blue bytes. Throws a Failure.
  virtual void Add(vtkImageData* picture) = 0;

  /// Puts what was made in its place. Throws a Failure.
  virtual void Finish() = 0;
};

/// A writer for pictures of this size: of a video where the name ends with .mp4 or .mkv, with
/// `frameRate` pictures a second, else of a folder, for which a name without an extension stands.
/// Throws a Failure where that place cannot be written or the format is another one.
std::unique_ptr<FrameWriter> MakeFrameWriter(
  const std::string& output, int width, int height, double frameRate);
}
}

#endif
