// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The benchmarks of the sampler, one file each.
 */
#ifndef cslfBenchmarks_h
#define cslfBenchmarks_h

#include <string>

namespace cslf
{
namespace benchmarks
{
/// Cached rendering of viewpoints of the Cornell box, with shading, depth and quantisation, against
/// nothing but the ray queries of the same rays. Counters: rays/s of both, and the second divided
/// by the first.
void AddCachedRendering();

/// Path tracing of the Cornell box, lit by its lamp. Counter: rays/s.
void AddPathTracing();

/// Path tracing of a mesh (.obj or .ply) under a white environment. Counter: rays/s.
void AddPathTracing(const std::string& fileName);
}
}

#endif
