// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Writes pictures one after the other: to a folder of numbered PNGs, or to a movie.
 */
#ifndef cslfFrameFiles_h
#define cslfFrameFiles_h

#include "Fields/cslfOutputFiles.h"

#include <memory>
#include <string>

class vtkImageData;

namespace cslf::tool
{
/// The formats, for help and errors.
constexpr const char* FrameFormats = "a folder, .mp4, .mkv, .webm, .gif or .webp";

/// Takes one picture after the other. The result appears complete, with Finish, or not at all.
class FrameWriter
{
public:
  virtual ~FrameWriter() = default;

  /// Adds a picture of red, green and blue bytes, which is shown for so many frames' time. Movies
  /// contain it once. Throws a Failure.
  virtual void Add(vtkImageData* picture, int frames) = 0;

  /// Moves the result to its place. Throws a Failure.
  virtual void Finish() = 0;
};

/// Whether the name's extension is that of a movie.
bool IsMovieName(const std::string& fileName);

/// A writer for pictures of this size: a movie with `frameRate` frames per second, or a folder if
/// the name has no extension. Throws a Failure if the destination is not writable, or the format is
/// unknown or not supported.
std::unique_ptr<FrameWriter> MakeFrameWriter(
  const std::string& output, int width, int height, double frameRate);

/// A file of one or more pictures in a format of OpenImageIO, which the extension tells.
class ImageFile
{
public:
  /// `frameRate` is that of a movie. Throws a Failure.
  ImageFile(const std::string& fileName, const int size[2], double frameRate);
  ~ImageFile();

  /// Adds a picture of red, green and blue bytes, which a movie shows for so many frames' time.
  /// Throws a Failure.
  void Add(vtkImageData* picture, int frames = 1);
  void Publish();

private:
  struct Output;

  OutputFile File;
  std::unique_ptr<Output> Image;
};
}

#endif
