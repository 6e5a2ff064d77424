// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfRefiningTruth.h"

#include "Console/cslfMessages.h"
#include "Options/cslfCameraOptions.h"
#include "Pictures/cslfPictures.h"
#include "cslfSeconds.h"

#include "vtkCSLFViewTracer.h"

#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace cslf::tool
{
namespace
{
// The time of a pass: shorter ones get more samples, longer ones fewer.
constexpr double ShortSeconds = 0.05;
constexpr double LongSeconds = 0.2;
constexpr int MaximumPassSamples = 16;

bool AreSame(vtkCamera* a, vtkCamera* b)
{
  const double* first = a->GetViewTransformMatrix()->GetData();
  const double* second = b->GetViewTransformMatrix()->GetData();
  return std::equal(first, first + 16, second) && a->GetViewAngle() == b->GetViewAngle() &&
    a->GetParallelProjection() == b->GetParallelProjection() &&
    a->GetParallelScale() == b->GetParallelScale();
}
}

RefiningTruth::RefiningTruth(const SceneOptions& options, const Scene& scene)
{
  options.Apply(scene, this->Tracer);
  this->Tracer->SetColorType(VTK_FLOAT);
}

RefiningTruth::~RefiningTruth() = default;

bool RefiningTruth::Shows(vtkCamera* camera, const int size[2]) const
{
  return this->Samples > 0 && std::equal(size, size + 2, this->Size) &&
    AreSame(camera, this->Camera);
}

void RefiningTruth::Refine(vtkCamera* camera, const int size[2], int mostSamples)
{
  if (!this->Shows(camera, size))
  {
    this->Camera->DeepCopy(camera);
    std::copy_n(size, 2, this->Size);
    this->Samples = 0;
    this->Passes = 0;
    this->Sums.assign(4 * static_cast<std::size_t>(size[0]) * size[1], 0.0);
    this->Tracer->SetCamera(this->Camera);
    this->Tracer->SetSize(size[0], size[1]);
  }
  const auto start = std::chrono::steady_clock::now();
  const int samples = std::clamp(mostSamples - this->Samples, 1, this->PassSamples);
  this->Tracer->SetSamples(samples);
  this->Tracer->SetSeed(this->Passes);
  this->Tracer->Update();
  ThrowOnError();
  const auto* pixels = static_cast<const float*>(this->Tracer->GetOutput()->GetScalarPointer());
  for (std::size_t i = 0; i < this->Sums.size(); ++i)
  {
    this->Sums[i] += samples * static_cast<double>(pixels[i]);
  }
  this->Samples += samples;
  ++this->Passes;
  const double seconds = SecondsSince(start);
  if (seconds < ShortSeconds)
  {
    this->PassSamples = std::min(2 * this->PassSamples, MaximumPassSamples);
  }
  else if (seconds > LongSeconds)
  {
    this->PassSamples = std::max(this->PassSamples / 2, 1);
  }
}

vtkSmartPointer<vtkImageData> RefiningTruth::MakePicture(
  vtkCSLFToneMapping* toneMapping, const double background[3]) const
{
  auto picture = vtkSmartPointer<vtkImageData>::New();
  picture->SetDimensions(this->Size[0], this->Size[1], 1);
  picture->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  auto* pixels = static_cast<unsigned char*>(picture->GetScalarPointer());
  const double scale = 1.0 / this->Samples;
  for (std::size_t i = 0; i < this->Sums.size(); i += 4, pixels += 4)
  {
    const glm::dvec3 radiance(this->Sums[i], this->Sums[i + 1], this->Sums[i + 2]);
    const double alpha = scale * this->Sums[i + 3];
    EncodeShown(toneMapping, scale * radiance, alpha, pixels);
    pixels[3] = static_cast<unsigned char>(std::lround(255.0 * std::clamp(alpha, 0.0, 1.0)));
  }
  return DropAlpha(picture, background);
}
}
