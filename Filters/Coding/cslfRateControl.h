// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which groups are coded when, and with which rate factors, so that a file comes out with the size
 * or the quality that is wanted. See Documentation/Compression.md.
 *
 * First a sample of the groups is coded with a low and a high factor, on trial. Then all groups are
 * coded for good, in stages; before each the factor is worked out anew from all that is known.
 */
#ifndef cslfRateControl_h
#define cslfRateControl_h

#include "Coding/cslfGroupStages.h"
#include "Coding/cslfRateModel.h"

#include <functional>
#include <string>
#include <vector>

namespace cslf
{
/// What a user wants of a file.
struct RateTarget
{
  enum class Kinds
  {
    Factor, ///< nothing but a rate factor of colour
    Ratio,  ///< raw 24-bit colour to the file, as a ratio
    Bytes,  ///< of the file
    PSNR    ///< of decoded colour against the field, in dB
  };

  Kinds Kind = Kinds::Factor;
  double Value = 0.0;
};

/// The target that is set: the one of these that is above 0, if any is.
VTKCSLF_EXPORT RateTarget MakeRateTarget(double ratio, double bytes, double psnr);

/// What is wrong with a target, in a sentence; empty where nothing is.
std::string FindFault(const RateTarget& target, bool isLossless);

/// What is to be coded.
struct RateField
{
  std::vector<int> Frames;  ///< of each group
  double FrameTexels = 0.0; ///< of one frame
  /// What the container holds beside the groups, without or with a coverage track.
  std::function<double(bool hasCoverage)> GetContainerBytes;
};

class VTKCSLF_EXPORT RateControl
{
public:
  RateControl(const RateTarget& target, RateField field);

  const GroupStages& GetStages() const { return this->Stages; }

  /// What is to be done next, after all that was to be done before has been reported; nothing at
  /// the end. On failure, which is a target out of reach, returns false and says why, in one line.
  bool Next(std::vector<CodingTask>& tasks, std::string& error);

  ///@{
  /// Reports what came out of tasks.
  void AddTrial(int group, double factor, const GroupCost& cost);
  void AddCoded(int group, const GroupCost& cost);
  ///@}

  ///@{
  /// What all trials brought, as text, so that a run that was killed need not repeat them. Text
  /// that is not whole is ignored.
  std::string GetTrials() const;
  void SetTrials(const std::string& text);
  ///@}

  /// How many codings on trial there have been, and how many are expected: of each group of the
  /// sample with each of the first factors.
  int GetTrialCount() const { return static_cast<int>(this->Trials.size()); }
  int GetExpectedTrials() const;

  /// The bytes of raw 24-bit colour.
  double GetRawBytes() const;

  /// The mean rate factor of all frames.
  double GetMeanFactor() const;

  /// The PSNR of colour over the groups whose error is known, in dB, at most 100; 0 if none is.
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
  std::vector<double> Factors; ///< of each group, as far as it was dealt
  double SquaredError = 0.0;
  double MeasuredFrames = 0.0;
};
}

#endif
