// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// All calls of OpenImageIO. Errors must be taken from it, or it prints them at the end.
#include "cslfImageFiles.h"

#include "cslfDecimalPoint.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <utility>

namespace cslf
{
namespace
{
OIIO::TypeDesc ToTypeDesc(PixelType type)
{
  switch (type)
  {
    case PixelType::Bytes:
      return OIIO::TypeDesc::UINT8;
    case PixelType::Words:
      return OIIO::TypeDesc::UINT16;
    case PixelType::Floats:
      return OIIO::TypeDesc::FLOAT;
    default:
      return OIIO::TypeDesc::UNKNOWN;
  }
}

ImageHeader ToHeader(const OIIO::ImageSpec& spec)
{
  ImageHeader header;
  header.Width = std::max(spec.width, 0);
  header.Height = std::max(spec.height, 0);
  header.Channels = std::max(spec.nchannels, 0);
  header.HasFloats = spec.format.is_floating_point();
  for (const PixelType type : { PixelType::Bytes, PixelType::Words, PixelType::Floats })
  {
    header.Type = spec.format == ToTypeDesc(type) ? type : header.Type;
  }
  for (const OIIO::ParamValue& attribute : spec.extra_attribs)
  {
    if (attribute.type() == OIIO::TypeDesc::STRING)
    {
      header.Attributes[attribute.name().string()] = attribute.get_string();
    }
  }
  return header;
}

OIIO::ImageSpec ToSpec(const ImageHeader& header)
{
  OIIO::ImageSpec spec(header.Width, header.Height, header.Channels, ToTypeDesc(header.Type));
  for (const auto& [name, text] : header.Attributes)
  {
    spec.attribute(name, text);
  }
  return spec;
}

class Reader : public ImageReader
{
public:
  bool Open(const ImageSource& source, std::string& error)
  {
    const DecimalPoint point;
    OIIO::ImageSpec config;
    if (source.KeepsColors)
    {
      config.attribute("oiio:UnassociatedAlpha", 1);
    }
    if (source.Bytes)
    {
      this->Memory = std::make_unique<OIIO::Filesystem::IOMemReader>(
        const_cast<unsigned char*>(source.Bytes), source.Size);
      OIIO::Filesystem::IOProxy* proxy = this->Memory.get();
      config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    }
    OIIO::ImageSpec spec;
    if (source.Format.empty())
    {
      this->Input = OIIO::ImageInput::open(source.FileName, &config, this->Memory.get());
    }
    else
    {
      this->Input = OIIO::ImageInput::create(source.Format);
      if (this->Input && !this->Input->open(source.FileName, spec, config))
      {
        error = this->Input->geterror();
        this->Input.reset();
      }
    }
    const std::string reason = OIIO::geterror();
    error = error.empty() ? reason : error;
    if (this->Input && !this->TakeHeader())
    {
      error = "It is a volume.";
      this->Input.reset();
    }
    return this->Input != nullptr;
  }

  bool Read(PixelType type, void* pixels, std::string& error) override
  {
    const DecimalPoint point;
    if (this->Input->read_image(this->Image, 0, 0, -1, ToTypeDesc(type), pixels))
    {
      return true;
    }
    error = this->Input->geterror();
    return false;
  }

  bool GoOn() override
  {
    const DecimalPoint point;
    if (!this->Input->seek_subimage(this->Image + 1, 0))
    {
      this->Input->geterror();
      return false;
    }
    ++this->Image;
    return this->TakeHeader();
  }

private:
  /// False for a volume, whose pixels are more than the header tells.
  bool TakeHeader()
  {
    this->Header = ToHeader(this->Input->spec());
    return this->Input->spec().depth <= 1;
  }

  std::unique_ptr<OIIO::Filesystem::IOMemReader> Memory;
  std::unique_ptr<OIIO::ImageInput> Input; // ends first
  int Image = 0;
};

class Writer : public ImageWriter
{
public:
  Writer(std::unique_ptr<OIIO::ImageOutput> output, std::string fileName, OIIO::ImageSpec spec)
    : Output(std::move(output))
    , FileName(std::move(fileName))
    , Spec(std::move(spec))
  {
  }

  bool Add(const unsigned char* pixels, std::ptrdiff_t row, std::string& error) override
  {
    const DecimalPoint point;
    const auto mode =
      this->HasImages ? OIIO::ImageOutput::AppendSubimage : OIIO::ImageOutput::Create;
    this->HasImages = true;
    if (this->Output->open(this->FileName, this->Spec, mode) &&
      this->Output->write_image(OIIO::TypeDesc::UINT8, pixels, this->Spec.nchannels, row))
    {
      return true;
    }
    error = this->Output->geterror();
    return false;
  }

  bool Finish(std::string& error) override
  {
    const DecimalPoint point;
    if (this->Output->close())
    {
      return true;
    }
    error = this->Output->geterror();
    return false;
  }

private:
  std::unique_ptr<OIIO::ImageOutput> Output;
  std::string FileName;
  OIIO::ImageSpec Spec;
  bool HasImages = false;
};

class Library : public ImageLibrary
{
public:
  std::unique_ptr<ImageReader> Open(const ImageSource& source, std::string& error) const override
  {
    auto reader = std::make_unique<Reader>();
    return reader->Open(source, error) ? std::move(reader) : nullptr;
  }

  bool Encode(const std::string& fileName, const ImageHeader& header, const void* pixels,
    std::vector<unsigned char>& bytes, std::string& error) const override
  {
    const DecimalPoint point;
    const auto output = OIIO::ImageOutput::create(fileName);
    if (!output)
    {
      error = OIIO::geterror();
      return false;
    }
    OIIO::Filesystem::IOVecOutput memory(bytes);
    OIIO::ImageSpec spec = ToSpec(header);
    // OpenImageIO uses associated alpha and would divide by it when it writes a PNG, which loses
    // precision. The pixels are declared to be in PNG's form already, so that they are written
    // unchanged.
    spec.attribute("oiio:UnassociatedAlpha", 1);
    void* place = &memory;
    spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &place);
    const bool isWritten = output->open(fileName, spec) && output->write_image(spec.format, pixels);
    if (!output->close() || !isWritten)
    {
      error = output->geterror();
      return false;
    }
    return true;
  }

  std::unique_ptr<ImageWriter> Create(const std::string& fileName, const std::string& format,
    const ImageHeader& header, double frameRate, std::string& error) const override
  {
    const DecimalPoint point;
    auto output = OIIO::ImageOutput::create(format);
    if (!output)
    {
      error = OIIO::geterror();
      return nullptr;
    }
    OIIO::ImageSpec spec = ToSpec(header);
    if (frameRate > 0.0)
    {
      spec.attribute("FramesPerSecond", static_cast<float>(frameRate));
    }
    return std::make_unique<Writer>(std::move(output), fileName, std::move(spec));
  }
};
}

const ImageLibrary* MakeImageLibrary()
{
  static const Library library;
  return &library;
}
}

#ifndef CSLF_HAS_IMAGES
#ifdef _WIN32
#define CSLF_IMAGES_EXPORT __declspec(dllexport)
#else
#define CSLF_IMAGES_EXPORT __attribute__((visibility("default")))
#endif

extern "C" CSLF_IMAGES_EXPORT const cslf::ImageLibrary* CSLF_IMAGES_SYMBOL();

const cslf::ImageLibrary* CSLF_IMAGES_SYMBOL()
{
  return cslf::MakeImageLibrary();
}
#endif
