// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Fewer triangles of the same points, for views that move.
 */
#ifndef cslfMeshLevels_h
#define cslfMeshLevels_h

#include "vtkCSLFModule.h"

#include <glm/vec3.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <future>
#include <mutex>
#include <vector>

namespace cslf
{
/// A part of a list of corners of triangles. Those of closed parts come first, see ClosedParts.
struct MeshLevel
{
  std::size_t First = 0;
  std::size_t ClosedEnd = 0;
  std::size_t End = 0;

  std::size_t CountTriangles() const { return (this->End - this->First) / 3; }
};

/// The levels of detail of a mesh below the finest, which is the mesh itself. Each has about half
/// of the triangles of the one before.
struct MeshLevels
{
  std::vector<std::uint32_t> Corners; ///< of all levels
  std::vector<MeshLevel> Levels;
};

/// Makes the levels of a mesh in another thread. Thread-safe.
class VTKCSLF_EXPORT MeshLevelMaker
{
public:
  MeshLevelMaker() = default;
  ~MeshLevelMaker();
  MeshLevelMaker(const MeshLevelMaker&) = delete;
  MeshLevelMaker& operator=(const MeshLevelMaker&) = delete;

  /// The levels of a mesh whose corners of closed parts come first. The first call begins to make
  /// them, and calls return null until they are made. Other calls must have the same mesh, which
  /// must outlive this object.
  const MeshLevels* Find(const std::vector<glm::vec3>& points,
    const std::vector<std::uint32_t>& corners, std::size_t closedCorners);

private:
  std::mutex Mutex;
  std::atomic<bool> IsAborted{ false };
  std::shared_future<MeshLevels> Making;
};
}

#endif
