// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Files of only key views: their node lists, their samples, the slices pulled for them, and the
// choice of key views by quality.
#include "Resampling/cslfKeyViews.h"
#include "cslfCodecTesting.h"
#include "cslfFieldSource.h"
#include "cslfTestField.h"
#include "cslfTesting.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFRateControl.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <cstring>
#include <functional>
#include <string>

namespace
{
/// The ends are kept, the gaps are at most the step, and the list is symmetric.
void TestNodes()
{
  for (int viewpoints = 2; viewpoints < 70; ++viewpoints)
  {
    for (int step = 1; step < viewpoints; ++step)
    {
      const std::vector<int> indices = cslf::KeyViews(viewpoints, step).GetIndices();
      bool good = indices.front() == 0 && indices.back() == viewpoints - 1;
      for (std::size_t k = 1; k < indices.size(); ++k)
      {
        const int gap = indices[k] - indices[k - 1];
        good = good && gap > 0 && gap <= step && ((viewpoints - 1) % step != 0 || gap == step) &&
          indices[k] + indices[indices.size() - 1 - k] == viewpoints - 1;
      }
      CSLF_CHECK(good);
    }
  }
  CSLF_CHECK(cslf::KeyViews::FindError(9, 8).empty());
  CSLF_CHECK(!cslf::KeyViews::FindError(9, 9).empty());
  CSLF_CHECK(!cslf::KeyViews::FindError(9, 0).empty());
}

void SetUp(vtkCSLFEncoder* encoder, const std::string& fileName)
{
  encoder->SetPreset("ultrafast");
  encoder->SetFileName(fileName.c_str());
}

/// A lossless file of key views contains only their slices, and only these are pulled.
void TestSlices(
  const std::string& fileName, int viewpoints, int step, const std::vector<int>& nodes)
{
  const auto field = cslf::testing::MakeByteField(viewpoints, 16);
  const auto source = cslf::testing::MakeSource(field);
  vtkNew<vtkCSLFEncoder> encoder;
  SetUp(encoder, fileName);
  encoder->LosslessOn();
  encoder->GetRateControl()->SetKeyViewStep(step);
  encoder->SetInputConnection(source->GetOutputPort());
  CSLF_CHECK(encoder->Write() == 1);
  CSLF_CHECK(encoder->GetActualKeyViewStep() == step);
  const auto decoded = cslf::testing::Decode(fileName);
  std::string error;
  const auto description = cslf::Description::ReadFrom(decoded, error);
  if (!decoded || !description)
  {
    CSLF_CHECK(false);
    return;
  }
  CSLF_CHECK(description->Grid.GetNodes() == nodes);
  CSLF_CHECK(description->Grid.GetBaseNodes() == viewpoints);
  const int slices = description->Grid.GetSlices();
  CSLF_CHECK(source->Slices <= slices + 1);
  const cslf::KeyViews keys(viewpoints, step);
  for (const char* name : { cslf::ColorName, cslf::DepthName })
  {
    vtkDataArray* actual = decoded->GetPointData()->GetArray(name);
    vtkDataArray* whole = field->GetPointData()->GetArray(name);
    const auto bytes = static_cast<std::size_t>(actual->GetNumberOfTuples() / slices *
      actual->GetNumberOfComponents() * actual->GetDataTypeSize());
    const auto* a = static_cast<const char*>(actual->GetVoidPointer(0));
    const auto* b = static_cast<const char*>(whole->GetVoidPointer(0));
    for (int slice = 0; slice < slices; ++slice)
    {
      CSLF_CHECK(std::memcmp(a + bytes * slice, b + bytes * keys.ToWhole(slice), bytes) == 0);
    }
  }
}

/// The choice reaches its quality with the largest possible step.
void TestChoice(const std::string& fileName)
{
  const auto field = cslf::testing::MakeByteField(9, 32);
  double psnr = 0.0;
  int step = 0;
  for (double goal : { 20.0, 22.0 })
  {
    vtkNew<vtkCSLFEncoder> encoder;
    SetUp(encoder, fileName);
    encoder->SetInputData(field);
    encoder->GetRateControl()->SetKeyViewStepToAutomatic();
    encoder->GetRateControl()->SetTargetNovelViewPSNR(goal);
    CSLF_CHECK(encoder->Write() == 1);
    std::cout << "step " << encoder->GetActualKeyViewStep() << ", "
              << encoder->GetActualNovelViewPSNR() << " dB\n";
    CSLF_CHECK(encoder->GetActualNovelViewPSNR() >= goal);
    CSLF_CHECK(encoder->GetActualNovelViewPSNR() >= psnr);
    CSLF_CHECK(step == 0 || encoder->GetActualKeyViewStep() <= step);
    psnr = encoder->GetActualNovelViewPSNR();
    step = encoder->GetActualKeyViewStep();
    const auto decoded = cslf::testing::Decode(fileName);
    CSLF_CHECK(decoded && decoded->GetExtent()[5] < field->GetExtent()[5]);
  }
  CSLF_CHECK(step > 1);
}

/// The PSNR of the fewest key views.
double MeasureFewest(
  vtkImageData* field, const std::string& fileName, vtkPolyData* geometry = nullptr)
{
  vtkNew<vtkCSLFEncoder> encoder;
  SetUp(encoder, fileName);
  encoder->SetInputData(field);
  encoder->SetInputDataObject(1, geometry);
  encoder->GetRateControl()->SetKeyViewStepToAutomatic();
  encoder->GetRateControl()->SetTargetNovelViewPSNR(1.0);
  CSLF_CHECK(encoder->Write() == 1);
  return encoder->GetActualNovelViewPSNR();
}

/// With geometry, key views are measured by the lookup that has it. Where none sees a surface, the
/// geometry's own colour counts.
void TestGeometry(const std::string& fileName)
{
  const cslf::Cube box{ { 10.0, -3.0, 2.0 }, { 4.0, 3.0, 5.0 } };
  const auto field =
    cslf::testing::MakeTestField(cslf::Layout(5, 32), box, VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT);
  const auto geometry = cslf::testing::MakeTestSurfaces(box);
  const double without = MeasureFewest(field, fileName);
  const double with = MeasureFewest(field, fileName, geometry);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName(cslf::ColorName);
  colors->SetNumberOfComponents(4);
  colors->SetNumberOfTuples(geometry->GetNumberOfPoints());
  colors->Fill(255.0);
  geometry->GetPointData()->AddArray(colors);
  const double white = MeasureFewest(field, fileName, geometry);
  std::cout << "without geometry " << without << ", with " << with << ", with white points "
            << white << " dB\n";
  CSLF_CHECK(with > without + 1.0);
  CSLF_CHECK(white != with);
}

/// A float field that is too dark to show its errors is measured at 16 times the exposure, at which
/// a viewer may show it.
void TestExposures(const std::string& fileName)
{
  const auto make = [](int type)
  {
    return cslf::testing::MakeTestField(
      cslf::Layout(5, 32), cslf::Cube(), type, VTK_UNSIGNED_SHORT);
  };
  const auto dark = make(VTK_FLOAT);
  vtkDataArray* colors = dark->GetPointData()->GetArray("Color");
  for (vtkIdType texel = 0; texel < dark->GetNumberOfPoints(); ++texel)
  {
    for (int c = 0; c < 3; ++c)
    {
      colors->SetComponent(texel, c, colors->GetComponent(texel, c) / 16.0);
    }
  }
  const double ofBytes = MeasureFewest(make(VTK_UNSIGNED_CHAR), fileName);
  const double ofDark = MeasureFewest(dark, fileName);
  std::cout << "Bytes " << ofBytes << " dB, floats of 1/16 " << ofDark << " dB\n";
  CSLF_CHECK_NEAR(ofDark, ofBytes, 1.5);
}

void TestRefused(const std::string& fileName, const std::string& message,
  const std::function<void(vtkCSLFEncoder*)>& change)
{
  vtkNew<vtkCSLFEncoder> encoder;
  SetUp(encoder, fileName);
  encoder->SetInputData(cslf::testing::MakeByteField(5, 16));
  change(encoder);
  const cslf::testing::Observed observed(encoder);
  CSLF_CHECK(encoder->Write() == 0);
  CSLF_CHECK(observed.HasError(message));
  CSLF_CHECK(!cslf::testing::Exists(fileName));
  CSLF_CHECK(!cslf::testing::Exists(fileName + ".partial"));
}
}

int TestCSLFEncoderKeyViews(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "EncoderKeyViews");
  TestNodes();
  TestSlices(folder + "/keys.mp4", 5, 2, { 0, 2, 4 });
  TestSlices(folder + "/keys.mp4", 5, 4, { 0, 4 });
  TestSlices(folder + "/keys.mkv", 6, 2, { 0, 2, 3, 5 });
  TestSlices(folder + "/keys.mkv", 6, 5, { 0, 5 });
  TestChoice(folder + "/choice.mp4");
  TestGeometry(folder + "/geometry.mp4");
  TestExposures(folder + "/exposures.mp4");
  TestRefused(folder + "/refused.mp4", "must be 1 to 4",
    [](vtkCSLFEncoder* encoder) { encoder->GetRateControl()->SetKeyViewStep(5); });
  TestRefused(folder + "/refused.mp4", "no key views reach a PSNR of 90 dB: the best",
    [](vtkCSLFEncoder* encoder)
    {
      encoder->GetRateControl()->SetKeyViewStepToAutomatic();
      encoder->GetRateControl()->SetTargetNovelViewPSNR(90.0);
    });
  return cslf::testing::Result();
}
