// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Estimates of light at points of the surface, and the interface that makes them.
 *
 * The samples of a point are two independent halves. One half decides how many samples the other
 * half takes and where the other half's values are stored, and vice versa; both are then averaged.
 * So no value is selected by its own noise, and the mean of the stored values is correct even if
 * samples rarely find light. Such halves are known from adaptive rendering (Rousselle, Knaus and
 * Zwicker, ACM TOG 31(6), 2012) and as cross-fitting in statistics.
 */
#ifndef cslfSurfaceEstimate_h
#define cslfSurfaceEstimate_h

#include "PathTracing/Scene/cslfScene.h"
#include "cslfIncidentLight.h"
#include "cslfMeshEdges.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace cslf
{
/// The mean of samples, and the variance of that mean.
struct SampleMean
{
  glm::vec3 Mean{ 0.0f };
  glm::vec3 Variance{ 0.0f };
};

/**
 * The sums of equal parts of a low-discrepancy sequence. Their differences give an estimate of the
 * noise. Each part is such a sequence itself, so the mean of all is better than this estimate.
 */
class HalfSamples
{
public:
  static constexpr int Parts = 4;

  /// Makes room for samples up to number `end`: first any multiple of the parts, then twice as
  /// many.
  void Extend(int end)
  {
    if (this->End > 0)
    {
      for (int part = 0; part < Parts / 2; ++part)
      {
        this->Sums[part] = this->Sums[2 * part] + this->Sums[2 * part + 1];
      }
      std::fill(this->Sums + Parts / 2, this->Sums + Parts, glm::dvec3(0.0));
    }
    this->End = end;
  }

  void Add(int index, const glm::vec3& value)
  {
    this->Sums[index * Parts / this->End] += glm::dvec3(value);
  }

  SampleMean GetMean() const
  {
    glm::dvec3 total(0.0);
    glm::dvec3 squares(0.0);
    for (const glm::dvec3& sum : this->Sums)
    {
      total += sum;
      squares += sum * sum;
    }
    const glm::dvec3 rest = glm::max(squares - total * total / double(Parts), 0.0);
    const double count = this->End;
    return { total / count, rest * (Parts / (Parts - 1.0)) / (count * count) };
  }

private:
  glm::dvec3 Sums[Parts] = {};
  int End = 0;
};

/// A point of the surface. The key identifies the point; it depends on the scene only.
struct SurfacePoint
{
  Hit Place;
  std::uint64_t Key = 0;

  /// The area that it stands for, in scene space.
  float Area = std::numeric_limits<float>::max();
};

/// One half of the estimate of a point.
struct HalfEstimate
{
  /// The value that decides. It is never stored.
  glm::vec3 Pilot{ 0.0f };

  /// The variance of the pilot's mean, estimated with the help of neighbouring points.
  glm::vec3 Variance{ 0.0f };

  /// The distance in scene space beyond which nearly everything it sees lies. Between points
  /// farther apart than this, the value may change although their estimates do not.
  float Reach = std::numeric_limits<float>::infinity();

  /// The value to be stored where the other half has decided.
  glm::vec3 Value{ 0.0f };
};

/// The estimate of a point of the surface.
struct SurfaceEstimate
{
  HalfEstimate Halves[2];

  /// The incident light, if requested, from the first half, which is stored.
  IncidentLight Incident;

  /// The incident light from the second half, which decides where the first is looked up.
  IncidentLight IncidentPilot;

  /// Whether the point lies inside a closed body, where no light is seen from outside.
  bool IsHidden = false;

  SurfaceEstimate() = default;

  /// The estimate of a value without noise.
  explicit SurfaceEstimate(const glm::vec3& value)
  {
    for (HalfEstimate& half : this->Halves)
    {
      half.Pilot = value;
      half.Value = value;
    }
  }

  glm::vec3 GetValue() const { return 0.5f * (this->Halves[0].Value + this->Halves[1].Value); }
};

/// An estimate between two others, or that of the only one which is not hidden.
inline SurfaceEstimate Interpolate(
  const SurfaceEstimate& before, const SurfaceEstimate& after, float weight)
{
  if (before.IsHidden != after.IsHidden)
  {
    return before.IsHidden ? after : before;
  }
  SurfaceEstimate result = weight < 0.5f ? before : after;
  for (int half = 0; half < 2; ++half)
  {
    const HalfEstimate& a = before.Halves[half];
    const HalfEstimate& b = after.Halves[half];
    result.Halves[half] = { glm::mix(a.Pilot, b.Pilot, weight),
      glm::mix(a.Variance, b.Variance, weight), std::min(a.Reach, b.Reach),
      glm::mix(a.Value, b.Value, weight) };
  }
  return result;
}

class SurfaceEstimator
{
public:
  virtual ~SurfaceEstimator() = default;

  struct Request
  {
    std::vector<SurfacePoint> Points;
    PointGraph Graph;           ///< which of the points are next to each other
    bool WantsIncident = false; ///< whether incident light is requested

    /// Gets the progress, in [0,1]. Returns false to stop. May be empty.
    std::function<bool(double)> GoOn;
  };

  /// Estimates all points of a request. Returns nothing if it was stopped.
  virtual std::vector<SurfaceEstimate> Estimate(const Request& request) = 0;
};
}

#endif
