// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Image files, by OpenImageIO.
 *
 * OpenImageIO needs hundreds of other libraries, which take longer to load than everything else
 * that CSLF needs. So what calls it is a library of its own, beside that of CSLF, which is loaded
 * when the first image is opened or made. Static builds contain it.
 */
#ifndef cslfImageFiles_h
#define cslfImageFiles_h

#include "vtkCSLFModule.h" // for export macro

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace cslf
{
enum class PixelType
{
  Bytes,
  Words, ///< of 16 bits
  Floats,
  Other
};

/// What an image is without its pixels.
struct ImageHeader
{
  int Width = 0;
  int Height = 0;
  int Channels = 0;
  PixelType Type = PixelType::Other;
  bool HasFloats = false;                        ///< of any size
  std::map<std::string, std::string> Attributes; ///< texts, by OpenImageIO's names
};

/// The name of the attribute that tells the transfer function.
constexpr const char* ColorSpaceAttribute = "oiio:ColorSpace";

struct ImageSource
{
  std::string FileName;
  std::string Format; ///< OpenImageIO's name of it; or empty: the file and its name tell it
  /// If not null, the file, whose name then only tells the format.
  const unsigned char* Bytes = nullptr;
  std::size_t Size = 0;
  bool KeepsColors = false; ///< whether colours are left as they are in files with alpha
};

class ImageReader
{
public:
  virtual ~ImageReader() = default;

  /// That of the current image; the first one at the beginning.
  const ImageHeader& GetHeader() const { return this->Header; }

  /// All channels of the pixels, by rows from the top, converted to the type.
  virtual bool Read(PixelType type, void* pixels, std::string& error) = 0;

  /// Goes on to the next image of the file. False if there is none, or if it is a volume.
  virtual bool GoOn() = 0;

protected:
  ImageHeader Header;
};

class ImageWriter
{
public:
  virtual ~ImageWriter() = default;

  /// Adds an image of bytes to a file that may have several: `row` bytes lie between the beginnings
  /// of rows, of which the first is the top.
  virtual bool Add(const unsigned char* pixels, std::ptrdiff_t row, std::string& error) = 0;

  /// Must be called at the end.
  virtual bool Finish(std::string& error) = 0;
};

/// The functions of the library.
class ImageLibrary
{
public:
  virtual ~ImageLibrary() = default;

  /// Null if the image cannot be opened.
  virtual std::unique_ptr<ImageReader> Open(
    const ImageSource& source, std::string& error) const = 0;

  /// Makes a file of one image in memory. Its name tells the format. The pixels are of the header's
  /// type, and colours are not multiplied by alpha.
  virtual bool Encode(const std::string& fileName, const ImageHeader& header, const void* pixels,
    std::vector<unsigned char>& bytes, std::string& error) const = 0;

  /// A writer of a file of images of bytes, in one of OpenImageIO's formats, which may be a movie
  /// of so many pictures a second. Null if it cannot write the format.
  virtual std::unique_ptr<ImageWriter> Create(const std::string& fileName,
    const std::string& format, const ImageHeader& header, double frameRate,
    std::string& error) const = 0;
};

/// Loads the library unless it is there. Null, with an error, if it is missing.
VTKCSLF_EXPORT const ImageLibrary* GetImageLibrary(std::string& error);

/// Opens an image. Null if it, or the library, cannot be read.
VTKCSLF_EXPORT std::unique_ptr<ImageReader> OpenImage(
  const ImageSource& source, std::string& error);
}

#endif
