// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Writes one coded file, alone or together with the other ranks of a controller.
 *
 * Rank 0 deals the groups: each rank asks for some, pulls their viewpoints through its own
 * pipeline, codes them, sends them to rank 0, and asks again, always one ahead so that it need not
 * wait. Rank 0 works too, and serves the others whenever its pipeline or its coder reports
 * progress. Only rank 0 touches files.
 */
#ifndef cslfEncodeSession_h
#define cslfEncodeSession_h

#include "Coding/cslfFieldWriter.h"
#include "Coding/cslfPart.h"
#include "Parallel/cslfRanks.h"
#include "Pipeline/cslfSlicePuller.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

class vtkAlgorithmOutput;
class vtkInformation;
class vtkMultiProcessController;

namespace cslf
{
/// What is written, and who wants to know.
struct EncodeJob
{
  std::string FileName;
  EncodeSettings Settings;
  bool Restart = true;
  vtkAlgorithmOutput* Connection = nullptr;
  vtkInformation* Input = nullptr; ///< the connection's pipeline information
  vtkMultiProcessController* Controller = nullptr;
  std::function<bool(double)> Progress; ///< gets numbers from 0 to 1; false stops the work
  std::function<void(const std::string&)> Warn;

  /// Ends what the ranks' inputs may have done together to make their first viewpoint: told whether
  /// this rank's has it, tells whether no other has failed. May be empty.
  std::function<bool(bool)> Settle;
};

/// What kept a file from being written: one of vtkErrorCode's, and a sentence.
struct EncodeFault
{
  unsigned long Code = 0;
  std::string Text;
};

class EncodeSession
{
public:
  explicit EncodeSession(EncodeJob job);
  ~EncodeSession();

  /// Checks everything that can be checked before the input works, on all ranks, after what went
  /// wrong on this one already. False if anything did on any rank.
  bool Check(const EncodeFault& before);

  /// Writes the file, on all ranks. The input holds its first viewpoint unless it has failed.
  bool Write(bool hasInput);

  bool HasWritten() const { return this->Written; }

  /// After Check, where the input may keep what a run that is started again can use; empty on ranks
  /// that touch no files.
  std::string GetCacheName() const;

  /// What went wrong, if the code is not NoError. The text is empty where another rank is the one
  /// to tell.
  const EncodeFault& GetFault() const { return this->Fault; }

private:
  bool Fail(unsigned long code, const std::string& text);
  bool FailWriting(unsigned long code, const std::string& error);
  bool Agree(const std::string& shared);
  int FindFailed(const std::string& shared);
  bool CheckHere();
  bool Begin();

  void Lead();
  void Follow();
  void Conclude();

  std::vector<int> Choose() const;
  int GetGroupsAtOnce() const;
  bool MakeGroups(const std::vector<int>& groups, std::vector<GroupParts>& parts);
  bool StoreGroups(const std::vector<int>& groups, const std::vector<GroupParts>& parts);
  bool ReportGroups();

  bool Serve();
  void Handle(Ranks::Message message);
  void HandleGroups(ByteBuffer& content);
  void Deal(int rank);
  void StopOthers();

  EncodeJob Job;
  Ranks Team;
  EncodeFault Fault;
  std::optional<Layout> Grid;
  std::optional<SlicePuller> Puller;
  std::optional<FieldWriter> Writer;
  bool Written = false;

  std::vector<int> Undealt;              ///< rank 0: the groups that nobody works on
  std::vector<Ranks::Message> States;    ///< rank 0: what the others have said in the end
  int Working = 0;                       ///< rank 0: how many other ranks are not done
  int FailedRank = -1;                   ///< rank 0: the first that failed
  bool Stopped = false;                  ///< what is still to be done need not be
  std::optional<std::vector<int>> Dealt; ///< other ranks: what to do next
};
}

#endif
