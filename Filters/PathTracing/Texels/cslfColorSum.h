// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The channel Color: the mean radiance of a texel's samples.
 */
#ifndef cslfColorSum_h
#define cslfColorSum_h

#include "cslfChannelSum.h"
#include "cslfColor.h"

#include <glm/vec3.hpp>

namespace cslf
{
class ColorSum : public ChannelSum
{
public:
  static constexpr KnownChannel Id = KnownChannel::Color;

  void Add(const PacketSamples& samples)
  {
    const TexelGroup& group = samples.First.Group;
    AddTo(this->Sum.Red, group, samples.Radiance.Red);
    AddTo(this->Sum.Green, group, samples.Radiance.Green);
    AddTo(this->Sum.Blue, group, samples.Radiance.Blue);
  }

  void AddPath(int texel, const PathBatch& batch, int path)
  {
    const glm::vec3& radiance = batch.GetRadiance(path);
    this->Sum.Red[texel] += radiance.x;
    this->Sum.Green[texel] += radiance.y;
    this->Sum.Blue[texel] += radiance.z;
  }

  void Take(const int* texels)
  {
    CopySome(this->Taken.Red, this->Sum.Red, texels);
    CopySome(this->Taken.Green, this->Sum.Green, texels);
    CopySome(this->Taken.Blue, this->Sum.Blue, texels);
  }

  /// Bytes as EncodeColor makes them, or linear radiance times exposure, and alpha.
  void Write(const WrittenTexels& texels, const ViewpointSamples& output) const
  {
    auto* bytes = output.Get<unsigned char>(Id);
    auto* floats = output.Get<float>(Id);
    for (const WrittenTexels::Texel& texel : texels)
    {
      const int i = texel.Number;
      const double scale = texels.Exposure / texel.Samples;
      const glm::dvec3 radiance =
        scale * glm::dvec3(this->Taken.Red[i], this->Taken.Green[i], this->Taken.Blue[i]);
      const double alpha = static_cast<double>(texel.Covered) / texel.Samples;
      if (bytes)
      {
        EncodeColor(radiance, alpha, bytes + 4 * texel.Index);
      }
      if (floats)
      {
        float* color = floats + 4 * texel.Index;
        color[0] = static_cast<float>(radiance.x);
        color[1] = static_cast<float>(radiance.y);
        color[2] = static_cast<float>(radiance.z);
        color[3] = static_cast<float>(alpha);
      }
    }
  }

  /// The sums of all samples so far.
  const PacketRadiance& GetSum() const { return this->Sum; }

private:
  PacketRadiance Sum{};
  PacketRadiance Taken;
};
}

#endif
