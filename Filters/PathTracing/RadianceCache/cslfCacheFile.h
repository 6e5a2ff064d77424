// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A finished radiance cache in a file, sealed by a checksum. The layout is private to machines of
 * one kind.
 */
#ifndef cslfCacheFile_h
#define cslfCacheFile_h

#include "vtkCSLFModule.h" // for export macro

#include <string>

namespace cslf
{
class RadianceCache;

/// What became of reading a cache.
enum class CacheFileState
{
  Missing, ///< there is no file, or it is that of another cache
  Damaged, ///< there is one, but not as it was written
  Read
};

/// Writes a cache. The key tells all that the cache depends on. False on failure; the file is then
/// of no use.
VTKCSLF_EXPORT bool WriteCacheFile(
  const std::string& fileName, const std::string& key, RadianceCache& cache);

/// Reads a cache that was written with the same key. Unless it was read, the cache must be made
/// anew.
VTKCSLF_EXPORT CacheFileState ReadCacheFile(
  const std::string& fileName, const std::string& key, RadianceCache& cache);
}

#endif
