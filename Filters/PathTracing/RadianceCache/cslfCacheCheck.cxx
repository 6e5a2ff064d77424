// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfCacheCheck.h"

#include "Pipeline/cslfParallelFor.h"
#include "cslfRadianceCache.h"

#include "PathTracing/Paths/cslfPathBatch.h"
#include "Quality/cslfDisplayCurve.h"
#include "RandomNumbers/cslfSampleStream.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace cslf
{
namespace
{
// The paths of a texel. The halves have independent random numbers, so the mean of products of
// their differences is free of noise.
constexpr int Halves = 2;
constexpr int SamplesOfHalf = 32;

// The number of texels whose paths are followed together.
constexpr int TexelsOfBatch = PathBatch::Capacity / (Halves * SamplesOfHalf);

// The most texels tried for each wanted one: many may not see a surface.
constexpr int MaximumTries = 16;

// The use of random numbers.
constexpr std::uint64_t ChoiceSalt = 0x6368656b;
constexpr std::uint64_t PathSalt = 0x70617468;
constexpr std::uint64_t CacheSalt = 0x63616368;

struct Seen
{
  Ray First;
  Hit Surface;
};

/// The radiance of a texel.
struct Radiances
{
  glm::vec3 Cached[Halves];
  glm::vec3 Traced[Halves];
};

/// The mean of numbers, and its standard error.
class Mean
{
public:
  void Add(double value)
  {
    ++this->Count;
    this->Sum += value;
    this->Squares += value * value;
  }
  double Get() const { return this->Sum / this->Count; }
  double GetError() const
  {
    const double variance = this->Squares / this->Count - this->Get() * this->Get();
    return std::sqrt(std::max(variance, 0.0) / std::max(this->Count - 1, 1));
  }

private:
  int Count = 0;
  double Sum = 0.0;
  double Squares = 0.0;
};

double Average(const glm::vec3& color)
{
  return (double(color.x) + color.y + color.z) / 3.0;
}

/// The displayed difference relative to that of two radiances: the slope of the display's curve
/// between them.
float GetSlope(const DisplayCurve& display, float a, float b)
{
  constexpr float least = 1e-4f;
  const float low = std::min(a, b);
  const float high = std::max(std::max(a, b), low + least);
  return (display.Get(high) - display.Get(low)) / (high - low);
}

/// The product of the displayed differences of both halves. The curve is replaced by its slope
/// between the means, because the effect of a nonlinear curve on the noise of both halves would not
/// cancel.
double MultiplyDifferences(const DisplayCurve& display, const Radiances& texel)
{
  double sum = 0.0;
  for (int channel = 0; channel < 3; ++channel)
  {
    const float cached = 0.5f * (texel.Cached[0][channel] + texel.Cached[1][channel]);
    const float traced = 0.5f * (texel.Traced[0][channel] + texel.Traced[1][channel]);
    const double slope = GetSlope(display, cached, traced);
    sum += slope * slope * double(texel.Cached[0][channel] - texel.Traced[0][channel]) *
      double(texel.Cached[1][channel] - texel.Traced[1][channel]);
  }
  return sum / 3.0;
}

/// Random points of random texels that see a surface.
std::vector<Seen> ChooseTexels(
  const Scene& scene, const CheckedPicture& picture, const CheckSettings& settings)
{
  std::vector<Seen> chosen;
  for (int i = 0; i < MaximumTries * settings.Texels; ++i)
  {
    // Random numbers in [0,1) for the slice, the tile and the position in it.
    std::uint64_t bits = MixBits(MixBits(ChoiceSalt, settings.Seed), i);
    const auto next = [&bits](int count)
    {
      bits = MixBits(bits, 0);
      return static_cast<double>(bits >> 11) / 9007199254740992.0 * count;
    };
    const auto slice = static_cast<int>(next(picture.Slices));
    const auto tile = static_cast<int>(next(picture.Tiles));
    float x[RayPacket::Size];
    float y[RayPacket::Size];
    std::fill_n(x, RayPacket::Size, static_cast<float>(next(picture.TileWidth)));
    std::fill_n(y, RayPacket::Size, static_cast<float>(next(picture.TileHeight)));
    RayPacket packet;
    PacketScale scale;
    SetRays(picture.Grids(slice, tile), x, y, packet, scale);
    if (!packet.Active[0])
    {
      continue;
    }
    const Ray ray = packet.GetRay(0);
    const Hit hit = scene.Intersect(ray);
    if (hit.IsValid())
    {
      chosen.push_back({ ray, hit });
    }
    if (static_cast<int>(chosen.size()) == settings.Texels)
    {
      break;
    }
  }
  return chosen;
}

/// Computes the radiance of texels with an integrator.
class Tracer
{
public:
  Tracer(const PathIntegrator& integrator, std::uint64_t salt, std::uint32_t seed)
    : Integrator(integrator)
    , Hash(MixBits(salt, seed))
  {
  }

  void Add(const Seen& seen, std::size_t texel, glm::vec3 halves[Halves])
  {
    for (int half = 0; half < Halves; ++half)
    {
      const std::uint64_t hash = MixBits(this->Hash, Halves * texel + half);
      for (std::uint32_t i = 0; i < SamplesOfHalf; ++i)
      {
        this->Batch.Add({ seen.First, hash, i }, seen.Surface);
      }
      this->Sums.push_back(halves + half);
    }
  }

  void Follow()
  {
    std::uint64_t rays = 0;
    this->Integrator.Follow(this->Batch, rays);
    for (std::size_t k = 0; k < this->Sums.size(); ++k)
    {
      glm::vec3 sum(0.0f);
      for (int i = 0; i < SamplesOfHalf; ++i)
      {
        sum += this->Batch.GetRadiance(static_cast<int>(k) * SamplesOfHalf + i);
      }
      *this->Sums[k] = sum / static_cast<float>(SamplesOfHalf);
    }
  }

private:
  const PathIntegrator& Integrator;
  std::uint64_t Hash;
  PathBatch Batch;
  std::vector<glm::vec3*> Sums; // of this many paths each
};

/// False if `progress` returns false.
bool Measure(const Scene& scene, const RadianceCache& cache, const std::vector<Seen>& texels,
  const CheckSettings& settings, const Progress& progress, std::vector<Radiances>& radiances)
{
  const PathIntegrator paths(scene, settings.Paths);
  const PathIntegrator cached(scene, settings.Paths, &cache);
  radiances.resize(texels.size());
  const auto count = static_cast<vtkIdType>(texels.size());
  const vtkIdType batches = (count + TexelsOfBatch - 1) / TexelsOfBatch;
  const auto measure = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType batch = begin; batch < end; ++batch)
    {
      Tracer reference(paths, PathSalt, settings.Seed);
      Tracer rest(cached, CacheSalt, settings.Seed);
      const vtkIdType last = std::min<vtkIdType>((batch + 1) * TexelsOfBatch, count);
      for (vtkIdType texel = batch * TexelsOfBatch; texel < last; ++texel)
      {
        if (settings.Share && settings.Share->GetOwner(texel) != settings.Share->GetRank())
        {
          continue;
        }
        const Seen& seen = texels[texel];
        Radiances& result = radiances[texel];
        reference.Add(seen, texel, result.Traced);
        glm::vec3 known;
        if (cached.LookUp(seen.First, seen.Surface, known))
        {
          std::fill_n(result.Cached, Halves, known);
        }
        else
        {
          rest.Add(seen, texel, result.Cached);
        }
      }
      reference.Follow();
      rest.Follow();
    }
  };
  if (!settings.Share)
  {
    return ParallelFor(0, batches, progress, measure);
  }
  ParallelFor(0, batches, 1, measure);
  settings.Share->Complete(radiances, 0);
  return true;
}
}

bool CacheCheck::IsExceeded(double tolerance) const
{
  return std::abs(this->Mean) > MeanBound + 3.0 * this->MeanError ||
    this->RMS > GetRMSBound(tolerance) + 3.0 * this->RMSError;
}

CacheCheck CheckCache(const Scene& scene, const RadianceCache& cache, const CheckedPicture& picture,
  const CheckSettings& settings, const Progress& progress)
{
  const std::vector<Seen> texels = ChooseTexels(scene, picture, settings);
  std::vector<Radiances> radiances;
  CacheCheck check;
  if (!Measure(scene, cache, texels, settings, progress, radiances))
  {
    return check;
  }
  check.Texels = static_cast<std::int32_t>(texels.size());
  if (texels.empty())
  {
    return check;
  }
  const DisplayCurve display(settings.Exposure);
  Mean difference;
  Mean brightness;
  Mean squares;
  for (const Radiances& texel : radiances)
  {
    const glm::vec3 traced = 0.5f * (texel.Traced[0] + texel.Traced[1]);
    const glm::vec3 cached = 0.5f * (texel.Cached[0] + texel.Cached[1]);
    difference.Add(Average(cached - traced));
    brightness.Add(Average(traced));
    squares.Add(MultiplyDifferences(display, texel));
  }
  // Where the paths find no light, the cache should not either.
  const double scale = brightness.Get() > 0.0 ? brightness.Get() : 1.0;
  check.Mean = difference.Get() / scale;
  check.MeanError = difference.GetError() / scale;
  check.RMS = std::sqrt(std::max(squares.Get(), 0.0));
  // From the error of the square or, if it is all noise, from the square root of that.
  const double error = squares.GetError();
  check.RMSError = error > 0.0 ? error / std::max(2.0 * check.RMS, std::sqrt(error)) : 0.0;
  return check;
}
}
