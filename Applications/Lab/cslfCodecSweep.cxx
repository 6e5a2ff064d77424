// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfCodecSweep.h"

#include "Console/cslfMessages.h"
#include "Files/cslfFileSystem.h"
#include "Measurements/cslfStatistics.h"
#include "cslfSeconds.h"

#include "vtkCSLFDecoder.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFFieldQuality.h"

#include <vtkAlgorithm.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkImageStencilData.h>
#include <vtkNew.h>
#include <vtkTrivialProducer.h>

#include <chrono>
#include <cmath>
#include <filesystem>

namespace cslf::tool
{
namespace
{
using Clock = std::chrono::steady_clock;

/// Image data as the input of a pipeline.
vtkSmartPointer<vtkTrivialProducer> Produce(vtkImageData* image)
{
  auto producer = vtkSmartPointer<vtkTrivialProducer>::New();
  producer->SetOutput(image);
  return producer;
}
}

CodecSweep::CodecSweep(
  vtkImageData* field, const Layout& grid, const std::string& folder, int repeats)
  : Field(field)
  , Grid(grid)
  , FileName(folder + "/coded.mp4")
  , Repeats(repeats)
{
  if (std::filesystem::exists(ToPath(this->FileName)))
  {
    throw Failure(this->FileName + " already exists.");
  }
}

CodecSweep::~CodecSweep()
{
  if (this->HasWritten)
  {
    std::error_code ignored;
    std::filesystem::remove(ToPath(this->FileName), ignored);
  }
}

void CodecSweep::SetViews(std::vector<NovelView> views, std::vector<LookupName> lookups)
{
  this->Views = std::move(views);
  this->Lookups = std::move(lookups);
}

double CodecSweep::Encode(const CodingOptions& coding, const std::string& label)
{
  vtkNew<vtkCSLFEncoder> encoder;
  coding.Apply(encoder);
  encoder->SetRestart(false);
  encoder->SetController(nullptr);
  encoder->SetInputData(this->Field);
  encoder->SetFileName(this->FileName.c_str());
  const ProgressBar bar(
    encoder, label + ", CRF " + std::to_string(std::lround(coding.Rate->GetCRF())));
  const auto start = Clock::now();
  if (!encoder->Write())
  {
    throw Failure("Cannot write " + this->FileName + ".");
  }
  this->HasWritten = true;
  return SecondsSince(start);
}

vtkSmartPointer<vtkImageData> CodecSweep::Decode(CodecPoint& point, double& seconds)
{
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(this->FileName.c_str());
  const auto start = Clock::now();
  decoder->Update();
  seconds = SecondsSince(start);
  point.Tracks.clear();
  for (int track = 0; track < decoder->GetNumberOfTracks(); ++track)
  {
    point.Tracks.emplace_back(
      decoder->GetTrackName(track), static_cast<double>(decoder->GetTrackBytes(track)));
  }
  ThrowOnError();
  return decoder->GetOutput();
}

CodecPoint CodecSweep::Measure(const CodingOptions& coding, const std::string& label)
{
  CodecPoint point;
  point.CRF = coding.Rate->GetCRF();
  std::vector<double> encodeSeconds(this->Repeats);
  std::vector<double> decodeSeconds(this->Repeats);
  vtkSmartPointer<vtkImageData> decoded;
  for (int repeat = 0; repeat < this->Repeats; ++repeat)
  {
    encodeSeconds[repeat] = this->Encode(coding, label);
    decoded = nullptr;
    decoded = this->Decode(point, decodeSeconds[repeat]);
  }
  const double texels =
    1.0 * this->Grid.GetStripWidth() * this->Grid.GetResolution() * this->Grid.GetSlices();
  point.Bytes = static_cast<double>(CountBytes(this->FileName));
  point.Ratio = 3.0 * texels / point.Bytes;
  point.EncodeRate = 1e-6 * texels / Median(encodeSeconds);
  point.DecodeRate = 1e-6 * texels / Median(decodeSeconds);
  this->CompareField(decoded, point);
  this->CompareViews(decoded, point);
  return point;
}

void CodecSweep::CompareField(vtkImageData* decoded, CodecPoint& point)
{
  vtkNew<vtkCSLFFieldQuality> quality;
  const auto first = Produce(this->Field);
  const auto second = Produce(decoded);
  quality->SetInputConnection(0, first->GetOutputPort());
  quality->SetInputConnection(1, second->GetOutputPort());
  quality->Measure();
  ThrowOnError();
  for (int index = 0; index < quality->GetNumberOfFigures(); ++index)
  {
    point.Channels[quality->GetFigureName(index)] = quality->GetPSNR(index);
  }
  point.FieldPSNR = point.Channels[ColorName];
}

void CodecSweep::CompareViews(vtkImageData* decoded, CodecPoint& point)
{
  if (this->Views.empty())
  {
    return;
  }
  const auto producer = Produce(decoded);
  const int* size = this->Views.front().Picture->GetDimensions();
  FieldRenderer renderer(producer->GetOutputPort(), size[0], size[1]);
  for (const LookupName& lookup : this->Lookups)
  {
    point.ViewPSNR.push_back(Mean(MeasureViews(renderer, lookup.Lookup, this->Views).PSNR));
  }
}
}
