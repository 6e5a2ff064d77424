// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Sampling in proportion to a table.
 */
#ifndef cslfDistribution_h
#define cslfDistribution_h

#include "vtkCSLFModule.h" // for export macro

#include <glm/vec2.hpp>

#include <cstddef>
#include <vector>

namespace cslf
{
/// An entry of a table, chosen in proportion to its weight.
struct DiscreteSample
{
  std::size_t Index = 0;
  float Probability = 0.0f;
  float Remainder = 0.0f; ///< the random number used, stretched to [0,1) within the entry
};

class VTKCSLF_EXPORT Distribution1D
{
public:
  Distribution1D() = default;

  /// Weights must not be negative.
  explicit Distribution1D(const std::vector<double>& weights);

  /// The sum of the weights. 0 if nothing can be sampled.
  double GetTotal() const { return this->Total; }
  std::size_t GetSize() const { return this->Cumulative.size(); }
  DiscreteSample Sample(float u) const;
  float GetProbability(std::size_t index) const;

private:
  std::vector<double> Cumulative; // each entry's upper end, ascending to 1
  double Total = 0.0;
};

/// A point of the unit square, whose density is piecewise constant on a grid of `width` x `height`.
class VTKCSLF_EXPORT Distribution2D
{
public:
  Distribution2D() = default;

  /// Weights row by row.
  Distribution2D(const std::vector<double>& weights, std::size_t width, std::size_t height);

  double GetTotal() const { return this->Rows.GetTotal(); }

  /// The point and its density over the square.
  glm::vec2 Sample(const glm::vec2& u, float& pdf) const;
  float GetPdf(const glm::vec2& point) const;

private:
  Distribution1D Rows;
  std::vector<Distribution1D> Columns; // of each row
};
}

#endif
