// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A light field as a folder of cube maps: names and contents of its files, and functions that
 * write, check and read one image. vtkCSLFImageWriter's documentation describes the folder to
 * users.
 */
#ifndef cslfCubeMapFiles_h
#define cslfCubeMapFiles_h

#include "Pipeline/cslfFieldStream.h"
#include "cslfDescription.h"

#include <optional>
#include <string>
#include <vector>

namespace cslf
{
/// Whether an EXR file contains one image of that size, in rows, and OpenEXR will interpret its
/// header correctly. OpenEXR allocates memory for whatever a header claims.
bool IsSoundEXR(const std::vector<unsigned char>& content, int width, int height);

/// The description's file in the folder.
constexpr const char* CubeMapDescriptionName = "description.json";

/// A folder's description and the slices that it contains.
struct CubeMapFolder
{
  Description Field;
  Slab Slices;
};

/// Whether a folder can store the field's channels. If not, gives the reason.
bool CheckCubeMapChannels(const Description& description, std::string& error);

/// The file of one channel of one viewpoint.
std::string CubeMapFileName(const std::string& folder, const Channel& channel, int slice);

/// Writes the description's file, which must not exist yet. On failure gives the reason.
bool WriteCubeMapDescription(
  const std::string& folder, const CubeMapFolder& content, std::string& error);

/// The names of the files of a folder that belong to a light field, the description last.
std::vector<std::string> ListCubeMapFiles(const std::string& folder);

/// Reads the description's file. On failure returns nothing and gives the reason.
std::optional<CubeMapFolder> ReadCubeMapDescription(const std::string& folder, std::string& error);

/// Writes one channel of one viewpoint, `texels` in the order of the image data. On failure gives
/// the reason.
bool WriteCubeMap(const std::string& folder, const Layout& grid, const Channel& channel, int slice,
  const unsigned char* texels, std::string& error);

/// Reads an image that WriteCubeMap wrote. False if the file is missing, damaged or of another
/// kind.
bool ReadCubeMap(const std::string& folder, const Layout& grid, const Channel& channel, int slice,
  unsigned char* texels);

/// Whether the file exists with the right size and type and correct checksums. Only EXR files are
/// decoded, because their checksum is that of the pixels.
bool ProbeCubeMap(const std::string& folder, const Layout& grid, const Channel& channel, int slice);
}

#endif
