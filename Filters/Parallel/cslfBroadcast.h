// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Collective calls that all ranks of a controller make together. MPI counts in ints, so large
 * messages are sent in parts.
 */
#ifndef cslfBroadcast_h
#define cslfBroadcast_h

#include <cstddef>
#include <string>

class vtkMultiProcessController;

namespace cslf
{
/// The largest part of a message, in bytes.
constexpr std::size_t LargestMessage = std::size_t(1) << 28;

/// Sends bytes from one rank to all others, at most `partSize` at a time.
void BroadcastBytes(vtkMultiProcessController* controller, void* bytes, std::size_t count,
  int sender, std::size_t partSize = LargestMessage);

/// Sends a text from one rank to all others.
void BroadcastText(vtkMultiProcessController* controller, std::string& text, int sender);

/// The lowest rank with a fault, or -1 if no rank has one. On all other ranks, `fault` becomes a
/// message with that rank's number and fault.
int ShareFault(vtkMultiProcessController* controller, std::string& fault);
}

#endif
