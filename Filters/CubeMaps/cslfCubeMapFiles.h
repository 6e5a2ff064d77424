// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A light field as a folder of cube maps: the names of its files, what is in them, and one image's
 * way to disk and back. vtkCSLFImageWriter's documentation describes the folder to users.
 */
#ifndef cslfCubeMapFiles_h
#define cslfCubeMapFiles_h

#include "Pipeline/cslfSlabs.h"
#include "cslfDescription.h"

#include <optional>
#include <string>
#include <vector>

namespace cslf
{
/// The description's file in the folder.
constexpr const char* CubeMapDescriptionName = "description.json";

/// A folder's description and the slices it holds.
struct CubeMapFolder
{
  Description Field;
  Slab Slices;
};

/// Whether a folder can hold the field's channels; otherwise says why.
bool CheckCubeMapChannels(const Description& description, std::string& error);

/// The file of one channel of one viewpoint.
std::string CubeMapFileName(const std::string& folder, const Channel& channel, int slice);

/// Writes the description's file, which is not there yet. On failure says why.
bool WriteCubeMapDescription(
  const std::string& folder, const CubeMapFolder& content, std::string& error);

/// The names of those files of a folder that belong to a light field, the description last.
std::vector<std::string> ListCubeMapFiles(const std::string& folder);

/// Reads the description's file. On failure returns nothing and says why.
std::optional<CubeMapFolder> ReadCubeMapDescription(const std::string& folder, std::string& error);

/// Writes one channel of one viewpoint, `texels` in the order of the image data. On failure
/// says why.
bool WriteCubeMap(const std::string& folder, const Layout& grid, const Channel& channel, int slice,
  const unsigned char* texels, std::string& error);

/// Reads what WriteCubeMap wrote; false where the file is missing, damaged or of another kind.
bool ReadCubeMap(const std::string& folder, const Layout& grid, const Channel& channel, int slice,
  unsigned char* texels);

/// Whether the file is there with the right size and type, and its checksums are right. Pixels are
/// decoded only of EXR, where the checksum is theirs.
bool ProbeCubeMap(const std::string& folder, const Layout& grid, const Channel& channel, int slice);

/// What a texel holds where nothing was read: depth 1, all else 0.
void FillEmpty(const Channel& channel, unsigned char* texels, std::size_t count);
}

#endif
