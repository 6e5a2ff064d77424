// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTruth.h"

#include "Console/cslfMessages.h"
#include "Console/cslfOutputFiles.h"
#include "Fields/cslfFieldFiles.h"
#include "Files/cslfFileSystem.h"
#include "Options/cslfToneOptions.h"
#include "Scenes/cslfSceneFiles.h"
#include "cslfJSON.h"

#include "vtkCSLFImageQuality.h"
#include "vtkCSLFViewTracer.h"

#include <vtkCamera.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkImageStencilData.h>
#include <vtkStringArray.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLImageDataWriter.h>
#include <vtksys/MD5.h>

#include <cmath>
#include <filesystem>

namespace cslf::tool
{
namespace
{
/// The weighted sum of two linear float pictures, encoded like the field's colours.
vtkSmartPointer<vtkImageData> EncodeSum(vtkImageData* first, double firstWeight,
  vtkImageData* second, double secondWeight, vtkCSLFToneMapping* toneMapping)
{
  auto picture = vtkSmartPointer<vtkImageData>::New();
  picture->SetDimensions(first->GetDimensions());
  picture->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const auto* a = static_cast<const float*>(first->GetScalarPointer());
  const auto* b = static_cast<const float*>(second->GetScalarPointer());
  auto* pixels = static_cast<unsigned char*>(picture->GetScalarPointer());
  for (vtkIdType pixel = 0; pixel < picture->GetNumberOfPoints(); ++pixel)
  {
    double sum[4];
    for (int k = 0; k < 4; ++k)
    {
      sum[k] = firstWeight * a[4 * pixel + k] + secondWeight * b[4 * pixel + k];
    }
    EncodeShown(toneMapping, { sum[0], sum[1], sum[2] }, sum[3], pixels + 3 * pixel);
  }
  return picture;
}

std::string ComputeMD5(const std::string& text)
{
  vtksysMD5* md5 = vtksysMD5_New();
  vtksysMD5_Initialize(md5);
  vtksysMD5_Append(
    md5, reinterpret_cast<const unsigned char*>(text.data()), static_cast<int>(text.size()));
  std::string hex(32, ' ');
  vtksysMD5_FinalizeHex(md5, hex.data());
  vtksysMD5_Delete(md5);
  return hex;
}

/// A view's picture from an earlier run.
vtkSmartPointer<vtkImageData> ReadHalf(const std::string& fileName, int size)
{
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(fileName.c_str());
  reader->Update();
  ThrowOnError();
  vtkImageData* image = reader->GetOutput();
  const int* dimensions = image->GetDimensions();
  if (dimensions[0] != size || dimensions[1] != size || image->GetScalarType() != VTK_FLOAT ||
    image->GetNumberOfScalarComponents() != 4)
  {
    throw Failure("There is no path-traced view of " + std::to_string(size) + " x " +
      std::to_string(size) + " in " + fileName + ".");
  }
  return image;
}
}

double ComputeNoiseFloor(const Truth& truth, vtkImageStencilData* stencil)
{
  vtkNew<vtkCSLFImageQuality> quality;
  quality->SetInputData(0, truth.Halves[0]);
  quality->SetInputData(1, truth.Halves[1]);
  quality->SetStencilData(stencil);
  quality->SetMaximumPSNR(100.0);
  quality->Update();
  ThrowOnError();
  return quality->GetPSNR() + 10.0 * std::log10(4.0);
}

TruthTracer::TruthTracer(const SceneOptions& options, const Scene& scene, const std::string& folder)
  : Folder(folder)
{
  options.Apply(scene, this->Tracer);
  this->Tracer->SetColorType(VTK_FLOAT);
  if (folder.empty())
  {
    return;
  }
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  RequireWritable(folder + "/truth.vti");
  vtkNew<vtkCamera> camera;
  const auto pixel = this->TraceHalf(camera, 1, 1, 0);
  auto* sampling = vtkStringArray::SafeDownCast(
    pixel->GetFieldData()->GetAbstractArray(vtkCSLFViewTracer::SAMPLING_NAME()));
  this->Description = sampling->GetValue(0);
}

TruthTracer::~TruthTracer() = default;

Truth TruthTracer::Trace(
  vtkCamera* camera, int size, int samples, int seed, vtkCSLFToneMapping* toneMapping)
{
  const int firstSamples = samples / 2;
  const int secondSamples = samples - firstSamples;
  const auto first = this->GetHalf(camera, size, firstSamples, 2 * seed);
  const auto second = this->GetHalf(camera, size, secondSamples, 2 * seed + 1);
  Truth truth;
  const double weight = static_cast<double>(firstSamples) / samples;
  truth.Picture = EncodeSum(first, weight, second, 1.0 - weight, toneMapping);
  truth.Halves[0] = EncodeSum(first, 1.0, second, 0.0, toneMapping);
  truth.Halves[1] = EncodeSum(first, 0.0, second, 1.0, toneMapping);
  return truth;
}

vtkSmartPointer<vtkImageData> TruthTracer::GetHalf(
  vtkCamera* camera, int size, int samples, int seed)
{
  if (this->Folder.empty())
  {
    return this->TraceHalf(camera, size, samples, seed);
  }
  const std::string fileName = this->GetFileName(camera, size, samples, seed);
  std::error_code failure;
  if (std::filesystem::exists(ToPath(fileName), failure))
  {
    return ReadHalf(fileName, size);
  }
  auto half = this->TraceHalf(camera, size, samples, seed);
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(half);
  // Raw appended data is not always readable with newer versions of expat.
  writer->SetDataModeToBinary();
  WriteWhole(writer.Get(), fileName);
  return half;
}

// Linear float colours.
vtkSmartPointer<vtkImageData> TruthTracer::TraceHalf(
  vtkCamera* camera, int size, int samples, int seed)
{
  this->Tracer->SetCamera(camera);
  this->Tracer->SetSize(size, size);
  this->Tracer->SetSamples(samples);
  this->Tracer->SetSeed(seed);
  {
    const ProgressBar bar(this->Tracer, "Tracing the reference");
    this->Tracer->Update();
  }
  ThrowOnError();
  auto half = vtkSmartPointer<vtkImageData>::New();
  half->ShallowCopy(this->Tracer->GetOutput());
  return half;
}

std::string TruthTracer::GetFileName(vtkCamera* camera, int size, int samples, int seed) const
{
  const double* position = camera->GetPosition();
  const double* focalPoint = camera->GetFocalPoint();
  const double* up = camera->GetViewUp();
  nlohmann::json key = nlohmann::json::parse(this->Description);
  key["cslf"] = CSLF_VERSION;
  key["samples"] = samples;
  key["seed"] = seed;
  key["size"] = size;
  key["camera"] = { { position[0], position[1], position[2] },
    { focalPoint[0], focalPoint[1], focalPoint[2] }, { up[0], up[1], up[2] },
    camera->GetViewAngle() };
  return this->Folder + "/" + ComputeMD5(key.dump()) + ".vti";
}
}
