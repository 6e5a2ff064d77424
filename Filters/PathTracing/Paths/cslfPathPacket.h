// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The state of paths that are being followed, side by side.
 */
#ifndef cslfPathPacket_h
#define cslfPathPacket_h

#include "PathTracing/Scene/cslfRayLanes.h"
#include "RandomNumbers/cslfStreamLanes.h"

namespace cslf
{
struct PathPacket
{
  RayLanes Rays;            ///< lanes of continuing paths are active
  Vec3Lanes Beta;           ///< the weight of the light it finds
  Lanes<float> Pdf;         ///< of the ray's direction, per solid angle; infinite for a given ray
  Vec3Lanes Normal;         ///< of the LightReceiver where the ray starts
  Lanes<float> Compression; ///< the factor of the weight that is undone on leaving glass
  StreamLanes Streams;
  Lanes<std::int32_t> Path;  ///< its number in the batch
  Lanes<std::int32_t> Bin{}; ///< of the ray, see GetRayBin; not copied

  /// Copies one path.
  void Take(int lane, const PathPacket& from, int fromLane)
  {
    this->Rays.Active[lane] = -1;
    this->Rays.Origin.Set(lane, from.Rays.Origin.Get(fromLane));
    this->Rays.Direction.Set(lane, from.Rays.Direction.Get(fromLane));
    this->Beta.Set(lane, from.Beta.Get(fromLane));
    this->Pdf[lane] = from.Pdf[fromLane];
    this->Normal.Set(lane, from.Normal.Get(fromLane));
    this->Compression[lane] = from.Compression[fromLane];
    this->Streams.Hash[lane] = from.Streams.Hash[fromLane];
    this->Streams.Index[lane] = from.Streams.Index[fromLane];
    this->Path[lane] = from.Path[fromLane];
  }
};
}

#endif
