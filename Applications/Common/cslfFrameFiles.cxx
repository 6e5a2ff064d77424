// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFrameFiles.h"

#include "cslfFieldFiles.h"
#include "cslfMessages.h"
#include "cslfMovie.h"
#include "cslfPictures.h"

#include <vtkImageData.h>

#include <cstdio>
#include <filesystem>
#include <regex>

namespace fs = std::filesystem;

namespace cslf
{
namespace tool
{
namespace
{
std::string NameFrame(int frame)
{
  char name[32];
  std::snprintf(name, sizeof(name), "frame-%04d.png", frame);
  return name;
}

/// Whether a folder may be replaced: it is not there, or holds nothing but frames, the last of
/// which a run that was killed may not have finished.
bool IsReplaceable(const fs::path& folder)
{
  static const std::regex frame("frame-[0-9]{4,}\\.png(\\.partial)?");
  std::error_code failure;
  if (!fs::exists(folder, failure))
  {
    return true;
  }
  bool isReplaceable = fs::is_directory(folder, failure);
  for (const auto& entry : fs::directory_iterator(folder, failure))
  {
    isReplaceable = isReplaceable && std::regex_match(entry.path().filename().string(), frame);
  }
  return isReplaceable && !failure;
}

/// A folder, filled beside its place.
class FolderWriter : public FrameWriter
{
public:
  explicit FolderWriter(const fs::path& folder)
    : Folder(folder)
    , Temporary(folder.string() + ".partial")
  {
    if (!IsReplaceable(this->Folder))
    {
      throw Failure("The folder " + folder.string() + " holds other things than frames.");
    }
    std::error_code failure;
    if (!IsReplaceable(this->Temporary))
    {
      throw Failure(this->Temporary.string() + " holds other things than frames.");
    }
    fs::remove_all(this->Temporary, failure);
    if (!fs::create_directory(this->Temporary, failure))
    {
      throw Failure("Cannot make the folder " + folder.string() + ".");
    }
  }

  ~FolderWriter() override
  {
    std::error_code ignored;
    fs::remove_all(this->Temporary, ignored);
  }

  void Add(vtkImageData* picture) override
  {
    WritePicture((this->Temporary / NameFrame(this->Frames)).string(), picture);
    ++this->Frames;
  }

  void Finish() override
  {
    std::error_code failure;
    fs::remove_all(this->Folder, failure);
    fs::rename(this->Temporary, this->Folder, failure);
    if (failure)
    {
      throw Failure("Cannot write " + this->Folder.string() + ".");
    }
  }

private:
  fs::path Folder;
  fs::path Temporary;
  int Frames = 0;
};

/// The name of a folder without what a shell's completion adds.
fs::path TrimFolder(const std::string& name)
{
  const fs::path path(name);
  return path.has_filename() ? path : path.parent_path();
}
}

std::unique_ptr<FrameWriter> MakeFrameWriter(
  const std::string& output, int width, int height, double frameRate)
{
  if (IsVideo(output))
  {
    RequireWritable(output);
    return MakeMovieWriter(output, width, height, frameRate);
  }
  const fs::path folder = TrimFolder(output);
  std::error_code failure;
  if (folder.has_extension() && !fs::is_directory(folder, failure))
  {
    throw Failure("Cannot write " + output + ": pictures along a path go to " + FrameFormats + ".");
  }
  return std::make_unique<FolderWriter>(folder);
}
}
}
