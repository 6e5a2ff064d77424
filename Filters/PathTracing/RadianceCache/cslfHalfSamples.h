// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The samples of one half of a point's estimate.
 */
#ifndef cslfHalfSamples_h
#define cslfHalfSamples_h

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>

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
}

#endif
