// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Writes one coded file, alone or together with the other ranks of a controller. Each rank pulls
 * viewpoints through its own pipeline; only rank 0 touches files.
 */
#ifndef cslfEncodeSession_h
#define cslfEncodeSession_h

#include "Pipeline/cslfPhase.h"
#include "cslfEncodeRanks.h"
#include "cslfFileAssembler.h"
#include "cslfHeldOutViews.h"
#include "cslfViewpointReader.h"

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkAlgorithmOutput;
class vtkInformation;
class vtkMultiProcessController;

namespace cslf
{
/// What is written, and callbacks.
struct EncodeJob
{
  std::string FileName;
  EncodeSettings Settings;
  std::vector<FilePart> Parts;

  /// Gives the part with the field's geometry, if there is one, when the input has been read.
  std::function<std::optional<FilePart>(const Description&, const std::vector<FilePart>&)>
    GetGeometry;

  /// Measures the finished file, on rank 0. May be empty on all ranks.
  FileAssembler::Certifier Certify;
  bool Restart = true;
  bool Overwrite = true; ///< whether an earlier file is replaced
  vtkAlgorithmOutput* Connection = nullptr;
  vtkInformation* Input = nullptr; ///< the connection's pipeline information
  vtkMultiProcessController* Controller = nullptr;
  vtkAlgorithm* Reporter = nullptr; ///< its progress is that of writing; it may be asked to stop
  std::function<void(const std::string&)> Warn;

  /// Gets how many groups an interrupted run has left, and how many there are. May be empty.
  std::function<void(int, int)> Resume;

  /// Ends the cooperation of the ranks' inputs in making their first viewpoint. Gets whether this
  /// rank's input has it, and returns whether no other rank has failed. May be empty.
  std::function<bool(bool)> Synchronize;
};

/// Why a file was not written: one of vtkErrorCode's, and a sentence.
struct EncodeError
{
  unsigned long Code = 0;
  std::string Text;
};

/// The results.
struct EncodeOutcome
{
  double CRF = 0.0; ///< the mean of all frames
  double Bytes = 0.0;
  double Ratio = 0.0; ///< raw 24-bit colour to the file
  double PSNR = 0.0;  ///< of colour, as measured by RateControl
  int KeyViewStep = 1;
  double NovelViewPSNR = 0.0; ///< where it chose the step
  bool ComputesDepth = false; ///< readers do, from the geometry
  ///@{
  /// Of the viewpoints that were tried.
  double GeometryLoss = 0.0;
  double ColorShare = 0.0;
  ///@}
};

class EncodeSession
{
public:
  explicit EncodeSession(EncodeJob job);
  ~EncodeSession();

  /// Checks everything that can be checked before the input executes, on all ranks. An earlier
  /// error of this rank comes first. False if there is an error on any rank.
  bool Check(const EncodeError& before);

  /// Writes the file, on all ranks. The input contains its first viewpoint unless it has failed,
  /// because of a problem if it is known.
  bool Write(bool hasInput, const std::string& problem = {});

  bool HasWritten() const { return this->Written; }

  /// Makes Write fail, because it was stopped while the input made its first viewpoint.
  void Stop() { this->IsStopped = true; }
  bool IsToStop() const { return this->IsStopped; }

  /// After Check, the folder where the input may keep data for a restart. Empty on ranks that do
  /// not touch files.
  PersistentFile GetCacheFile() const;

  /// The error, if the code is not NoError. The text is empty if another rank reports it.
  const EncodeError& GetError() const { return this->Error; }

  /// The results, on rank 0 after success.
  const EncodeOutcome& GetOutcome() const { return this->Outcome; }

private:
  bool Fail(unsigned long code, const std::string& text);
  bool FailWriting(unsigned long code, const std::string& error);
  bool ContinueIf(bool isAsked);
  bool Try(const std::function<bool()>& step);
  void ReportStored(int stored);
  bool HasNoError() const;
  bool Agree(const std::string& shared, int* fromRoot = nullptr);
  bool CheckHere();
  bool CheckGrid();
  void WriteField(bool hasInput);
  bool BeginReading();
  bool ChooseKeyViews(bool isReady);
  bool TryKeyViews();
  bool ChooseGeometry(bool isReady);
  bool AddGeometry();
  bool TryGeometry();
  bool BeginWriting();
  bool OpenFolder();

  int CodeGroups(); ///< the number of groups that will be stored in the end
  void CodeOnRoot();
  void CodeOnOthers();
  bool FinishFile();
  bool CodeNextTasks(bool& isDone);
  bool RecordTasks(const std::vector<CodingTask>& tasks);

  int CountSlicesThatFit() const;
  int GetGroupsAtOnce() const;
  bool CodeTasks(const std::vector<CodingTask>& tasks, std::vector<CodingResult>& results);
  bool StoreResults(const std::vector<CodingResult>& results);
  void WritePreview();

  /// The share of coding that is done, with a part of the tasks that are being done.
  double GetShareAt(double ofTasks) const;

  bool ReportTasks(double share);
  bool ReportProgress();
  bool ReportInput(vtkAlgorithm* producer);

  EncodeJob Job;
  EncodeRanks Peers;
  EncodeError Error;
  EncodeOutcome Outcome;
  std::optional<Layout> Grid; ///< of the input
  std::optional<ViewpointReader> Input;
  std::optional<FileAssembler> Assembler;
  std::optional<GroupSource> Source;
  std::optional<RateControl> Control;       ///< rank 0
  std::vector<unsigned char> GeometryBytes; ///< coded; only on rank 0
  KeyViewChoice Choice;
  GeometryPlan Plan;
  std::uint32_t Checksum = 0;  ///< of the first viewpoint: stands for the field's samples
  std::optional<Phase> Coding; ///< rank 0, while it lasts
  std::size_t TasksAtWork = 0;
  bool IsStopped = false;
  bool Written = false;
  bool HasCheckedRoom = false;
  bool HasWarnedOfPreview = false;
  std::chrono::steady_clock::time_point NextPreview; ///< when it may be written
};
}

#endif
