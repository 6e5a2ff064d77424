// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Compares coarser fields with direct sums and with fields made at their resolution; the slices
// pulled for them, and refusals.
#include "cslfCodecTesting.h"
#include "cslfColor.h"
#include "cslfFieldSource.h"
#include "cslfJSON.h"
#include "cslfProgressWatch.h"
#include "cslfTestField.h"
#include "cslfTesting.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFResample.h"

#include <vtkDataArray.h>
#include <vtkExtractVOI.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace
{
const cslf::Cube Box{ { 0, 0, 0 }, { 2, 2, 2 } };

cslf::Description Describe(vtkImageData* field)
{
  std::string error;
  const auto description = cslf::Description::ReadFrom(field, error);
  if (!description)
  {
    std::cerr << error << "\n";
    CSLF_CHECK(false);
    return {};
  }
  return *description;
}

vtkSmartPointer<vtkImageData> Resample(vtkImageData* field, int divisor, int stride)
{
  vtkNew<vtkCSLFResample> resample;
  resample->SetInputData(field);
  resample->SetResolutionDivisor(divisor);
  resample->SetViewpointStride(stride);
  resample->Update();
  return resample->GetOutput();
}

vtkDataArray* GetArray(vtkImageData* field, const char* name)
{
  return field->GetPointData()->GetArray(name);
}

/// A field of byte colours from numbers, with holes and half-covered texels.
vtkSmartPointer<vtkImageData> MakeNumbers(int viewpoints, int resolution)
{
  cslf::Description description;
  description.Grid = cslf::Layout(viewpoints, resolution);
  description.Box = Box;
  description.Channels = { cslf::MakeChannel(cslf::KnownChannel::Color, VTK_UNSIGNED_CHAR),
    cslf::MakeChannel(cslf::KnownChannel::Depth, VTK_UNSIGNED_SHORT),
    { "Heat", VTK_UNSIGNED_CHAR, 2, "celsius" } };
  auto field = vtkSmartPointer<vtkImageData>::New();
  int extent[6];
  description.Grid.GetWholeExtent(extent);
  field->SetExtent(extent);
  for (const cslf::Channel& channel : description.Channels)
  {
    auto array = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(channel.Type));
    array->SetName(channel.Name.c_str());
    array->SetNumberOfComponents(channel.Components);
    array->SetNumberOfTuples(field->GetNumberOfPoints());
    field->GetPointData()->AddArray(array);
  }
  for (vtkIdType texel = 0; texel < field->GetNumberOfPoints(); ++texel)
  {
    const int alphas[] = { 255, 0, 100, 0, 0, 7, 255 };
    const int alpha = alphas[(texel * texel / 3) % 7];
    const int color[] = { alpha, static_cast<int>(texel * 31 % (alpha + 1)),
      static_cast<int>(texel * 17 % (alpha + 1)) };
    GetArray(field, "Color")->SetTuple4(texel, color[0], color[1], color[2], alpha);
    GetArray(field, "Depth")->SetTuple1(texel, alpha > 0 ? texel * 7919 % 65536 : 65535);
    GetArray(field, "Heat")->SetTuple2(texel, texel % 256, texel * 3 % 256);
  }
  description.WriteTo(field->GetFieldData());
  return field;
}

/// The sums over the square of one texel, as the conventions define them.
void CheckTexel(
  vtkImageData* fine, int fineZ, vtkImageData* coarse, int z, int x, int y, int divisor)
{
  double light[3] = { 0.0, 0.0, 0.0 };
  double alpha = 0.0;
  double depth = 65535.0;
  double heat = 0.0;
  double allHeat = 0.0;
  int covered = 0;
  for (int dy = 0; dy < divisor; ++dy)
  {
    for (int dx = 0; dx < divisor; ++dx)
    {
      int point[3] = { x * divisor + dx, y * divisor + dy, fineZ };
      const vtkIdType id = fine->ComputePointId(point);
      const double* color = GetArray(fine, "Color")->GetTuple4(id);
      const double coverage = color[3] / 255.0;
      allHeat += GetArray(fine, "Heat")->GetComponent(id, 1);
      if (coverage > 0.0)
      {
        for (int c = 0; c < 3; ++c)
        {
          light[c] += coverage * cslf::SRGBToLinear(color[c] / 255.0 / coverage);
        }
        alpha += coverage;
        depth = std::min(depth, GetArray(fine, "Depth")->GetTuple1(id));
        heat += GetArray(fine, "Heat")->GetComponent(id, 1);
        ++covered;
      }
    }
  }
  int point[3] = { x, y, z };
  const vtkIdType id = coarse->ComputePointId(point);
  const int count = divisor * divisor;
  const double* color = GetArray(coarse, "Color")->GetTuple4(id);
  for (int c = 0; c < 3 && covered > 0; ++c)
  {
    CSLF_CHECK_NEAR(color[c], 255.0 * alpha / count * cslf::LinearToSRGB(light[c] / alpha), 0.5001);
  }
  CSLF_CHECK(covered > 0 || (color[0] == 0.0 && color[1] == 0.0 && color[2] == 0.0));
  CSLF_CHECK_NEAR(color[3], 255.0 * alpha / count, 0.5001);
  CSLF_CHECK(GetArray(coarse, "Depth")->GetTuple1(id) == depth);
  CSLF_CHECK_NEAR(GetArray(coarse, "Heat")->GetComponent(id, 1),
    covered > 0 ? heat / covered : allHeat / count, 0.5001);
}

void TestSums(int divisor, int stride)
{
  const auto fine = MakeNumbers(5, 6);
  const auto coarse = Resample(fine, divisor, stride);
  const cslf::Layout fineGrid = Describe(fine).Grid;
  const cslf::Layout grid = Describe(coarse).Grid;
  CSLF_CHECK(grid.GetResolution() == 6 / divisor);
  CSLF_CHECK(grid.GetViewpoints() == 4 / stride + 1);
  for (int z = 0; z < grid.GetSlices(); ++z)
  {
    const cslf::Viewpoint viewpoint = grid.ViewpointOf(z);
    const int fineZ =
      fineGrid.SliceOf({ viewpoint.Face, viewpoint.I * stride, viewpoint.J * stride });
    CSLF_CHECK(
      grid.ViewpointPosition(viewpoint) == fineGrid.ViewpointPosition(fineGrid.ViewpointOf(fineZ)));
    for (int y = 0; y < grid.GetResolution(); ++y)
    {
      for (int x = 0; x < grid.GetStripWidth(); ++x)
      {
        CheckTexel(fine, fineZ, coarse, z, x, y, divisor);
      }
    }
  }
}

/// Averaged samples equal those of a field of the coarse resolution with more samples per texel.
void TestAgainstCoarseField()
{
  const cslf::Layout fineGrid(3, 16);
  const cslf::Layout grid(3, { 0, 2 }, 8);
  const auto fine = cslf::testing::MakeTestField(fineGrid, Box, VTK_FLOAT, VTK_FLOAT, 1);
  const auto expected = cslf::testing::MakeTestField(grid, Box, VTK_FLOAT, VTK_FLOAT, 2);
  const auto coarse = Resample(fine, 2, 2);
  CSLF_CHECK(Describe(coarse).Grid == grid);
  double largest = 0.0;
  for (vtkIdType i = 0; i < coarse->GetNumberOfPoints(); ++i)
  {
    for (int c = 0; c < 4; ++c)
    {
      largest = std::max(largest,
        std::abs(GetArray(coarse, "Color")->GetComponent(i, c) -
          GetArray(expected, "Color")->GetComponent(i, c)));
    }
  }
  CSLF_CHECK_NEAR(largest, 0.0, 1e-5);

  // Bytes are computed from rounded bytes.
  const auto bytes = Resample(
    cslf::testing::MakeTestField(fineGrid, Box, VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT, 1), 2, 2);
  const auto expectedBytes =
    cslf::testing::MakeTestField(grid, Box, VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT, 2);
  CSLF_CHECK(cslf::testing::Compare(bytes, expectedBytes).Color > 50.0);
}

void TestDescription()
{
  const auto fine = cslf::testing::MakeByteField(9, 16);
  const cslf::Description before = Describe(fine);
  const auto once = Resample(fine, 2, 2);
  const cslf::Description after = Describe(once);
  CSLF_CHECK(after.Grid == cslf::Layout(9, { 0, 2, 4, 6, 8 }, 8));
  CSLF_CHECK(after.Box.Edges == before.Box.Edges && after.SceneBounds == before.SceneBounds);
  CSLF_CHECK(after.Channels.size() == before.Channels.size());
  const auto twice = Describe(Resample(once, 4, 2));
  CSLF_CHECK(twice.Grid == cslf::Layout(9, { 0, 4, 8 }, 2));
  const auto sampling = nlohmann::json::parse(twice.Sampling);
  CSLF_CHECK(sampling["resampled"]["resolution_divisor"] == 8);
  CSLF_CHECK(sampling["resampled"]["viewpoint_stride"] == 4);
  CSLF_CHECK(cslf::testing::HasEqualSlices(Resample(fine, 1, 1), fine));
}

/// Texels of one surface each become texels of one surface, that at their centre: of two texels
/// beside it, that of the nearer surface.
void TestSurfaces(int colorType, int depthType)
{
  const double full = colorType == VTK_FLOAT ? 1.0 : 255.0;
  const double most = depthType == VTK_FLOAT ? 1.0 : 65535.0;
  const auto fine = cslf::testing::MakeTestField(cslf::Layout(2, 12), Box, colorType, depthType, 1);
  for (vtkIdType texel = 0; texel < fine->GetNumberOfPoints(); ++texel)
  {
    // Every third column is a green surface near by, all else a red one that rises slowly.
    const bool isNear = texel % 3 == 0;
    const double level = colorType == VTK_FLOAT ? 0.5 : 128.0;
    GetArray(fine, "Color")
      ->SetTuple4(texel, isNear ? 0.0 : level, isNear ? level : 0.0, 0.0, full);
    GetArray(fine, "Depth")
      ->SetTuple1(texel, most * (isNear ? 0.25 : 0.5 + 0.0005 * static_cast<double>(texel % 60)));
  }
  cslf::Description description = Describe(fine);
  for (const bool isSurface : { false, true })
  {
    description.Sampling = isSurface ? R"({"surface_texels":true})" : "{}";
    description.WriteTo(fine->GetFieldData());
    const auto thirds = Resample(fine, 3, 1);
    const auto halves = Resample(fine, 2, 1);
    for (vtkIdType texel = 0; texel < thirds->GetNumberOfPoints(); ++texel)
    {
      const double green = GetArray(thirds, "Color")->GetComponent(texel, 1);
      const double depth = GetArray(thirds, "Depth")->GetTuple1(texel) / most;
      CSLF_CHECK(isSurface ? green == 0.0 : green > 0.1 * full);
      CSLF_CHECK(isSurface ? depth >= 0.5 : depth < 0.26);
      CSLF_CHECK(GetArray(thirds, "Color")->GetComponent(texel, 3) == full);
    }
    for (vtkIdType texel = 0; texel < halves->GetNumberOfPoints(); ++texel)
    {
      // Columns 0 and 1, 2 and 3, 4 and 5: near, near, far.
      const bool isFar = texel % 3 == 2;
      const double red = GetArray(halves, "Color")->GetComponent(texel, 0);
      CSLF_CHECK(isFar || !isSurface ? red > 0.1 * full : red == 0.0);
      CSLF_CHECK((GetArray(halves, "Depth")->GetTuple1(texel) / most < 0.26) == !isFar);
    }
  }
}

/// Slabs of any size give the same result, and pull no more than they need.
void TestStreaming()
{
  const auto field = cslf::testing::MakeByteField(9, 16);
  const auto whole = Resample(field, 2, 2);
  const auto source = cslf::testing::MakeSource(field);
  vtkNew<vtkCSLFResample> resample;
  resample->SetInputConnection(source->GetOutputPort());
  resample->SetResolutionDivisor(2);
  resample->SetViewpointStride(2);
  for (const auto& [first, last] : { std::pair{ 0, 0 }, { 3, 11 }, { 20, 60 }, { 149, 149 } })
  {
    source->MaximumRequest = 0;
    source->Slices = 0;
    int extent[6] = { 0, 39, 0, 7, first, last };
    CSLF_CHECK(resample->UpdateExtent(extent) == 1);
    vtkImageData* slab = resample->GetOutput();
    CSLF_CHECK(slab->GetExtent()[4] == first && slab->GetExtent()[5] == last);
    CSLF_CHECK(cslf::testing::HasEqualSlices(slab, whole));
    // Of the input's rows, only every other one; two where faces meet.
    CSLF_CHECK(source->MaximumRequest <= 18);
    CSLF_CHECK(source->Slices <= 2 * (last - first + 1));
  }
}

/// Through the encoder, which requests slices in its own order.
void TestVideo(const std::string& folder)
{
  const auto field = cslf::testing::MakeByteField(5, 32);
  const auto source = cslf::testing::MakeSource(field);
  vtkNew<vtkCSLFResample> resample;
  resample->SetInputConnection(source->GetOutputPort());
  resample->SetResolutionDivisor(2);
  resample->SetViewpointStride(2);
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputConnection(resample->GetOutputPort());
  encoder->SetFileName((folder + "/coarse.mkv").c_str());
  encoder->SetPreset("ultrafast");
  encoder->LosslessOn();
  CSLF_CHECK(encoder->Write() == 1);
  const auto decoded = cslf::testing::Decode(folder + "/coarse.mkv");
  CSLF_CHECK(decoded && cslf::testing::HasEqualSlices(decoded, Resample(field, 2, 2)));
}

void TestParts()
{
  const auto field = cslf::testing::MakeByteField(5, 16);
  vtkNew<vtkExtractVOI> part;
  part->SetInputData(field);
  part->SetVOI(0, 79, 0, 15, 20, 30);
  vtkNew<vtkCSLFResample> resample;
  resample->SetInputConnection(part->GetOutputPort());
  resample->SetResolutionDivisor(2);
  resample->Update();
  CSLF_CHECK(resample->GetOutput()->GetExtent()[4] == 20);
  CSLF_CHECK(cslf::testing::HasEqualSlices(resample->GetOutput(), Resample(field, 2, 1)));

  resample->SetViewpointStride(2);
  const cslf::testing::Observed observed(resample);
  resample->Update();
  CSLF_CHECK(observed.HasError("only of whole light fields"));
}

void TestRefused(vtkImageData* field, int divisor, int stride, const std::string& message)
{
  vtkNew<vtkCSLFResample> resample;
  resample->SetInputData(field);
  resample->SetResolutionDivisor(divisor);
  resample->SetViewpointStride(stride);
  const cslf::testing::Observed observed(resample);
  resample->Update();
  CSLF_CHECK(observed.HasError(message));
  CSLF_CHECK(resample->GetOutput()->GetNumberOfPoints() == 0);
}

void TestErrors()
{
  const auto field = cslf::testing::MakeByteField(5, 16);
  TestRefused(field, 3, 1, "cannot be divided by 3");
  TestRefused(field, 32, 1, "cannot be divided by 32");
  TestRefused(field, 1, 3, "must divide 4");
  TestRefused(field, 1, 8, "must divide 4");
  vtkNew<vtkImageData> picture;
  picture->SetDimensions(80, 16, 24);
  picture->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  TestRefused(picture, 2, 1, "not a light field");
  picture->SetDimensions(70, 16, 24);
  TestRefused(picture, 2, 1, "not a light field");

  // If the input fails or is stopped, nothing is left.
  const auto source = cslf::testing::MakeSource(field);
  source->FailingSlice = 70;
  vtkNew<vtkCSLFResample> resample;
  resample->SetInputConnection(source->GetOutputPort());
  resample->SetResolutionDivisor(2);
  resample->SetViewpointStride(2);
  {
    const cslf::testing::Observed observed(resample);
    const cslf::testing::Observed sourceObserved(source);
    resample->Update();
    CSLF_CHECK(sourceObserved.GetErrors() >= 1);
    CSLF_CHECK(observed.GetErrors() >= 1);
    CSLF_CHECK(resample->GetOutput()->GetNumberOfPoints() == 0);
  }
  source->FailingSlice = -1;
  resample->Modified();
  resample->Update();
  CSLF_CHECK(cslf::testing::HasEqualSlices(resample->GetOutput(), Resample(field, 2, 2)));
}

// The phase is that of the input while that works, and stopping reaches the input.
void TestPhases()
{
  const auto field = cslf::testing::MakeByteField(5, 16);
  const auto source = cslf::testing::MakeSource(field);
  vtkNew<vtkCSLFResample> resample;
  resample->SetInputConnection(source->GetOutputPort());
  resample->SetResolutionDivisor(2);
  const cslf::testing::Observed observed(resample);
  {
    const cslf::testing::ProgressWatch watch(resample, "Resampling viewpoints", 2);
    resample->Update();
    watch.CheckAborted();
  }
  CSLF_CHECK(observed.GetErrors() == 0);
  CSLF_CHECK(resample->GetOutput()->GetNumberOfPoints() == 0);
  resample->SetAbortExecute(0);
  const cslf::testing::ProgressWatch watch(resample);
  resample->Update();
  watch.CheckWhole({ "Resampling viewpoints" });
  CSLF_CHECK(cslf::testing::HasEqualSlices(resample->GetOutput(), Resample(field, 2, 1)));
}
}

int TestCSLFResample(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "Resample");
  TestSums(2, 1);
  TestSums(3, 2);
  TestSums(1, 4);
  TestAgainstCoarseField();
  TestSurfaces(VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT);
  TestSurfaces(VTK_FLOAT, VTK_FLOAT);
  TestDescription();
  TestStreaming();
  TestVideo(folder);
  TestParts();
  TestErrors();
  TestPhases();
  return cslf::testing::Result();
}
