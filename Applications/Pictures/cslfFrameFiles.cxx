// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFrameFiles.h"

#include "Console/cslfMessages.h"
#include "Fields/cslfFieldFiles.h"
#include "Files/cslfFileSystem.h"
#include "cslfMovie.h"
#include "cslfPictures.h"

#include <vtkImageData.h>
#include <vtkUnsignedCharArray.h>

#include <OpenImageIO/imageio.h>

#include <array>
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

/// A GIF, whose colours are dithered.
class GIFWriter : public FrameWriter
{
public:
  GIFWriter(const std::string& fileName, int width, int height, double frameRate)
    : File(fileName, std::array<int, 2>{ width, height }.data(), frameRate)
  {
  }

  void Add(vtkImageData* picture) override { this->File.Add(picture); }
  void Finish() override { this->File.Publish(); }

private:
  ImageFile File;
};

/// Whether a file can be decoded as an image. OpenImageIO does not notice all disk errors.
bool IsWholeImage(const std::string& fileName)
{
  const auto input = OIIO::ImageInput::open(fileName);
  std::vector<unsigned char> pixels;
  bool isWhole = input != nullptr;
  for (int picture = 0; isWhole && input->seek_subimage(picture, 0); ++picture)
  {
    const OIIO::ImageSpec spec = input->spec();
    pixels.resize(spec.image_pixels() * spec.nchannels);
    isWhole = input->read_image(picture, 0, 0, -1, OIIO::TypeDesc::UINT8, pixels.data());
  }
  OIIO::geterror();
  return isWhole;
}
}

bool IsMovieName(const std::string& fileName)
{
  return FindMovieFormat(fileName) || LowerExtension(fileName) == ".gif";
}

std::unique_ptr<FrameWriter> MakeFrameWriter(
  const std::string& output, int width, int height, double frameRate)
{
  if (IsMovieName(output))
  {
    RequireWritable(output);
    if (FindMovieFormat(output))
    {
      return MakeMovieWriter(output, width, height, frameRate);
    }
    return std::make_unique<GIFWriter>(output, width, height, frameRate);
  }
  const fs::path folder = ToPath(ResolveTarget(output));
  std::error_code failure;
  if (folder.has_extension() && !fs::is_directory(folder, failure))
  {
    throw Failure(
      "Cannot write " + output + ": several pictures are written to " + FrameFormats + ".");
  }
  return std::make_unique<FolderWriter>(output);
}

struct ImageFile::Output
{
  std::unique_ptr<OIIO::ImageOutput> Writer;
  OIIO::ImageSpec Spec;
  int Pictures = 0;
};

ImageFile::ImageFile(const std::string& fileName, const int size[2], double frameRate)
  : File(fileName)
  , Image(std::make_unique<Output>())
{
  const std::string extension = LowerExtension(fileName);
  this->Image->Writer = OIIO::ImageOutput::create(extension.substr(1));
  if (!this->Image->Writer)
  {
    OIIO::geterror(); // otherwise it would be printed at the end
    throw Failure("This OpenImageIO cannot write " + extension + ", which " + fileName + " needs.");
  }
  this->Image->Spec = OIIO::ImageSpec(size[0], size[1], 3, OIIO::TypeDesc::UINT8);
  // Almost invisible loss. Each format ignores what is not for it.
  this->Image->Spec.attribute("compression", extension == ".webp" ? "webp:95" : "jpeg:95");
  this->Image->Spec.attribute("jpeg:subsampling", "4:4:4");
  this->Image->Spec.attribute("oiio:ColorSpace", "sRGB");
  if (frameRate > 0.0)
  {
    this->Image->Spec.attribute("FramesPerSecond", static_cast<float>(frameRate));
  }
}

ImageFile::~ImageFile() = default;

void ImageFile::Add(vtkImageData* picture)
{
  OIIO::ImageOutput& writer = *this->Image->Writer;
  const OIIO::ImageSpec& spec = this->Image->Spec;
  const auto mode =
    this->Image->Pictures == 0 ? OIIO::ImageOutput::Create : OIIO::ImageOutput::AppendSubimage;
  // VTK's pictures begin with the bottom row.
  const OIIO::stride_t row = 3 * static_cast<OIIO::stride_t>(spec.width);
  const auto* last =
    static_cast<const unsigned char*>(picture->GetScalarPointer()) + row * (spec.height - 1);
  if (!writer.open(this->File.GetTemporaryName(), spec, mode) ||
    !writer.write_image(OIIO::TypeDesc::UINT8, last, 3, -row))
  {
    FailWriting(this->File.GetName(), writer.geterror());
  }
  ++this->Image->Pictures;
}

void ImageFile::Publish()
{
  const bool isClosed = this->Image->Writer->close();
  if (!isClosed || !IsWholeImage(this->File.GetTemporaryName()))
  {
    FailWriting(this->File.GetName(), isClosed ? "" : this->Image->Writer->geterror());
  }
  this->File.Publish();
}
}
