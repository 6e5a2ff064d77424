// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The benchmarks, one file each.
 */
#ifndef cslfBenchmarks_h
#define cslfBenchmarks_h

#include <string>

namespace cslf
{
namespace benchmarks
{
/// Cached rendering of viewpoints of the Cornell box, with shading, depth and quantisation,
/// compared with only the ray queries of the same rays. Counters: rays/s of both, and the second
/// divided by the first.
void AddCachedRendering();

/// Decoding of a coded light field (.mp4 or .mkv): all of it, with texels/s, where all channels
/// count as one; opening and one viewpoint; only opening.
void AddDecoding(const std::string& fileName);

/// Path tracing of the Cornell box, lit by its lamp, and of a floor below 1000 small spheres of
/// which 10, 100 or 1000 are lamps. Counter: rays/s.
void AddPathTracing();

/// Path tracing of a mesh (.obj or .ply) under a white environment. Counter: rays/s.
void AddPathTracing(const std::string& fileName);
}
}

#endif
