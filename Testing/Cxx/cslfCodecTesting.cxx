// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfCodecTesting.h"

#include "vtkCSLFDecoder.h"
#include "vtkCSLFEncoder.h"

#include <vtkAlgorithm.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTestUtilities.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace cslf
{
namespace testing
{
namespace fs = std::filesystem;

std::string MakeFolder(int argc, char* argv[], const std::string& name)
{
  char* root =
    vtkTestUtilities::GetArgOrEnvOrDefault("-T", argc, argv, "VTK_TEMP_DIR", "Testing/Temporary");
  const fs::path folder = fs::path(root) / name;
  delete[] root;
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder.string();
}

vtkSmartPointer<vtkImageData> MakeByteField(int viewpoints, int resolution, bool depth)
{
  const Cube box{ { 0, 0, 0 }, { 2, 2, 2 } };
  return MakeTestField(
    Layout(viewpoints, resolution), box, VTK_UNSIGNED_CHAR, depth ? VTK_UNSIGNED_SHORT : 0);
}

bool Encode(vtkCSLFEncoder* encoder, vtkImageData* field, const std::string& fileName)
{
  encoder->SetInputData(field);
  encoder->SetFileName(fileName.c_str());
  return encoder->Write() == 1 && Exists(fileName) && !Exists(fileName + ".partial");
}

vtkSmartPointer<vtkImageData> Decode(const std::string& fileName, int first, int last)
{
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(fileName.c_str());
  decoder->UpdateInformation();
  if (last < 0)
  {
    decoder->Update();
  }
  else
  {
    int extent[6];
    decoder->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
    extent[4] = first;
    extent[5] = last;
    decoder->UpdateExtent(extent);
  }
  std::string error;
  vtkSmartPointer<vtkImageData> output = decoder->GetOutput();
  return Description::ReadFrom(output, error) ? output : nullptr;
}

bool HasEqualSlices(vtkImageData* part, vtkImageData* whole)
{
  if (part->GetPointData()->GetNumberOfArrays() != whole->GetPointData()->GetNumberOfArrays())
  {
    return false;
  }
  const int* extent = whole->GetExtent();
  const vtkIdType slice = whole->GetNumberOfPoints() / (extent[5] - extent[4] + 1);
  const vtkIdType first = slice * (part->GetExtent()[4] - extent[4]);
  for (int k = 0; k < part->GetPointData()->GetNumberOfArrays(); ++k)
  {
    vtkDataArray* a = part->GetPointData()->GetArray(k);
    vtkDataArray* b = whole->GetPointData()->GetArray(a->GetName());
    if (!b || a->GetNumberOfComponents() != b->GetNumberOfComponents() ||
      a->GetDataType() != b->GetDataType() ||
      first + a->GetNumberOfTuples() > b->GetNumberOfTuples())
    {
      return false;
    }
    const auto bytes = static_cast<std::size_t>(a->GetDataTypeSize() * a->GetNumberOfComponents());
    const auto* begin = static_cast<const char*>(a->GetVoidPointer(0));
    const auto* other = static_cast<const char*>(b->GetVoidPointer(0)) + bytes * first;
    if (!std::equal(begin, begin + bytes * a->GetNumberOfTuples(), other))
    {
      return false;
    }
  }
  return true;
}

namespace
{
double ToPSNR(double squares, double count, double peak)
{
  return squares == 0.0 ? 200.0 : 10.0 * std::log10(peak * peak * count / squares);
}
}

FieldPSNR Compare(vtkImageData* image, vtkImageData* reference)
{
  vtkDataArray* color = image->GetPointData()->GetArray(ColorName);
  vtkDataArray* trueColor = reference->GetPointData()->GetArray(ColorName);
  vtkDataArray* depth = image->GetPointData()->GetArray(DepthName);
  vtkDataArray* trueDepth = reference->GetPointData()->GetArray(DepthName);
  double squares[3] = { 0.0, 0.0, 0.0 };
  double covered = 0.0;
  for (vtkIdType k = 0; k < trueColor->GetNumberOfTuples(); ++k)
  {
    for (int component = 0; component < 4; ++component)
    {
      squares[component / 3] +=
        std::pow(color->GetComponent(k, component) - trueColor->GetComponent(k, component), 2);
    }
    if (depth && trueColor->GetComponent(k, 3) > 0)
    {
      squares[2] += std::pow(depth->GetComponent(k, 0) - trueDepth->GetComponent(k, 0), 2);
      covered += 1.0;
    }
  }
  const double texels = static_cast<double>(trueColor->GetNumberOfTuples());
  return { ToPSNR(squares[0], 3.0 * texels, 255.0), ToPSNR(squares[1], texels, 255.0),
    ToPSNR(squares[2], covered, 65535.0) };
}

class Observed::Command : public vtkCommand
{
public:
  static Command* New() { return new Command; }
  void Execute(vtkObject*, unsigned long event, void* data) override
  {
    (event == vtkCommand::ErrorEvent ? this->Errors : this->Warnings)
      .emplace_back(static_cast<const char*>(data));
  }

  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
};

Observed::Observed(vtkAlgorithm* algorithm)
  : Algorithm(algorithm)
  , OfAlgorithm(Command::New())
  , OfExecutive(Command::New())
{
  for (const unsigned long event : { vtkCommand::ErrorEvent, vtkCommand::WarningEvent })
  {
    algorithm->AddObserver(event, this->OfAlgorithm);
    algorithm->GetExecutive()->AddObserver(event, this->OfExecutive);
  }
}

Observed::~Observed()
{
  this->Algorithm->RemoveObserver(this->OfAlgorithm);
  this->Algorithm->GetExecutive()->RemoveObserver(this->OfExecutive);
  this->OfAlgorithm->Delete();
  this->OfExecutive->Delete();
}

int Observed::GetErrors() const
{
  return static_cast<int>(this->OfAlgorithm->Errors.size());
}

int Observed::GetWarnings() const
{
  return static_cast<int>(this->OfAlgorithm->Warnings.size());
}

int Observed::CountWarnings(const std::string& text) const
{
  const auto& warnings = this->OfAlgorithm->Warnings;
  return static_cast<int>(std::count_if(warnings.begin(), warnings.end(),
    [&text](const std::string& warning) { return warning.find(text) != std::string::npos; }));
}

bool Observed::HasError(const std::string& text) const
{
  return this->GetErrors() == 1 &&
    this->OfAlgorithm->Errors.front().find(text) != std::string::npos;
}

bool Observed::HasWarning(const std::string& text) const
{
  return this->GetWarnings() == 1 &&
    this->OfAlgorithm->Warnings.front().find(text) != std::string::npos;
}

std::vector<char> ReadBytes(const std::string& fileName)
{
  std::ifstream file(fileName, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
}

void WriteBytes(const std::string& fileName, const std::vector<char>& bytes)
{
  std::ofstream file(fileName, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

bool Exists(const std::string& fileName)
{
  return fs::exists(fileName);
}
}
}
