// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Quality against size: curves through a few measured points, the difference between two curves,
 * and the best points of many.
 */
#ifndef cslfRateCurves_h
#define cslfRateCurves_h

#include <optional>
#include <vector>

namespace cslf::tool
{
/// The result of a coder at one setting.
struct RatePoint
{
  double Bytes = 0.0;
  double PSNR = 0.0; ///< in dB
};

/// The Bjontegaard delta rate (ITU-T VCEG-M33): the relative difference of the tested coder's bytes
/// from the reference's at equal PSNR, averaged over the PSNR that both reach; -0.1 is 10 % fewer.
/// The logarithm of the bytes is interpolated over PSNR by piecewise cubics that are monotone where
/// the points are (Fritsch and Carlson 1980). Nothing if a curve has fewer than two points or the
/// curves share no range.
std::optional<double> ComputeDeltaRate(
  const std::vector<RatePoint>& reference, const std::vector<RatePoint>& tested);

/// The points that no other point beats in both bytes and PSNR, the smallest first.
std::vector<RatePoint> FindFront(std::vector<RatePoint> points);

/// The bytes at which a front has this PSNR: between two points their logarithm is linear in dB. A
/// lower PSNR than that of the smallest point takes its bytes. Nothing for a higher PSNR than all.
std::optional<double> FindBytes(const std::vector<RatePoint>& front, double psnr);

/// The PSNR that a front has at these bytes, likewise. The best one for more bytes than all;
/// nothing for fewer than those of the smallest point.
std::optional<double> FindPSNR(const std::vector<RatePoint>& front, double bytes);
}

#endif
