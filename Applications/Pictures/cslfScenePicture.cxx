// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfScenePicture.h"

#include "Console/cslfMessages.h"
#include "Console/cslfOutputFiles.h"
#include "Files/cslfFileSystem.h"
#include "Scenes/cslfSceneFiles.h"
#include "cslfColor.h"
#include "vtkCSLFViewTracer.h"

#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace cslf::tool
{
namespace
{
constexpr int Width = 960;
constexpr int Height = 720;
constexpr int Samples = 64;
constexpr double NoiseTarget = 0.01;

// As in the viewer.
constexpr double Background[3] = { 0.1, 0.1, 0.12 };

// PNG's keyword for what made a file.
constexpr const char* SoftwareKey = "Software";
constexpr const char* Software = "cslf sample";

/// Puts colours of associated alpha over the background.
vtkSmartPointer<vtkImageData> PutOverBackground(vtkImageData* picture)
{
  auto* colors = vtkUnsignedCharArray::SafeDownCast(picture->GetPointData()->GetScalars());
  vtkNew<vtkUnsignedCharArray> opaque;
  opaque->SetName(colors->GetName());
  opaque->SetNumberOfComponents(3);
  opaque->SetNumberOfTuples(colors->GetNumberOfTuples());
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    const double missing = 255.0 - colors->GetTypedComponent(i, 3);
    for (int c = 0; c < 3; ++c)
    {
      const double level = colors->GetTypedComponent(i, c) + missing * Background[c];
      opaque->SetTypedComponent(i, c, ToByte(level / 255.0));
    }
  }
  auto result = vtkSmartPointer<vtkImageData>::New();
  result->SetDimensions(picture->GetDimensions());
  result->GetPointData()->SetScalars(opaque);
  return result;
}

bool IsOwnPicture(const std::string& fileName)
{
  const SeparateMessages messages;
  vtkNew<vtkPNGReader> reader;
  if (!reader->CanReadFile(fileName.c_str()))
  {
    return false;
  }
  reader->SetFileName(fileName.c_str());
  reader->UpdateInformation();
  int chunks[2] = { 0, 0 };
  reader->GetTextChunks(SoftwareKey, chunks);
  bool isOwn = false;
  for (int i = chunks[0]; i < chunks[1]; ++i)
  {
    const char* value = reader->GetTextValue(i);
    isOwn = isOwn || (value && std::strcmp(value, Software) == 0);
  }
  return isOwn;
}
}

void WriteScenePicture(const std::string& fileName, const SceneOptions& options, const Scene& scene)
{
  vtkNew<vtkCSLFViewTracer> tracer;
  options.Apply(scene, tracer);
  // Without a cache, whose points for all surfaces take longer than one picture's paths.
  tracer->SetIntegratorToPathTracing();
  tracer->SetSamples(Samples);
  tracer->SetNoiseTarget(NoiseTarget);
  tracer->SetSize(Width, Height);
  tracer->SetCamera(options.GetLook().MakeCamera(scene, double(Width) / Height));
  {
    const ProgressBar bar(tracer, "Tracing the picture");
    tracer->Update();
  }
  ThrowOnError();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(PutOverBackground(tracer->GetOutput()));
  writer->AddText(SoftwareKey, Software);
  writer->WriteToMemoryOn();
  writer->Write();
  ThrowOnError();
  const vtkSmartPointer<vtkUnsignedCharArray> bytes = writer->GetResult();
  WriteWholeBytes(bytes->GetPointer(0), bytes->GetNumberOfValues(), fileName);
}

void RequireReplaceable(const std::string& fileName)
{
  std::error_code failure;
  const std::filesystem::path path = ToPath(fileName);
  const auto status = std::filesystem::symlink_status(path, failure);
  if (std::filesystem::exists(status) &&
    !(std::filesystem::is_regular_file(status) && IsOwnPicture(fileName)))
  {
    throw Failure(fileName +
      " exists: choose another name with --output or --picture, or replace it with --overwrite.");
  }
}
}
