// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Messages between the ranks of a controller that never make one wait for another: sending returns
 * at once, and receiving takes what has come. Waiting, where there is nothing else to do, leaves
 * the processor to others.
 */
#ifndef cslfRanks_h
#define cslfRanks_h

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

class vtkMultiProcessController;

namespace cslf
{
class Ranks
{
public:
  struct Message
  {
    int From = 0;
    std::vector<std::uint8_t> Bytes;
  };

  /// A controller that is null stands for one rank.
  explicit Ranks(vtkMultiProcessController* controller);

  /// What was posted must have been sent: see Flush.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int GetRank() const { return this->Rank; }
  int GetCount() const { return this->Count; }

  /// Whether messages can be sent: there is one rank, or the controller is MPI's.
  bool CanTalk() const;

  /// Sends. Messages from one rank to another come in order.
  void Post(int to, std::vector<std::uint8_t> bytes);

  /// The next message that has come whole, from any rank. Also keeps sending.
  std::optional<Message> Poll();

  /// The next message.
  Message Wait();

  /// Waits until all is sent.
  void Flush();

private:
  void KeepSending();

  int Rank = 0;
  int Count = 1;
  struct Traffic;
  std::unique_ptr<Traffic> Pending;
};
}

#endif
