// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The encoder's refusals: one clear line, and no file.
#include "cslfCodecTesting.h"
#include "cslfTesting.h"
#include "vtkCSLFEncoder.h"

#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <filesystem>
#include <functional>

namespace
{
void TestRefused(
  const std::string& folder, const std::string& name, vtkImageData* field,
  const std::string& message,
  const std::function<void(vtkCSLFEncoder*)>& change = [](vtkCSLFEncoder*) {})
{
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetPreset("ultrafast");
  const std::string fileName = folder + "/" + name;
  encoder->SetFileName(fileName.c_str());
  encoder->SetInputData(field);
  change(encoder);
  const cslf::testing::Observed observed(encoder);
  CSLF_CHECK(encoder->Write() == 0);
  CSLF_CHECK(encoder->GetErrorCode() != vtkErrorCode::NoError);
  if (!observed.HasError(message))
  {
    std::cerr << name << ": expected one error \"" << message << "\"\n";
    CSLF_CHECK(false);
  }
  CSLF_CHECK(std::filesystem::is_empty(folder));
}

void TestFiles(const std::string& folder, vtkImageData* field)
{
  TestRefused(folder, "a.avi", field, "must be .mp4 or .mkv");
  TestRefused(folder, "none", field, "must be .mp4 or .mkv");
  TestRefused(folder, "missing/a.mp4", field, "does not exist");
  TestRefused(folder, "a.mp4", field, "no file name",
    [](vtkCSLFEncoder* encoder) { encoder->SetFileName(nullptr); });
  TestRefused(folder, "a.mp4", field, "is none of ultrafast",
    [](vtkCSLFEncoder* encoder) { encoder->SetPreset("quick"); });
  TestRefused(folder, "a.mp4", field, "is none of auto, yuv444p",
    [](vtkCSLFEncoder* encoder) { encoder->SetPixelFormat("rgb24"); });
  TestRefused(folder, "a.mp4", field, "no input",
    [](vtkCSLFEncoder* encoder) { encoder->RemoveAllInputs(); });

  // A file where a folder should be.
  vtkNew<vtkCSLFEncoder> encoder;
  const std::string file = folder + "/file";
  cslf::testing::WriteBytes(file, { 'x' });
  encoder->SetFileName((file + "/a.mp4").c_str());
  encoder->SetInputData(field);
  {
    const cslf::testing::Observed observed(encoder);
    CSLF_CHECK(encoder->Write() == 0);
    CSLF_CHECK(observed.HasError("does not exist"));
  }

  // A file where the parts should be, and a folder where the file should be.
  const std::string partial = folder + "/b.mp4.partial";
  cslf::testing::WriteBytes(partial, { 'x' });
  std::filesystem::create_directory(folder + "/c.mp4");
  for (const char* name : { "/b.mp4", "/c.mp4" })
  {
    encoder->SetFileName((folder + name).c_str());
    const cslf::testing::Observed observed(encoder);
    CSLF_CHECK(encoder->Write() == 0);
    CSLF_CHECK(observed.HasError("folder"));
  }
  CSLF_CHECK(cslf::testing::ReadBytes(partial).size() == 1);
  std::filesystem::remove(file);
  std::filesystem::remove(partial);
  std::filesystem::remove(folder + "/c.mp4");
}

void TestFields(const std::string& folder)
{
  const cslf::Cube box{ { 0, 0, 0 }, { 2, 2, 2 } };
  const auto make = [&](int resolution, int color, int depth, int first = 0) {
    return cslf::testing::MakeTestField(cslf::Layout(2, resolution), box, color, depth, 1, first);
  };
  TestRefused(
    folder, "a.mp4", make(8, VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT), "at least 16 texels");
  TestRefused(folder, "a.mp4", make(16, VTK_DOUBLE, VTK_UNSIGNED_SHORT), "\"Color\" has a type");
  TestRefused(folder, "a.mp4", make(16, VTK_UNSIGNED_CHAR, VTK_FLOAT), "unsigned short");
  TestRefused(folder, "a.mp4", make(16, VTK_UNSIGNED_CHAR, 0, 3), "not a whole light field");
  TestRefused(folder, "a.mp4", make(17, VTK_UNSIGNED_CHAR, 0), "even resolution",
    [](vtkCSLFEncoder* encoder) { encoder->SetPixelFormat("yuv420p"); });

  vtkNew<vtkImageData> picture;
  picture->SetDimensions(80, 16, 24);
  picture->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  TestRefused(folder, "a.mp4", picture, "not a light field");
  picture->SetDimensions(80, 16, 25);
  TestRefused(folder, "a.mp4", picture, "not a whole light field");
  vtkNew<vtkImageData> nothing;
  TestRefused(folder, "a.mp4", nothing, "not a whole light field");
}

/// A channel that the file cannot store is left out with a warning.
void TestFurtherChannel(const std::string& folder)
{
  const auto field = cslf::testing::MakeByteField(2, 16);
  std::string error;
  auto description = cslf::Description::ReadFrom(field, error);
  CSLF_CHECK(description.has_value());
  if (description)
  {
    vtkNew<vtkFloatArray> heat;
    heat->SetName("Heat");
    heat->SetNumberOfTuples(field->GetNumberOfPoints());
    heat->Fill(1.0);
    field->GetPointData()->AddArray(heat);
    description->Channels.push_back({ "Heat", VTK_FLOAT, 1, "scalar" });
    description->WriteTo(field->GetFieldData());
  }
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetPreset("ultrafast");
  const cslf::testing::Observed observed(encoder);
  CSLF_CHECK(cslf::testing::Encode(encoder, field, folder + "/heat.mp4"));
  CSLF_CHECK(observed.HasWarning("\"Heat\""));
  CSLF_CHECK(cslf::testing::Decode(folder + "/heat.mp4") != nullptr);
}
}

int TestCSLFEncoderInvalid(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "EncoderInvalid");
  TestFiles(folder, cslf::testing::MakeByteField(2, 16));
  TestFields(folder);
  TestFurtherChannel(folder);
  return cslf::testing::Result();
}
