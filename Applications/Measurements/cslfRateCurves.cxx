// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfRateCurves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cslf::tool
{
namespace
{
/// The logarithm of the bytes as a function of PSNR.
class RateCurve
{
public:
  explicit RateCurve(std::vector<RatePoint> points)
  {
    std::sort(points.begin(), points.end(),
      [](const RatePoint& a, const RatePoint& b) { return a.PSNR < b.PSNR; });
    for (const RatePoint& point : points)
    {
      if (point.Bytes > 0.0 && (this->X.empty() || point.PSNR > this->X.back()))
      {
        this->X.push_back(point.PSNR);
        this->Y.push_back(std::log(point.Bytes));
      }
    }
    if (this->IsValid())
    {
      this->FindSlopes();
    }
  }

  bool IsValid() const { return this->X.size() >= 2; }
  double GetMinimum() const { return this->X.front(); }
  double GetMaximum() const { return this->X.back(); }
  const std::vector<double>& GetKnots() const { return this->X; }

  double Evaluate(double x) const
  {
    const auto above = std::upper_bound(this->X.begin() + 1, this->X.end() - 1, x);
    const auto k = static_cast<std::size_t>(above - this->X.begin()) - 1;
    const double width = this->X[k + 1] - this->X[k];
    const double t = (x - this->X[k]) / width;
    const double u = 1.0 - t;
    return u * u * (1.0 + 2.0 * t) * this->Y[k] + t * t * (3.0 - 2.0 * t) * this->Y[k + 1] +
      width * t * u * (u * this->Slopes[k] - t * this->Slopes[k + 1]);
  }

private:
  /// Harmonic means of the neighbouring chords' slopes, flat where these differ in sign.
  void FindSlopes()
  {
    const std::size_t last = this->X.size() - 1;
    const auto chord = [this](std::size_t k)
    { return (this->Y[k + 1] - this->Y[k]) / (this->X[k + 1] - this->X[k]); };
    this->Slopes.assign(last + 1, 0.0);
    this->Slopes[0] = chord(0);
    this->Slopes[last] = chord(last - 1);
    for (std::size_t k = 1; k < last; ++k)
    {
      const double before = this->X[k] - this->X[k - 1];
      const double after = this->X[k + 1] - this->X[k];
      if (chord(k - 1) * chord(k) > 0.0)
      {
        const double first = (before + 2.0 * after) / chord(k - 1);
        const double second = (2.0 * before + after) / chord(k);
        this->Slopes[k] = 3.0 * (before + after) / (first + second);
      }
    }
  }

  std::vector<double> X;
  std::vector<double> Y;
  std::vector<double> Slopes;
};
}

std::optional<double> ComputeDeltaRate(
  const std::vector<RatePoint>& reference, const std::vector<RatePoint>& tested)
{
  const RateCurve first(reference);
  const RateCurve second(tested);
  if (!first.IsValid() || !second.IsValid())
  {
    return std::nullopt;
  }
  const double low = std::max(first.GetMinimum(), second.GetMinimum());
  const double high = std::min(first.GetMaximum(), second.GetMaximum());
  if (!(high > low))
  {
    return std::nullopt;
  }
  std::vector<double> knots = { low, high };
  for (const RateCurve* curve : { &first, &second })
  {
    std::copy_if(curve->GetKnots().begin(), curve->GetKnots().end(), std::back_inserter(knots),
      [=](double knot) { return knot > low && knot < high; });
  }
  std::sort(knots.begin(), knots.end());
  // Simpson's rule is exact for cubics, and the curves are cubics between the knots of both.
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k)
  {
    const auto difference = [&](double x) { return second.Evaluate(x) - first.Evaluate(x); };
    const double middle = 0.5 * (knots[k] + knots[k + 1]);
    sum += (knots[k + 1] - knots[k]) / 6.0 *
      (difference(knots[k]) + 4.0 * difference(middle) + difference(knots[k + 1]));
  }
  return std::exp(sum / (high - low)) - 1.0;
}

std::vector<RatePoint> FindFront(std::vector<RatePoint> points)
{
  std::sort(points.begin(), points.end(),
    [](const RatePoint& a, const RatePoint& b)
    { return a.Bytes < b.Bytes || (a.Bytes == b.Bytes && a.PSNR > b.PSNR); });
  std::vector<RatePoint> front;
  for (const RatePoint& point : points)
  {
    if (front.empty() || point.PSNR > front.back().PSNR)
    {
      front.push_back(point);
    }
  }
  return front;
}

std::optional<double> FindBytes(const std::vector<RatePoint>& front, double psnr)
{
  const auto above = std::find_if(
    front.begin(), front.end(), [psnr](const RatePoint& point) { return point.PSNR >= psnr; });
  if (above == front.end())
  {
    return std::nullopt;
  }
  if (above == front.begin())
  {
    return above->Bytes;
  }
  const RatePoint& below = *(above - 1);
  const double part = (psnr - below.PSNR) / (above->PSNR - below.PSNR);
  return below.Bytes * std::pow(above->Bytes / below.Bytes, part);
}

std::optional<double> FindPSNR(const std::vector<RatePoint>& front, double bytes)
{
  const auto above = std::find_if(
    front.begin(), front.end(), [bytes](const RatePoint& point) { return point.Bytes > bytes; });
  if (above == front.begin())
  {
    return std::nullopt;
  }
  const RatePoint& below = *(above - 1);
  if (above == front.end())
  {
    return below.PSNR;
  }
  const double part = std::log(bytes / below.Bytes) / std::log(above->Bytes / below.Bytes);
  return below.PSNR + part * (above->PSNR - below.PSNR);
}
}
