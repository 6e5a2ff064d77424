// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel/cslfRanks.h"

#include <vtkMultiProcessController.h>

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include <vtkCommunicator.h>
#include <vtkMPICommunicator.h>
#include <vtkMPIController.h>
#endif

#include <algorithm>
#include <chrono>
#include <list>
#include <thread>
#include <utility>

namespace cslf
{
void BroadcastBytes(vtkMultiProcessController* controller, void* bytes, std::size_t count,
  int sender, std::size_t partSize)
{
  for (std::size_t begin = 0; begin < count; begin += partSize)
  {
    const std::size_t size = std::min(partSize, count - begin);
    controller->Broadcast(static_cast<char*>(bytes) + begin, static_cast<vtkIdType>(size), sender);
  }
}

void BroadcastText(vtkMultiProcessController* controller, std::string& text, int sender)
{
  auto length = static_cast<vtkIdType>(text.size());
  controller->Broadcast(&length, 1, sender);
  text.resize(static_cast<std::size_t>(length));
  BroadcastBytes(controller, text.data(), text.size(), sender);
}

int ShareError(vtkMultiProcessController* controller, std::string& fault)
{
  const int count = controller->GetNumberOfProcesses();
  const int rank = controller->GetLocalProcessId();
  const int mine = fault.empty() ? count : rank;
  int first = mine;
  controller->AllReduce(&mine, &first, 1, vtkCommunicator::MIN_OP);
  if (first == count)
  {
    return -1;
  }
  std::string text = fault;
  BroadcastText(controller, text, first);
  if (first != rank)
  {
    fault = "Rank " + std::to_string(first) + " has failed: " + text;
  }
  return first;
}

namespace
{
/// How long a waiting rank sleeps between two checks.
constexpr std::chrono::microseconds Nap(200);
}

#if VTK_MODULE_ENABLE_VTK_ParallelMPI

namespace
{
/// The tag of all messages.
constexpr int Tag = 17235;

/// Messages in transit.
struct Transfer
{
  Ranks::Message Content;
  vtkMPICommunicator::Request Request;
};
}

struct Ranks::Traffic
{
  vtkMPIController* Controller = nullptr;
  std::list<Transfer> Outgoing;
  std::list<Transfer> Incoming;

  void BeginReceiving()
  {
    int isThere = 0;
    int from = 0;
    int size = 0;
    const char* const type = nullptr;
    while (this->Controller->Iprobe(
             vtkMultiProcessController::ANY_SOURCE, Tag, &isThere, &from, type, &size) &&
      isThere)
    {
      this->Incoming.emplace_back();
      Transfer& transfer = this->Incoming.back();
      transfer.Content.From = from;
      transfer.Content.Bytes.resize(size);
      this->Controller->NoBlockReceive(
        reinterpret_cast<char*>(transfer.Content.Bytes.data()), size, from, Tag, transfer.Request);
    }
  }
};

Ranks::Ranks(vtkMultiProcessController* controller)
  : Pending(std::make_unique<Traffic>())
{
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    this->Rank = controller->GetLocalProcessId();
    this->Count = controller->GetNumberOfProcesses();
    this->Pending->Controller = vtkMPIController::SafeDownCast(controller);
  }
}

Ranks::~Ranks() = default;

bool Ranks::CanTalk() const
{
  return this->Count == 1 || this->Pending->Controller;
}

void Ranks::Post(int to, std::vector<std::uint8_t> bytes)
{
  std::list<Transfer>& outgoing = this->Pending->Outgoing;
  outgoing.emplace_back();
  Transfer& transfer = outgoing.back();
  transfer.Content.Bytes = std::move(bytes);
  this->Pending->Controller->NoBlockSend(
    reinterpret_cast<const char*>(transfer.Content.Bytes.data()),
    static_cast<int>(transfer.Content.Bytes.size()), to, Tag, transfer.Request);
}

void Ranks::KeepSending()
{
  this->Pending->Outgoing.remove_if(
    [](Transfer& transfer) { return transfer.Request.Test() != 0; });
}

std::optional<Ranks::Message> Ranks::Poll()
{
  if (this->Count == 1)
  {
    return std::nullopt;
  }
  this->KeepSending();
  this->Pending->BeginReceiving();
  // Only the first one may be taken, to keep the order of a rank's messages.
  std::list<Transfer>& incoming = this->Pending->Incoming;
  if (incoming.empty() || !incoming.front().Request.Test())
  {
    return std::nullopt;
  }
  std::optional<Message> message = std::move(incoming.front().Content);
  incoming.pop_front();
  return message;
}

void Ranks::Flush()
{
  // Receives nothing meanwhile: messages may be for a successor of this object.
  for (this->KeepSending(); !this->Pending->Outgoing.empty(); this->KeepSending())
  {
    std::this_thread::sleep_for(Nap);
  }
}

#else

struct Ranks::Traffic
{
};

Ranks::Ranks(vtkMultiProcessController* controller)
{
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    this->Rank = controller->GetLocalProcessId();
    this->Count = controller->GetNumberOfProcesses();
  }
}

Ranks::~Ranks() = default;

bool Ranks::CanTalk() const
{
  return this->Count == 1;
}

void Ranks::Post(int, std::vector<std::uint8_t>) {}

void Ranks::KeepSending() {}

std::optional<Ranks::Message> Ranks::Poll()
{
  return std::nullopt;
}

void Ranks::Flush() {}

#endif

Ranks::Message Ranks::Wait()
{
  std::optional<Message> message = this->Poll();
  while (!message)
  {
    std::this_thread::sleep_for(Nap);
    message = this->Poll();
  }
  return *std::move(message);
}
}
