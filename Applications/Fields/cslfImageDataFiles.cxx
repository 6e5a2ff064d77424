// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfImageDataFiles.h"

#include "Console/cslfMessages.h"
#include "Files/cslfFileSystem.h"
#include "cslfOutputFiles.h"

#include "vtkCSLFSampler.h"

#include <vtkAlgorithmOutput.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkXMLImageDataWriter.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>

namespace cslf::tool
{
namespace
{
/// The memory of a slab, in KiB.
constexpr double SlabKiB = 16.0 * 1024.0;

/// Asks for a piece as some viewpoints, which the sampler makes one after the other. VTK's own
/// pieces also divide the viewpoints' images.
class SlabWriter : public vtkXMLImageDataWriter
{
public:
  static SlabWriter* New();
  vtkTypeMacro(SlabWriter, vtkXMLImageDataWriter);
  SlabWriter(const SlabWriter&) = delete;
  void operator=(const SlabWriter&) = delete;

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override
  {
    const vtkTypeBool result = this->Superclass::ProcessRequest(request, inputVector, outputVector);
    if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()))
    {
      vtkInformation* info = inputVector[0]->GetInformationObject(0);
      int extent[6];
      vtkStreamingDemandDrivenPipeline::GetWholeExtent(info, extent);
      const std::int64_t slices = extent[5] - extent[4] + 1;
      const int first = extent[4];
      extent[4] = first + static_cast<int>(slices * this->CurrentPiece / this->NumberOfPieces);
      extent[5] =
        first + static_cast<int>(slices * (this->CurrentPiece + 1) / this->NumberOfPieces) - 1;
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 1);
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent, 6);
    }
    return result;
  }

protected:
  SlabWriter()
  {
    this->EncodeAppendedDataOff();
    // VTK's default, zlib, takes ten times as long to write and read files that are a quarter
    // smaller.
    this->SetCompressorTypeToLZ4();
  }
  ~SlabWriter() override = default;
};

vtkStandardNewMacro(SlabWriter);

/// The middle viewpoint of a face, and the number of all.
vtkSmartPointer<vtkImageData> ReadViewpoint(vtkAlgorithmOutput* connection, int& count)
{
  vtkAlgorithm* producer = connection->GetProducer();
  producer->UpdateInformation();
  ThrowOnError();
  int extent[6];
  vtkStreamingDemandDrivenPipeline::GetWholeExtent(
    producer->GetOutputInformation(connection->GetIndex()), extent);
  count = extent[5] - extent[4] + 1;
  const auto side = static_cast<int>(std::lround(std::sqrt(count / 6.0)));
  extent[4] += side / 2 * side + side / 2;
  extent[5] = extent[4];
  producer->UpdateExtent(extent);
  ThrowOnError();
  const auto viewpoint = vtkSmartPointer<vtkImageData>::New();
  viewpoint->ShallowCopy(producer->GetOutputDataObject(connection->GetIndex()));
  return viewpoint;
}

/// The estimated size of a field's .vti file, judged by that of one of its viewpoints.
double GuessBytes(vtkImageData* viewpoint, int count, OutputFile& file)
{
  vtkNew<SlabWriter> writer;
  writer->SetInputData(viewpoint);
  WriteTemporary(writer.Get(), file);
  std::ifstream stream(ToPath(file.GetTemporaryName()), std::ios::binary);
  const std::string text{ std::istreambuf_iterator<char>(stream), {} };
  const std::size_t header = std::min(text.size(), text.find("<AppendedData"));
  return static_cast<double>(header) + static_cast<double>(text.size() - header) * count;
}

/// Throws a Failure if the disk does not have enough space for a field's .vti file, before the
/// whole field is made. Viewpoints may differ, so half of the size estimated from one is enough.
void RequireRoom(vtkImageData* viewpoint, int count, OutputFile& file)
{
  const double bytes = GuessBytes(viewpoint, count, file);
  std::string error;
  if (!HasRoom(file.GetName(), bytes, 0.5 * bytes, error))
  {
    FailWriting(file.GetName(), error);
  }
}
}

void WriteImageData(
  vtkAlgorithmOutput* connection, const std::string& fileName, const std::string& label)
{
  OutputFile file(fileName);
  vtkAlgorithm* producer = connection->GetProducer();
  vtkNew<SlabWriter> writer;
  writer->SetInputConnection(connection);
  {
    const ProgressBar bar(producer, label);
    int count = 0;
    const auto viewpoint = ReadViewpoint(connection, count);
    RequireRoom(viewpoint, count, file);
    if (vtkCSLFSampler::SafeDownCast(producer))
    {
      const double slabs = viewpoint->GetActualMemorySize() * static_cast<double>(count) / SlabKiB;
      writer->SetNumberOfPieces(std::clamp(static_cast<int>(std::ceil(slabs)), 1, count));
    }
    else
    {
      producer->UpdateWholeExtent();
    }
  }
  ThrowOnError();
  const ProgressBar bar(writer, label);
  WriteTemporary(writer.Get(), file);
  file.Publish();
}
}
