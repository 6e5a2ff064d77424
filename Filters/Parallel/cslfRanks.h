// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Non-blocking messages between the ranks of a controller: sending returns at once, and receiving
 * takes messages that have arrived. Waiting, for a rank without other work, leaves the processor to
 * others.
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

  /// A null controller means one rank.
  explicit Ranks(vtkMultiProcessController* controller);

  /// All posted messages must have been sent: see Flush.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int GetRank() const { return this->Rank; }
  int GetCount() const { return this->Count; }

  /// Whether messages can be sent: there is one rank, or the controller is MPI's.
  bool CanTalk() const;

  /// Sends. Messages from one rank to another arrive in order.
  void Post(int to, std::vector<std::uint8_t> bytes);

  /// The next complete message, from any rank. Also continues sending.
  std::optional<Message> Poll();

  /// Waits for the next message.
  Message Wait();

  /// Waits until everything is sent.
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
