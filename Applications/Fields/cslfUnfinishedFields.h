// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Light fields that are still being written: their previews, see vtkCSLFEncoder.
 */
#ifndef cslfUnfinishedFields_h
#define cslfUnfinishedFields_h

#include <vtkType.h>

#include <chrono>
#include <filesystem>
#include <string>

class vtkCSLFDecoder;

namespace cslf::tool
{
/// The file or folder to read for a name given by the user: for OUT that does not exist, its
/// preview in OUT.partial; for that folder or its preview, OUT as soon as they are gone.
std::string LocateField(const std::string& name);

/// Whether the name is that of an OUT, or its OUT.partial, whose writing has begun but is not
/// finished.
bool IsBeingWritten(const std::string& name);

/// Lets a decoder read an unfinished field anew whenever there is more of it.
class UnfinishedField
{
public:
  /// `name` is the name given by the user, which the decoder reads. Null if it reads no video.
  UnfinishedField(const std::string& name, vtkCSLFDecoder* decoder);

  /// Whether the decoder has changed. Does nothing if the last call was a moment ago.
  bool Update();

private:
  std::string Name;
  vtkCSLFDecoder* Decoder;
  bool IsFinished;
  vtkIdType Unwritten = 0; ///< viewpoints
  std::filesystem::file_time_type Written;
  std::chrono::steady_clock::time_point Next;
};
}

#endif
