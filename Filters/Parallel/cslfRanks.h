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

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkMultiProcessController;

namespace cslf
{
/// The largest part of a message, in bytes.
constexpr std::size_t MaximumMessage = std::size_t(1) << 28;

/// Sends bytes from one rank to all others, at most `partSize` at a time.
void BroadcastBytes(vtkMultiProcessController* controller, void* bytes, std::size_t count,
  int sender, std::size_t partSize = MaximumMessage);

/// Sends a text from one rank to all others.
void BroadcastText(vtkMultiProcessController* controller, std::string& text, int sender);

/// The lowest rank with a fault, or -1 if no rank has one. On all other ranks, `fault` becomes a
/// message with that rank's number and fault.
int ShareError(vtkMultiProcessController* controller, std::string& fault);

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
