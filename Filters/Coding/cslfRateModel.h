// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a field costs at a rate factor, predicted from some of its groups.
 *
 * A field has one level of quality, a real number. Rate factors are whole numbers, since coders
 * round them sooner or later: of a field of level 24.3 three groups of ten, evenly spread, have the
 * factor 25, the others 24.
 */
#ifndef cslfRateModel_h
#define cslfRateModel_h

#include "Coding/cslfCodingTask.h"
#include "vtkCSLFModule.h"

#include <map>
#include <optional>
#include <vector>

namespace cslf
{
/// The smallest and the largest rate factor.
constexpr double LeastFactor = 0.0;
constexpr double MostFactor = 51.0;

class VTKCSLF_EXPORT RateModel
{
public:
  /// What is predicted.
  enum class Measures
  {
    Bytes,       ///< of all tracks; of coverage unless it is full everywhere as far as is known
    SquaredError ///< of colour
  };

  /// For groups of so many frames each.
  RateModel(Measures measure, std::vector<int> frames);

  /// The rate factor of a group in a field of that level.
  static double GetFactor(int group, double level);

  ///@{
  /// What a group costs at a rate factor, on trial or for good. Trials of one factor are made of
  /// the same groups as those of any other.
  void AddTrial(int group, double factor, const GroupCost& cost);
  void AddCoded(int group, double factor, const GroupCost& cost);
  ///@}

  /// Whether coverage is full in all groups known.
  bool IsCoveredFully() const { return this->CoveredFully; }

  /// The rate factors that were tried, ascending.
  std::vector<double> GetTried() const;

  /// What the whole field costs if all groups that are not coded for good have that level. There
  /// must be trials of two factors.
  double Predict(double level) const;

  /// The level at which the whole field costs `goal`, or the nearest one from 0 to 51.
  double Solve(double goal) const;

private:
  struct Coded
  {
    double Factor;
    GroupCost Cost;
  };

  double Measure(const GroupCost& cost) const;
  std::map<double, double> SumTrials() const;
  std::vector<double> FindWeights(const std::map<double, double>& sums, double near) const;
  double Sum(
    const std::vector<double>& weights, const std::map<double, double>& sums, double level) const;

  Measures Kind;
  bool CoveredFully = true;
  std::vector<int> Frames;
  std::vector<std::map<double, GroupCost>> Trials; ///< of each group, by factor
  std::vector<std::optional<Coded>> Done;          ///< each group's, if it is coded for good
};
}

#endif
