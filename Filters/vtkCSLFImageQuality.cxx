// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFImageQuality.h"

#include "Pipeline/cslfGuard.h"

#include "Pipeline/cslfArrayLayout.h"
#include "Quality/cslfDisplayCurve.h"

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkImageGaussianSmooth.h>
#include <vtkImageStencilData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <string>

namespace
{
constexpr double Peak = 255.0;

// Wang et al. 2004, section III-C.
constexpr int WindowRadius = 5;
constexpr double WindowDeviation = 1.5;
constexpr double C1 = 0.01 * Peak * 0.01 * Peak;
constexpr double C2 = 0.03 * Peak * 0.03 * Peak;

/// The number of colours of a pixel: 1 or 3. The other component is alpha.
int CountColors(int components)
{
  return components < 3 ? 1 : 3;
}

double Luma(const unsigned char* pixel, int colors)
{
  return colors == 1 ? pixel[0] : 0.299 * pixel[0] + 0.587 * pixel[1] + 0.114 * pixel[2];
}

/// Two pictures of the same size.
struct Pair
{
  vtkSmartPointer<vtkUnsignedCharArray> Pixels[2];
  int Components[2] = {};
  int Extent[6] = {};

  /// Says why they cannot be compared. Empty if they can.
  std::string Set(vtkImageData* first, vtkImageData* second)
  {
    vtkImageData* images[2] = { first, second };
    for (int k = 0; k < 2; ++k)
    {
      this->Pixels[k] = cslf::ToAOS<vtkUnsignedCharArray>(images[k]->GetPointData()->GetScalars());
      if (!this->Pixels[k] || this->Pixels[k]->GetNumberOfComponents() > 4)
      {
        return "The pictures must be of unsigned char with 1 to 4 components.";
      }
      this->Components[k] = this->Pixels[k]->GetNumberOfComponents();
    }
    const int* a = first->GetDimensions();
    const int* b = second->GetDimensions();
    if (a[0] != b[0] || a[1] != b[1] || a[2] != 1 || b[2] != 1 || a[0] < 1 || a[1] < 1)
    {
      const auto toText = [](const int* size)
      { return std::to_string(size[0]) + " x " + std::to_string(size[1]); };
      return "The pictures must have the same size, but are " + toText(a) + " and " + toText(b) +
        ".";
    }
    if (this->GetColors(0) != this->GetColors(1))
    {
      return "One picture is gray and the other coloured.";
    }
    first->GetExtent(this->Extent);
    return {};
  }

  int GetColors(int image) const { return CountColors(this->Components[image]); }
  int GetWidth() const { return this->Extent[1] - this->Extent[0] + 1; }
  int GetHeight() const { return this->Extent[3] - this->Extent[2] + 1; }
  const unsigned char* GetPixel(int image, vtkIdType pixel) const
  {
    return this->Pixels[image]->GetPointer(pixel * this->Components[image]);
  }
};

/// Calls `visit(pixel, x, y)`, x and y counting from 0, for the pixels inside the stencil.
template <typename Visit>
void ForEachPixel(const Pair& pair, vtkImageStencilData* stencil, Visit visit)
{
  for (int y = 0; y < pair.GetHeight(); ++y)
  {
    for (int x = 0; x < pair.GetWidth(); ++x)
    {
      if (!stencil || stencil->IsInside(x + pair.Extent[0], y + pair.Extent[2], pair.Extent[4]))
      {
        visit(static_cast<vtkIdType>(y) * pair.GetWidth() + x, x, y);
      }
    }
  }
}

/// The squared differences of a pixel's colours.
double SquaredDifference(const Pair& pair, vtkIdType pixel)
{
  const unsigned char* a = pair.GetPixel(0, pixel);
  const unsigned char* b = pair.GetPixel(1, pixel);
  double sum = 0.0;
  for (int color = 0; color < pair.GetColors(0); ++color)
  {
    sum += (1.0 * a[color] - b[color]) * (1.0 * a[color] - b[color]);
  }
  return sum;
}

/// The local SSIM of every pixel's window.
void ComputeSSIM(const Pair& pair, vtkImageData* output)
{
  // The smoothed lumas, their squares and their product give the moments of each window.
  vtkNew<vtkImageData> moments;
  moments->SetDimensions(pair.GetWidth(), pair.GetHeight(), 1);
  moments->AllocateScalars(VTK_DOUBLE, 5);
  auto* values = static_cast<double*>(moments->GetScalarPointer());
  const vtkIdType pixels = moments->GetNumberOfPoints();
  for (vtkIdType pixel = 0; pixel < pixels; ++pixel, values += 5)
  {
    const double a = Luma(pair.GetPixel(0, pixel), pair.GetColors(0));
    const double b = Luma(pair.GetPixel(1, pixel), pair.GetColors(1));
    const double products[5] = { a, b, a * a, b * b, a * b };
    std::copy_n(products, 5, values);
  }
  vtkNew<vtkImageGaussianSmooth> smooth;
  smooth->SetInputData(moments);
  smooth->SetDimensionality(2);
  smooth->SetStandardDeviation(WindowDeviation);
  // The radius is rounded down from this.
  smooth->SetRadiusFactor((WindowRadius + 0.5) / WindowDeviation);
  smooth->Update();

  output->SetExtent(const_cast<int*>(pair.Extent));
  output->AllocateScalars(VTK_DOUBLE, 1);
  auto* similarity = static_cast<double*>(output->GetScalarPointer());
  const auto* moment = static_cast<const double*>(smooth->GetOutput()->GetScalarPointer());
  for (vtkIdType pixel = 0; pixel < pixels; ++pixel, moment += 5)
  {
    const double meanA = moment[0];
    const double meanB = moment[1];
    const double varianceA = moment[2] - meanA * meanA;
    const double varianceB = moment[3] - meanB * meanB;
    const double covariance = moment[4] - meanA * meanB;
    similarity[pixel] = (2.0 * meanA * meanB + C1) * (2.0 * covariance + C2) /
      ((meanA * meanA + meanB * meanB + C1) * (varianceA + varianceB + C2));
  }
}

/// The mean SSIM of the windows inside the picture, or of all windows if none is.
double MeanSSIM(const Pair& pair, vtkImageStencilData* stencil, vtkImageData* map)
{
  const auto* similarity = static_cast<const double*>(map->GetScalarPointer());
  double sums[2] = {};
  vtkIdType counts[2] = {};
  ForEachPixel(pair, stencil,
    [&](vtkIdType pixel, int x, int y)
    {
      const int border = std::min({ x, y, pair.GetWidth() - 1 - x, pair.GetHeight() - 1 - y });
      const int isInside = border >= WindowRadius ? 1 : 0;
      sums[isInside] += similarity[pixel];
      ++counts[isInside];
    });
  return counts[1] > 0 ? sums[1] / counts[1] : sums[0] / counts[0];
}
}

vtkStandardNewMacro(vtkCSLFImageQuality);
cslfGuardedRequestMacro(vtkCSLFImageQuality);

vtkCSLFImageQuality::vtkCSLFImageQuality()
{
  this->SetNumberOfInputPorts(3);
}

void vtkCSLFImageQuality::SetStencilData(vtkImageStencilData* stencil)
{
  this->SetInputData(2, stencil);
}

void vtkCSLFImageQuality::SetStencilConnection(vtkAlgorithmOutput* connection)
{
  this->SetInputConnection(2, connection);
}

int vtkCSLFImageQuality::FillInputPortInformation(int port, vtkInformation* information)
{
  if (port == 2)
  {
    information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageStencilData");
    information->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
    return 1;
  }
  return this->Superclass::FillInputPortInformation(port, information);
}

int vtkCSLFImageQuality::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject::SetPointDataActiveScalarInfo(outputVector->GetInformationObject(0), VTK_DOUBLE, 1);
  return this->Superclass::RequestInformation(request, inputVector, outputVector);
}

int vtkCSLFImageQuality::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    vtkInformation* information = inputVector[port]->GetInformationObject(0);
    int extent[6];
    if (information && information->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
    {
      information->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
      information->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent, 6);
    }
  }
  return 1;
}

int vtkCSLFImageQuality::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageStencilData* stencil = vtkImageStencilData::GetData(inputVector[2]);
  Pair pair;
  const std::string error =
    pair.Set(vtkImageData::GetData(inputVector[0]), vtkImageData::GetData(inputVector[1]));
  if (!error.empty())
  {
    vtkErrorMacro(<< error);
    return 0;
  }
  double squares = 0.0;
  this->NumberOfPixels = 0;
  ForEachPixel(pair, stencil,
    [&](vtkIdType pixel, int, int)
    {
      squares += SquaredDifference(pair, pixel);
      ++this->NumberOfPixels;
    });
  if (this->NumberOfPixels == 0)
  {
    vtkErrorMacro("The stencil leaves no pixel to compare.");
    return 0;
  }
  this->PSNR =
    cslf::PSNR(squares / (this->NumberOfPixels * pair.GetColors(0)), Peak, this->MaximumPSNR);
  vtkImageData* output = vtkImageData::GetData(outputVector);
  ComputeSSIM(pair, output);
  this->SSIM = MeanSSIM(pair, stencil, output);
  return 1;
}

void vtkCSLFImageQuality::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumPSNR: " << this->MaximumPSNR << "\n";
  os << indent << "PSNR: " << this->PSNR << "\n";
  os << indent << "SSIM: " << this->SSIM << "\n";
  os << indent << "NumberOfPixels: " << this->NumberOfPixels << "\n";
}
