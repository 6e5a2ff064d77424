// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel/cslfBroadcast.h"

#include <vtkCommunicator.h>
#include <vtkMultiProcessController.h>

#include <algorithm>

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

int ShareFault(vtkMultiProcessController* controller, std::string& fault)
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
}
