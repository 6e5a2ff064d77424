// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Decodes the images of textures, which come from strangers' files.
 */
#ifndef cslfEncodedImage_h
#define cslfEncodedImage_h

#include "vtkCSLFModule.h" // for export macro

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace cslf
{
/// An image of 8 bits with 1 to 4 components, whose first row is the lowest, as in VTK, from the
/// bytes of a PNG, JPEG or WebP file. With a file name extension in lower case, such as ".bmp" or
/// ".tga", OpenImageIO's reader for that name is used for anything else. Colour spaces are ignored,
/// and alpha is not associated. Null if the image is damaged or has more than 2^28 pixels; `error`
/// then ends a sentence about the image.
VTKCSLF_EXPORT vtkSmartPointer<vtkImageData> DecodeImage(
  const unsigned char* bytes, std::size_t size, const std::string& extension, std::string& error);

/// A number of 4 bytes, as PNG files have them.
inline std::uint32_t ReadBigEndian(const unsigned char* bytes)
{
  return std::uint32_t(bytes[0]) << 24 | std::uint32_t(bytes[1]) << 16 |
    std::uint32_t(bytes[2]) << 8 | std::uint32_t(bytes[3]);
}
}

#endif
