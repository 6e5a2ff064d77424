// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFSeriesReader.h"

#include "Files/cslfFileSeries.h"
#include "Files/cslfFileSystem.h"
#include "Pipeline/cslfGuard.h"
#include "Pipeline/cslfRequests.h"

#include <vtkDataObject.h>
#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkStreamingDemandDrivenPipeline.h>

vtkStandardNewMacro(vtkCSLFSeriesReader);

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

bool IsIndex(const char* fileName)
{
  return fileName && cslf::ToPath(fileName).extension() == cslf::FileSeriesExtension;
}
}

vtkCSLFSeriesReader::vtkCSLFSeriesReader() = default;
vtkCSLFSeriesReader::~vtkCSLFSeriesReader() = default;

int vtkCSLFSeriesReader::CanReadFile(const char* fileName)
{
  if (!IsIndex(fileName))
  {
    return this->Superclass::CanReadFile(fileName);
  }
  int result = 0;
  std::string ignored;
  cslf::Guard(
    [&]
    {
      const auto series = cslf::FileSeries::Read(fileName, ignored);
      result = series ? this->Superclass::CanReadFile(series->GetPath(0, fileName).c_str()) : 0;
      return true;
    },
    ignored);
  return result;
}

double vtkCSLFSeriesReader::GetTimeStep(int step) const
{
  return step >= 0 && step < this->GetNumberOfTimeSteps() ? this->Times[step] : 0.0;
}

const char* vtkCSLFSeriesReader::GetStepFileName(int step) const
{
  return step >= 0 && step < this->GetNumberOfTimeSteps() ? this->Names[step].c_str() : nullptr;
}

// VTK removes requests that come before the first information, so the time is kept, too.
void vtkCSLFSeriesReader::SetTime(double time)
{
  this->Time = time;
  for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
  {
    this->GetOutputInformation(port)->Set(Pipeline::UPDATE_TIME_STEP(), time);
  }
}

/// Reads the index. False, with an error, if it cannot be read.
bool vtkCSLFSeriesReader::ReadIndex()
{
  this->Times.clear();
  this->Names.clear();
  const char* fileName = this->GetFileName();
  if (!IsIndex(fileName))
  {
    return true;
  }
  std::string problem;
  std::string error;
  const auto read = [&]
  {
    const auto series = cslf::FileSeries::Read(fileName, error);
    for (std::size_t step = 0; series && step < series->Files.size(); ++step)
    {
      this->Times.push_back(series->Files[step].Time);
      this->Names.push_back(series->GetPath(step, fileName));
    }
    return series.has_value();
  };
  if (!cslf::Guard(read, problem))
  {
    this->SetErrorCode(vtkErrorCode::UnrecognizedFileTypeError);
    vtkErrorMacro("Cannot read " << fileName << ": " << (problem.empty() ? error : problem) << ".");
    return false;
  }
  return true;
}

/// The step for the requested time, or -1 for a video.
int vtkCSLFSeriesReader::FindStep(vtkInformation* request) const
{
  if (this->Times.empty())
  {
    return -1;
  }
  return static_cast<int>(cslf::FindTimeStep(this->Times,
    request->Has(Pipeline::UPDATE_TIME_STEP()) ? request->Get(Pipeline::UPDATE_TIME_STEP())
                                               : this->Time));
}

std::string vtkCSLFSeriesReader::ChooseFile(vtkInformation* request)
{
  this->OpenStep = this->FindStep(request);
  return this->OpenStep < 0 ? this->Superclass::ChooseFile(request) : this->Names[this->OpenStep];
}

int vtkCSLFSeriesReader::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!this->ReadIndex())
  {
    this->OpenStep = -1;
    return 0;
  }
  for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
  {
    vtkInformation* output = outputVector->GetInformationObject(port);
    output->Remove(Pipeline::TIME_STEPS());
    output->Remove(Pipeline::TIME_RANGE());
    output->Remove(Pipeline::TIME_DEPENDENT_INFORMATION());
    if (!this->Times.empty())
    {
      const double range[2] = { this->Times.front(), this->Times.back() };
      output->Set(Pipeline::TIME_STEPS(), this->Times.data(), this->GetNumberOfTimeSteps());
      output->Set(Pipeline::TIME_RANGE(), range, 2);
      output->Set(Pipeline::TIME_DEPENDENT_INFORMATION(), 1);
    }
  }
  return this->Superclass::RequestInformation(request, inputVector, outputVector);
}

vtkTypeBool vtkCSLFSeriesReader::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (request->Has(Pipeline::REQUEST_UPDATE_TIME()))
  {
    cslf::ShareTime(request, outputVector);
  }
  if (request->Has(Pipeline::REQUEST_TIME_DEPENDENT_INFORMATION()))
  {
    if (this->FindStep(outputVector->GetInformationObject(0)) == this->OpenStep)
    {
      return 1;
    }
    // What is there is of another time.
    for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
    {
      vtkDataObject::GetData(outputVector, port)->Initialize();
    }
    return cslf::GuardRequest(this, request, outputVector,
      [&] { return this->Superclass::RequestInformation(request, inputVector, outputVector); });
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

int vtkCSLFSeriesReader::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const int result = this->Superclass::RequestData(request, inputVector, outputVector);
  for (int port = 0; this->OpenStep >= 0 && port < this->GetNumberOfOutputPorts(); ++port)
  {
    if (cslf::IsPortWanted(outputVector, port))
    {
      vtkDataObject::GetData(outputVector, port)
        ->GetInformation()
        ->Set(vtkDataObject::DATA_TIME_STEP(), this->Times[this->OpenStep]);
    }
  }
  return result;
}

void vtkCSLFSeriesReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfTimeSteps: " << this->GetNumberOfTimeSteps() << "\n";
  os << indent << "OpenStep: " << this->OpenStep << "\n";
}
