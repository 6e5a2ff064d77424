// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How the ranks that write one file share the work.
 *
 * Rank 0 deals tasks: each rank asks for some, does them, sends what came out to rank 0, and asks
 * again, always one ahead so that it need not wait. Rank 0 works too, and serves the others
 * whenever it is told to. Where one rank fails, all stop.
 */
#ifndef cslfEncodeCrew_h
#define cslfEncodeCrew_h

#include "Coding/cslfCodingTask.h"
#include "Coding/cslfPart.h"
#include "Parallel/cslfRanks.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cslf
{
class EncodeCrew
{
public:
  /// How the ranks stand.
  struct Verdict
  {
    int Failed = -1;      ///< the lowest rank on which something went wrong, or -1
    bool Differs = false; ///< rank 0: all is well but for what the ranks should have in common
    int Told = 0;         ///< what rank 0 had to tell
  };

  /// Does tasks, and puts what came out behind what is in the buffer. False on failure.
  using Maker = std::function<bool(const std::vector<CodingTask>& tasks, ByteBuffer& results)>;

  /// Takes what came out of some rank's tasks. False on failure.
  using Taker = std::function<bool(ByteBuffer& results)>;

  explicit EncodeCrew(vtkMultiProcessController* controller);

  int GetRank() const { return this->Team.GetRank(); }
  int GetCount() const { return this->Team.GetCount(); }
  bool CanTalk() const { return this->Team.CanTalk(); }

  /// Called by all ranks: tells whether all is well on each, and whether `shared` is the same on
  /// all. Every rank gets the number that rank 0 tells.
  Verdict Agree(bool isWell, const std::string& shared, int told);

  /// Rank 0: has the tasks done by all ranks, at most `atOnce` at a time. True when all are.
  bool Lead(std::vector<CodingTask> tasks, int atOnce, const Maker& make, const Taker& take);

  /// Rank 0: lets the others go. Called once after the last Lead, however that ended.
  void Dismiss();

  /// Other ranks: does what rank 0 deals until it has nothing more.
  void Follow(const Maker& make);

  /// To be called now and then by whoever works. False if the work is to stop.
  bool Serve();

  /// Whether the work was broken off, by this rank or another.
  bool IsStopped() const { return this->Stopped; }

  /// Rank 0: the first of the others that failed, or -1.
  int GetFailedRank() const { return this->FailedRank; }

private:
  int FindFailed(bool isWell, const std::string& shared, bool& differs);
  std::vector<CodingTask> Choose(int rank);
  void Handle(Ranks::Message message);
  void HandleShare(ByteBuffer& content);
  void Deal(int rank);
  void StopOthers();

  Ranks Team;
  bool Stopped = false; ///< what is still to be done need not be

  // Rank 0
  std::vector<CodingTask> Undealt;
  int AtOnce = 1;
  const Taker* Take = nullptr;        ///< while Lead is at work
  std::map<int, int> Makers;          ///< who worked on a group last
  std::vector<int> Waiting;           ///< ranks that asked when there was nothing to deal
  std::vector<Ranks::Message> States; ///< what the others have said in the end
  int Outstanding = 0;                ///< how many shares are being worked on
  int Working = 0;                    ///< how many other ranks are not done
  int FailedRank = -1;
  bool Dismissed = false;

  std::optional<std::vector<CodingTask>> Dealt; ///< other ranks: what to do next
};
}

#endif
