// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFrameFiles.h"

#include "Console/cslfMessages.h"
#include "Console/cslfOutputFiles.h"
#include "Fields/cslfFieldFiles.h"
#include "Files/cslfFileSystem.h"
#include "cslfMovie.h"
#include "cslfPictures.h"

#include <vtkImageData.h>
#include <vtkUnsignedCharArray.h>

#include <cstdio>
#include <filesystem>
#include <regex>
#include <system_error>
#include <vector>

namespace fs = std::filesystem;

namespace cslf::tool
{
namespace
{
std::string NameFrame(int frame)
{
  char name[32];
  std::snprintf(name, sizeof(name), "frame-%04d.png", frame);
  return name;
}

/// The frames in a folder.
std::vector<std::string> ListFrames(const std::string& folder)
{
  static const std::regex frame("frame-[0-9]{4,}\\.png");
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(ToPath(folder), ignored))
  {
    const std::string name = ToName(entry.path().filename());
    if (std::regex_match(name, frame))
    {
      names.push_back(name);
    }
  }
  return names;
}

/// A folder, filled under a temporary name.
class FolderWriter : public FrameWriter
{
public:
  explicit FolderWriter(const std::string& folder)
    : Folder(folder)
    , Whole(folder, ListFrames)
  {
    std::string error;
    if (!this->Whole.Open("frames", error))
    {
      FailWriting(folder, error);
    }
  }

  void Add(vtkImageData* picture) override
  {
    const auto bytes = EncodePNG(picture);
    std::string error;
    if (!MakeFile(this->Whole.GetTemporaryName() + "/" + NameFrame(this->Frames),
          bytes->GetPointer(0), bytes->GetNumberOfValues(), error))
    {
      FailWriting(this->Folder, error);
    }
    ++this->Frames;
  }

  void Finish() override { PublishWhole(this->Whole, this->Folder); }

private:
  std::string Folder;
  AtomicFolder Whole;
  int Frames = 0;
};
}

std::unique_ptr<FrameWriter> MakeFrameWriter(
  const std::string& output, int width, int height, double frameRate)
{
  if (IsVideo(output))
  {
    RequireWritable(output);
    return MakeMovieWriter(output, width, height, frameRate);
  }
  const fs::path folder = ToPath(ResolveTarget(output));
  std::error_code failure;
  if (folder.has_extension() && !fs::is_directory(folder, failure))
  {
    throw Failure(
      "Cannot write " + output + ": pictures along a path are written to " + FrameFormats + ".");
  }
  return std::make_unique<FolderWriter>(output);
}
}
