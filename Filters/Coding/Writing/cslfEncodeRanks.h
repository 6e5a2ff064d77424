// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Shares the work of writing one file among ranks.
 *
 * Rank 0 hands out tasks. Each rank asks for some, does them, sends the results to rank 0 and asks
 * again, always one share ahead so that it does not wait. Rank 0 works too, and serves the others
 * whenever it is called. If one rank fails, all stop.
 */
#ifndef cslfEncodeRanks_h
#define cslfEncodeRanks_h

#include "Coding/Groups/cslfGroupEncoder.h"
#include "Parallel/cslfRanks.h"
#include "cslfGroupStore.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cslf
{
class EncodeRanks
{
public:
  /// The state of the ranks.
  struct Verdict
  {
    int Failed = -1;      ///< the lowest rank with an error, or -1
    bool Differs = false; ///< rank 0: no error, but the ranks' `shared` differ
    int FromRoot = 0;     ///< the number given by rank 0
  };

  /// Does tasks. False on failure.
  using Worker =
    std::function<bool(const std::vector<CodingTask>& tasks, std::vector<CodingResult>& results)>;

  /// Takes the results of some rank's tasks; a rank whose message is damaged has none. False on
  /// failure.
  using Receiver = std::function<bool(std::vector<CodingResult>& results)>;

  explicit EncodeRanks(vtkMultiProcessController* controller);

  int GetRank() const { return this->Team.GetRank(); }
  int GetCount() const { return this->Team.GetCount(); }
  bool CanTalk() const { return this->Team.CanTalk(); }

  /// Called by all ranks: finds out whether any has an error, and whether `shared` is the same on
  /// all. Every rank gets rank 0's number.
  Verdict Agree(bool hasSucceeded, const std::string& shared, int fromRoot);

  /// Rank 0: lets all ranks do the tasks, at most `atOnce` at a time. True when all are done.
  bool DoTasks(std::vector<CodingTask> tasks, int atOnce, const Worker& make, const Receiver& take);

  /// Rank 0: releases the others. Called once after the last DoTasks, whether or not it failed.
  void ReleaseOthers();

  /// Other ranks: does the tasks that rank 0 hands out until there are no more.
  void ServeRoot(const Worker& make);

  /// To be called regularly during work. False if the work must stop.
  bool Serve();

  /// Whether the work was stopped early, by this rank or another.
  bool IsStopped() const { return this->Stopped; }

  /// Rank 0: the first of the others that failed, or -1.
  int GetFailedRank() const { return this->FailedRank; }

private:
  int FindFailed(bool hasSucceeded, const std::string& shared, bool& differs);
  std::vector<CodingTask> ChooseTasks(int rank);
  void Handle(Ranks::Message message);
  void HandleShare(ByteBuffer& content);
  void SendTasks(int rank);
  void StopOthers();

  Ranks Team;
  bool Stopped = false; ///< the remaining work is not needed

  // Rank 0
  std::vector<CodingTask> Remaining;
  int AtOnce = 1;
  const Receiver* Receive = nullptr;  ///< while DoTasks is at work
  std::map<int, int> Workers;         ///< the rank that worked on a group last
  std::vector<int> Waiting;           ///< ranks that asked when there were no tasks
  std::vector<Ranks::Message> States; ///< final results of the others
  int Outstanding = 0;                ///< the number of shares in work
  int Working = 0;                    ///< the number of other ranks that are not done
  int FailedRank = -1;
  bool Released = false;

  std::optional<std::vector<CodingTask>> Received; ///< other ranks: the next tasks
};
}

#endif
