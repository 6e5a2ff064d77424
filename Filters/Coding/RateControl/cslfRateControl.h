// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Chooses the order and the rate factors of groups, so that a file gets the wanted size or quality.
 * See Documentation/Compression.md.
 *
 * First, trials code a sample of the groups with a low and a high factor. Then all groups are coded
 * in stages. Before each stage the factor is computed again from all results.
 */
#ifndef cslfRateControl_h
#define cslfRateControl_h

#include "cslfRateModel.h"
#include "vtkCSLFModule.h"

#include <functional>
#include <string>
#include <vector>

namespace cslf
{
/// The bytes of a texel of raw 24-bit colour.
constexpr double RawTexelBytes = 3.0;

class VTKCSLF_EXPORT GroupStages
{
public:
  /// For so many groups.
  explicit GroupStages(int count);

  int GetStageCount() const { return this->StageCount; }

  /// The groups of a stage, ascending. Stage 0 is the sample: every n-th group, where n is a power
  /// of two from 1 to 16 for which there are at least 24, unless there are fewer groups.
  std::vector<int> GetGroups(int stage) const;

private:
  std::vector<int> Stages; ///< of each group
  int StageCount = 1;
};

/// The user's target for a file.
struct RateTarget
{
  enum class Kinds
  {
    Factor, ///< only a rate factor of colour
    Ratio,  ///< the ratio of raw 24-bit colour to the file
    Bytes,  ///< of the file
    PSNR    ///< of decoded colour against the field, in dB
  };

  Kinds Kind = Kinds::Factor;
  double Value = 0.0;
};

/// The target that is set: the one that is above 0, if any is.
VTKCSLF_EXPORT RateTarget MakeRateTarget(double ratio, double bytes, double psnr);

/// What is wrong with a target, in a sentence. Empty if nothing is.
std::string FindError(const RateTarget& target, bool isLossless);

/// The field to be coded.
struct RateField
{
  std::vector<int> Frames;  ///< of each group
  double FrameTexels = 0.0; ///< of one frame
  double FieldTexels = 0.0; ///< of all viewpoints, also those that are not coded
  /// What the container holds beside the groups, without or with a coverage track.
  std::function<double(bool hasCoverage)> GetContainerBytes;
};

class VTKCSLF_EXPORT RateControl
{
public:
  RateControl(const RateTarget& target, RateField field);

  /// The next tasks, after the results of all earlier ones were reported; none at the end. If the
  /// target cannot be reached, returns false and gives the reason in one line.
  bool Next(std::vector<CodingTask>& tasks, std::string& error);

  ///@{
  /// Reports the results of tasks.
  void AddTrial(int group, double factor, const GroupCost& cost);
  void AddCoded(int group, const GroupCost& cost);
  ///@}

  ///@{
  /// The results of all trials as text, so that a restarted run does not repeat them. Incomplete
  /// text is ignored.
  std::string GetTrials() const;
  void SetTrials(const std::string& text);
  ///@}

  /// The number of trials so far, and the expected number: each group of the sample with each of
  /// the first factors.
  int GetTrialCount() const { return static_cast<int>(this->Trials.size()); }
  int GetExpectedTrials() const;

  /// The bytes of raw 24-bit colour.
  double GetRawBytes() const;

  /// The mean rate factor of all frames.
  double GetMeanFactor() const;

  /// The PSNR of colour over the groups whose error is known, in dB, at most 100. 0 if none is
  /// known.
  double GetPSNR() const;

private:
  struct Trial
  {
    int Group;
    double Factor;
    GroupCost Cost;
  };

  double GetGoal() const;
  bool NeedsTrial(double level) const;
  bool IsReached(double level) const;
  std::string DescribeReach(double level) const;
  std::vector<CodingTask> MakeTrials(const std::vector<double>& factors) const;
  std::vector<CodingTask> MakeStage(double level);

  RateTarget Target;
  RateField Field;
  GroupStages Stages;
  RateModel Model;
  std::vector<Trial> Trials;
  int Stage = 0;               ///< the next one
  double Level = 0.0;          ///< of the last one
  std::vector<double> Factors; ///< of each group that was handed out
  double SquaredError = 0.0;
  double MeasuredFrames = 0.0;
};
}

#endif
