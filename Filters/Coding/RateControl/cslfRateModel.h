// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Predicts the cost of a field at a rate factor from some of its groups.
 *
 * A field has one level of quality, a real number. Rate factors are whole numbers, because encoders
 * round them. At level 24.3, three of ten groups, evenly spread, have the factor 25, the others 24.
 */
#ifndef cslfRateModel_h
#define cslfRateModel_h

#include "Coding/Groups/cslfGroupEncoder.h"
#include "vtkCSLFModule.h"

#include <map>
#include <optional>
#include <vector>

namespace cslf
{
/// The smallest and the largest rate factor.
constexpr double MinimumFactor = 0.0;
constexpr double MaximumFactor = 51.0;

class VTKCSLF_EXPORT RateModel
{
public:
  /// The predicted quantity.
  enum class Measures
  {
    Bytes,       ///< of all tracks; of coverage unless all known coverage is full
    SquaredError ///< of colour
  };

  /// For groups of so many frames each.
  RateModel(Measures measure, std::vector<int> frames);

  /// The rate factor of a group in a field of that level.
  static double GetFactor(int group, double level);

  ///@{
  /// Adds the cost of a group at a rate factor, from a trial or from the final coding. All factors
  /// are tried with the same groups.
  void AddTrial(int group, double factor, const GroupCost& cost);
  void AddCoded(int group, double factor, const GroupCost& cost);
  ///@}

  /// Whether coverage is full in all known groups.
  bool IsCoveredFully() const { return this->CoveredFully; }

  /// The rate factors that were tried, ascending.
  std::vector<double> GetTried() const;

  /// The cost of the whole field if all groups without a final coding have that level. Needs trials
  /// of two factors.
  double Predict(double level) const;

  /// The level at which the whole field costs `goal`, or the nearest one in [0,51].
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
  std::vector<std::optional<Coded>> Done;          ///< of each group with a final coding
};
}

#endif
