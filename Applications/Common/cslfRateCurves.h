// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Quality against size: curves through a few measured points, how far two are apart, and what the
 * best points of many come to.
 */
#ifndef cslfRateCurves_h
#define cslfRateCurves_h

#include <optional>
#include <vector>

namespace cslf
{
namespace tool
{
/// What a coder does at one setting.
struct RatePoint
{
  double Bytes = 0.0;
  double PSNR = 0.0; ///< in dB
};

/// The Bjontegaard delta rate (ITU-T VCEG-M33): by what part of the reference's bytes those of the
/// tested coder differ at equal PSNR, on the average over the PSNR that both reach; -0.1 is 10 %
/// fewer. The logarithm of the bytes is interpolated over PSNR by piecewise cubics that are
/// monotone where the points are (Fritsch and Carlson 1980). Nothing where a curve has fewer than
/// two points or the curves share no range.
std::optional<double> ComputeDeltaRate(
  const std::vector<RatePoint>& reference, const std::vector<RatePoint>& tested);

/// The points than which no other one has both fewer bytes and a higher PSNR, the smallest first.
std::vector<RatePoint> FindFront(std::vector<RatePoint> points);

/// The bytes at which a front has this PSNR: between two points their logarithm is linear in dB.
/// What is worse than the smallest point takes the bytes of that; nothing for what is better than
/// all.
std::optional<double> FindBytes(const std::vector<RatePoint>& front, double psnr);

/// The PSNR that a front has at these bytes, likewise. With more bytes than any the best; nothing
/// for fewer than the smallest point's.
std::optional<double> FindPSNR(const std::vector<RatePoint>& front, double bytes);
}
}

#endif
