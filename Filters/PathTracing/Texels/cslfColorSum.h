// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The channel Color: the mean radiance of a texel's samples, or of those on the surface at its
 * centre.
 */
#ifndef cslfColorSum_h
#define cslfColorSum_h

#include "cslfChannelSum.h"
#include "cslfColor.h"

#include <glm/common.hpp>
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
    if (samples.HasOthers)
    {
      this->AddOthers(samples);
    }
  }

  void AddPath(int texel, const PathBatch& batch, int path, bool isOwn)
  {
    const glm::vec3& radiance = batch.GetRadiance(path);
    this->Sum.Red[texel] += radiance.x;
    this->Sum.Green[texel] += radiance.y;
    this->Sum.Blue[texel] += radiance.z;
    if (!isOwn)
    {
      this->Others.Red[texel] += radiance.x;
      this->Others.Green[texel] += radiance.y;
      this->Others.Blue[texel] += radiance.z;
      ++this->OtherCount[texel];
    }
  }

  void Take(const int* texels)
  {
    CopySome(this->Taken.Red, this->Sum.Red, texels);
    CopySome(this->Taken.Green, this->Sum.Green, texels);
    CopySome(this->Taken.Blue, this->Sum.Blue, texels);
    CopySome(this->TakenOthers.Red, this->Others.Red, texels);
    CopySome(this->TakenOthers.Green, this->Others.Green, texels);
    CopySome(this->TakenOthers.Blue, this->Others.Blue, texels);
    CopySome(this->TakenOtherCount, this->OtherCount, texels);
  }

  /// Bytes as EncodeColor makes them, or linear radiance times exposure, and alpha.
  void Write(const WrittenTexels& texels, const ViewpointSamples& output) const
  {
    auto* bytes = output.Get<unsigned char>(Id);
    auto* floats = output.Get<float>(Id);
    for (const WrittenTexels::Texel& texel : texels)
    {
      const int i = texel.Number;
      const glm::dvec3 radiance = texels.Exposure * this->GetMean(texel);
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

  /// The number of samples so far whose colour does not count, if others' does.
  int GetOtherCount(int texel) const { return this->OtherCount[texel]; }

  /// The sum of the samples so far whose colour counts.
  glm::vec3 GetOwnSum(int texel) const
  {
    return { this->Sum.Red[texel] - this->Others.Red[texel],
      this->Sum.Green[texel] - this->Others.Green[texel],
      this->Sum.Blue[texel] - this->Others.Blue[texel] };
  }

private:
  void AddOthers(const PacketSamples& samples)
  {
    alignas(64) int counts[Size];
    PacketRadiance others;
    for (int lane = 0; lane < Size; ++lane)
    {
      const bool isOther = samples.Covered[lane] != 0 && samples.Own[lane] == 0;
      counts[lane] = isOther ? 1 : 0;
      others.Red[lane] = isOther ? samples.Radiance.Red[lane] : 0.0f;
      others.Green[lane] = isOther ? samples.Radiance.Green[lane] : 0.0f;
      others.Blue[lane] = isOther ? samples.Radiance.Blue[lane] : 0.0f;
    }
    const TexelGroup& group = samples.First.Group;
    AddTo(this->Others.Red, group, others.Red);
    AddTo(this->Others.Green, group, others.Green);
    AddTo(this->Others.Blue, group, others.Blue);
    AddTo(this->OtherCount, group, counts);
  }

  /// The mean radiance times alpha. Samples whose colour does not count still cover the texel.
  glm::dvec3 GetMean(const WrittenTexels::Texel& texel) const
  {
    const int i = texel.Number;
    const glm::dvec3 sum(this->Taken.Red[i], this->Taken.Green[i], this->Taken.Blue[i]);
    const int others = this->TakenOtherCount[i];
    if (others == 0 || others == texel.Covered)
    {
      return sum / static_cast<double>(texel.Samples);
    }
    const glm::dvec3 own = sum -
      glm::dvec3(this->TakenOthers.Red[i], this->TakenOthers.Green[i], this->TakenOthers.Blue[i]);
    const double alpha = static_cast<double>(texel.Covered) / texel.Samples;
    return alpha / (texel.Covered - others) * glm::max(own, 0.0);
  }

  PacketRadiance Sum{};
  PacketRadiance Others{}; // the part of those samples whose colour does not count
  alignas(64) int OtherCount[Size] = {};
  PacketRadiance Taken;
  PacketRadiance TakenOthers;
  int TakenOtherCount[Size];
};
}

#endif
