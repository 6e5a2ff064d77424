// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A finished radiance cache in a file with a checksum. Only machines of the same kind can read it.
 */
#ifndef cslfCacheFile_h
#define cslfCacheFile_h

#include "vtkCSLFModule.h" // for export macro

#include <string>

namespace cslf
{
class RadianceCache;

/// The result of reading a cache.
enum class CacheFileState
{
  Missing, ///< there is no file, or it belongs to another cache
  Damaged, ///< the file is damaged
  Read
};

/// Writes a cache. The key contains everything that the cache depends on. False on failure; the
/// file is then unusable.
VTKCSLF_EXPORT bool WriteCacheFile(
  const std::string& fileName, const std::string& key, RadianceCache& cache);

/// Reads a cache that was written with the same key. Unless the result is that it was read, the
/// cache must be made again.
VTKCSLF_EXPORT CacheFileState ReadCacheFile(
  const std::string& fileName, const std::string& key, RadianceCache& cache);
}

#endif
