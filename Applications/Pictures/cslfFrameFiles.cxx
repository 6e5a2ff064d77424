// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFrameFiles.h"

#include "Console/cslfMessages.h"
#include "Console/cslfSceneText.h"
#include "Fields/cslfFieldFiles.h"
#include "Files/cslfFileSystem.h"
#include "cslfMovie.h"
#include "cslfPictures.h"

#include <vtkImageData.h>
#include <vtkUnsignedCharArray.h>

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
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

  void Add(vtkImageData* picture, int frames) override
  {
    const auto bytes = EncodePNG(picture);
    for (int end = this->Frames + frames; this->Frames < end; ++this->Frames)
    {
      std::string error;
      if (!MakeFile(this->Whole.GetTemporaryName() + "/" + NameFrame(this->Frames),
            bytes->GetPointer(0), bytes->GetNumberOfValues(), error))
      {
        FailWriting(this->Folder, error);
      }
    }
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

  void Add(vtkImageData* picture, int frames) override { this->File.Add(picture, frames); }
  void Finish() override { this->File.Publish(); }

private:
  ImageFile File;
};

/// Multiplies the delays of the pictures of a GIF, as OpenImageIO writes one delay for all. False
/// if the file cannot be changed.
bool ScaleDelays(const std::string& fileName, const std::vector<int>& factors)
{
  constexpr std::size_t header = 13;
  constexpr unsigned char extension = 0x21;
  constexpr unsigned char control = 0xf9;
  constexpr unsigned char image = 0x2c;
  constexpr unsigned int most = 0xffff;
  std::string bytes = ReadBytes(fileName);
  const auto at = [&bytes](std::size_t i)
  { return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u; };
  const auto tableSize = [](unsigned int flags)
  { return (flags & 0x80) != 0 ? std::size_t{ 6 } << (flags & 7) : 0; };
  std::size_t picture = 0;
  std::size_t place = header + tableSize(at(10));
  while (at(place) == extension || at(place) == image)
  {
    if (at(place) == extension && at(place + 1) == control && picture < factors.size() &&
      place + 5 < bytes.size())
    {
      const unsigned int delay =
        std::min((at(place + 4) | at(place + 5) << 8) * factors[picture++], most);
      bytes[place + 4] = static_cast<char>(delay & 0xff);
      bytes[place + 5] = static_cast<char>(delay >> 8);
    }
    // Blocks of data follow, the last of which is empty.
    place += at(place) == extension ? 2 : 11 + tableSize(at(place + 9));
    while (at(place) != 0)
    {
      place += 1 + at(place);
    }
    ++place;
  }
  std::fstream file(ToPath(fileName), std::ios::binary | std::ios::in | std::ios::out);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  return picture == factors.size() && !file.fail();
}

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
  std::vector<int> Frames; ///< for which each picture is shown
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

void ImageFile::Add(vtkImageData* picture, int frames)
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
  this->Image->Frames.push_back(frames);
}

void ImageFile::Publish()
{
  const bool isClosed = this->Image->Writer->close();
  if (!isClosed || !IsWholeImage(this->File.GetTemporaryName()))
  {
    FailWriting(this->File.GetName(), isClosed ? "" : this->Image->Writer->geterror());
  }
  const std::vector<int>& frames = this->Image->Frames;
  const bool isEven =
    std::all_of(frames.begin(), frames.end(), [](int count) { return count == 1; });
  if (!isEven && !ScaleDelays(this->File.GetTemporaryName(), frames))
  {
    FailWriting(this->File.GetName(), "");
  }
  this->File.Publish();
}
}
