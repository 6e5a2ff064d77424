// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The description's round trip through field data, and the refusal of data that does not match.
#include "cslfColor.h"
#include "cslfDescription.h"
#include "cslfJSON.h"
#include "cslfTesting.h"

#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>

#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedShortArray.h>

#include <cmath>
#include <iostream>
#include <limits>

namespace
{
cslf::Description MakeDescription()
{
  cslf::Description description;
  description.Grid = cslf::Layout(9, { 0, 4, 8 }, 4);
  description.Box = { { 0.1, -2.0, 3e5 }, { 1.0, 2.0, 0.3 } };
  description.Channels = { cslf::MakeChannel(cslf::KnownChannel::Color, VTK_UNSIGNED_CHAR),
    cslf::MakeChannel(cslf::KnownChannel::Depth, VTK_UNSIGNED_SHORT) };
  description.SceneBounds = { 0.0, 0.5, -3.0, -1.0, 2.99999e5, 3.00001e5 };
  description.Sampling = R"({"seed":7})";
  return description;
}

void MakeImage(const cslf::Description& description, vtkImageData* image, int first, int last)
{
  int extent[6];
  description.Grid.GetWholeExtent(extent);
  extent[4] = first;
  extent[5] = last;
  image->SetExtent(extent);
  const vtkIdType texels = image->GetNumberOfPoints();
  vtkNew<vtkUnsignedCharArray> color;
  color->SetName(cslf::ColorName);
  color->SetNumberOfComponents(4);
  color->SetNumberOfTuples(texels);
  vtkNew<vtkUnsignedShortArray> depth;
  depth->SetName(cslf::DepthName);
  depth->SetNumberOfTuples(texels);
  image->GetPointData()->SetScalars(color);
  image->GetPointData()->AddArray(depth);
  description.WriteTo(image->GetFieldData());
}

void TestRoundTrip()
{
  const cslf::Description description = MakeDescription();
  vtkNew<vtkImageData> image;
  MakeImage(description, image, 5, 11);
  std::string error;
  const auto read = cslf::Description::ReadFrom(image, error);
  CSLF_CHECK(read.has_value());
  if (read)
  {
    CSLF_CHECK(read->Grid == description.Grid);
    CSLF_CHECK(read->Box.Center == description.Box.Center);
    CSLF_CHECK(read->Box.Edges == description.Box.Edges);
    CSLF_CHECK(read->SceneBounds == description.SceneBounds);
    CSLF_CHECK_NEAR(read->GetSceneMaximumCC().x, 0.8, 1e-12);
    CSLF_CHECK_NEAR(read->GetSceneMinimumCC().y, -1.0, 1e-12);
    CSLF_CHECK(read->Channels.size() == 2);
    CSLF_CHECK(read->FindChannel(cslf::DepthName)->Type == VTK_UNSIGNED_SHORT);
    CSLF_CHECK(!read->FindChannel("Normals"));
    CSLF_CHECK(read->ToText() == description.ToText());
  }
}

template <typename Change>
void TestMisfit(Change change)
{
  vtkNew<vtkImageData> image;
  MakeImage(MakeDescription(), image, 0, 53);
  change(image);
  std::string error;
  CSLF_CHECK(!cslf::Description::ReadFrom(image, error));
  CSLF_CHECK(!error.empty());
}

void TestMisfits()
{
  TestMisfit([](vtkImageData* image) { image->GetFieldData()->Initialize(); });
  TestMisfit([](vtkImageData* image) { image->SetSpacing(2, 2, 1); });
  TestMisfit([](vtkImageData* image) { image->SetOrigin(0, 0, 1); });
  TestMisfit([](vtkImageData* image) { image->SetExtent(0, 9, 0, 1, 0, 53); });
  TestMisfit([](vtkImageData* image) { image->SetExtent(0, 19, 0, 3, 1, 54); });
  TestMisfit([](vtkImageData* image) { image->GetPointData()->RemoveArray(cslf::DepthName); });
  TestMisfit(
    [](vtkImageData* image)
    {
      vtkNew<vtkUnsignedCharArray> depth;
      depth->SetName(cslf::DepthName);
      depth->SetNumberOfTuples(image->GetNumberOfPoints());
      image->GetPointData()->AddArray(depth);
    });
  const auto replaceText = [](const std::string& text)
  {
    return [text](vtkImageData* image)
    {
      vtkStringArray::SafeDownCast(
        image->GetFieldData()->GetAbstractArray(cslf::Description::FieldDataName))
        ->SetValue(0, text);
    };
  };
  TestMisfit(replaceText(""));
  TestMisfit(replaceText("{"));
  TestMisfit(replaceText("[]"));
  TestMisfit(replaceText("{}"));
  const auto change = [&](const char* key, const nlohmann::json& value)
  {
    nlohmann::json json = MakeDescription().ToJSON();
    json[key] = value;
    TestMisfit(replaceText(json.dump()));
  };
  change("format", "JPEG");
  change("version", 99);
  change("version", "one");
  change("nodes", { 0, 8, 4 });
  change("nodes", nlohmann::json::object());
  change("resolution", -4);
  change("edges", { 0, 1, 1 });
  change("edges", { 1, 1 });
  change("channels", 3);
  change("base_nodes", 4294967305); // 9, were it wrapped
  change("resolution", 4.5);
  change("bounds", { 1, 2 });
  change("bounds", { 1, 0, 0, 1, 0, 1 });
}

template <typename Change>
void CheckError(const char* fault, Change change)
{
  cslf::Description description = MakeDescription();
  CSLF_CHECK(description.FindError().empty());
  change(description);
  if (description.FindError().find(fault) == std::string::npos)
  {
    std::cerr << "expected \"" << fault << "\", not \"" << description.FindError() << "\"\n";
    CSLF_CHECK(false);
  }
}

template <typename Change>
void CheckNoError(Change change)
{
  cslf::Description description = MakeDescription();
  change(description);
  CSLF_CHECK(description.FindError().empty());
}

void TestChannels()
{
  using cslf::Channel;
  using cslf::Description;
  const auto setFirst = [](const Channel& channel)
  { return [channel](Description& description) { description.Channels[0] = channel; }; };
  const auto setSecond = [](const Channel& channel)
  { return [channel](Description& description) { description.Channels[1] = channel; }; };
  const char* misfit = "cannot have";
  CheckError(misfit, setFirst({ "Color", VTK_UNSIGNED_CHAR, 3, cslf::SRGBEncoding }));
  CheckError(misfit, setFirst({ "Color", VTK_UNSIGNED_SHORT, 4, cslf::SRGBEncoding }));
  CheckError(misfit, setFirst({ "Color", VTK_UNSIGNED_CHAR, 4, cslf::LinearEncoding }));
  CheckError(misfit, setFirst({ "Color", VTK_FLOAT, 4, cslf::SRGBEncoding }));
  CheckError(misfit, setFirst({ "Color", VTK_DOUBLE, 4, cslf::LinearEncoding }));
  CheckError(misfit, setSecond({ "Depth", VTK_UNSIGNED_CHAR, 1, cslf::DepthEncoding }));
  CheckError(misfit, setSecond({ "Depth", VTK_UNSIGNED_SHORT, 2, cslf::DepthEncoding }));
  CheckError(misfit, setSecond({ "Depth", VTK_FLOAT, 1, "metres" }));
  CheckError(
    "two channels", setSecond(cslf::MakeChannel(cslf::KnownChannel::Color, VTK_UNSIGNED_CHAR)));
  CheckError("two channels", setSecond(cslf::MakeChannel(cslf::KnownChannel::Color, VTK_FLOAT)));
  CheckError("printable", setSecond({ "", VTK_FLOAT, 1, "" }));
  CheckError("printable", setSecond({ std::string("Color\0", 6), VTK_FLOAT, 1, "" }));
  CheckError("printable", setSecond({ std::string(101, 'a'), VTK_FLOAT, 1, "" }));
  CheckError("components", setSecond({ "Normals", VTK_FLOAT, 0, "" }));
  CheckError("components", setSecond({ "Normals", VTK_FLOAT, 65, "" }));
  CheckError("16 channels",
    [](Description& description)
    {
      for (int k = 0; k < 15; ++k)
      {
        description.Channels.push_back({ std::to_string(k), VTK_FLOAT, 1, "" });
      }
    });
  CheckNoError(setFirst(cslf::MakeChannel(cslf::KnownChannel::Color, VTK_FLOAT)));
  CheckNoError(setSecond(cslf::MakeChannel(cslf::KnownChannel::Depth, VTK_FLOAT)));
  CheckNoError(setSecond({ "Normals", VTK_FLOAT, 3, "" }));
}

void TestSizes()
{
  using cslf::Description;
  const auto setGrid = [](const cslf::Layout& grid)
  { return [grid](Description& description) { description.Grid = grid; }; };
  CheckError("not valid", setGrid(cslf::Layout(cslf::MaximumViewpoints + 1, 16)));
  CheckError("not valid", setGrid(cslf::Layout(2, cslf::MaximumResolution + 1)));
  CheckError("not valid", setGrid(cslf::Layout(1 << 17, { 0, (1 << 17) - 1 }, 16)));
  CheckNoError(setGrid(cslf::Layout(cslf::MaximumViewpoints, 128)));
  CheckNoError(setGrid(cslf::Layout(2, cslf::MaximumResolution)));
  CheckError(
    "too many texels", setGrid(cslf::Layout(cslf::MaximumViewpoints, cslf::MaximumResolution)));

  cslf::Description description = MakeDescription();
  CSLF_CHECK(description.GetBytes() == 6 * 54 * 5 * 16);
  // Far beyond 32 bits, and beyond the exact integers of doubles.
  description.Grid = cslf::Layout(cslf::MaximumViewpoints, cslf::MaximumResolution);
  description.Channels = { cslf::MakeChannel(cslf::KnownChannel::Color, VTK_FLOAT) };
  CSLF_CHECK(description.GetBytes() == std::int64_t(16) * 30 << 46);
}

void TestPlaces()
{
  using cslf::Description;
  const auto setBox = [](const cslf::Cube& box)
  {
    return [box](Description& description)
    {
      description.Box = box;
      description.SceneBounds.reset();
    };
  };
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  for (double bad : { nan, infinity, -infinity, 1e300, -1e300 })
  {
    CheckError("limits", setBox({ { 0, bad, 0 }, { 1, 1, 1 } }));
    CheckError("limits", setBox({ { 0, 0, 0 }, { 1, 1, bad } }));
    CheckError("bounds", [bad](Description& description) { (*description.SceneBounds)[3] = bad; });
  }
  CheckError("limits", setBox({ { 0, 0, 0 }, { 1, 0, 1 } }));
  CheckError("limits", setBox({ { 0, 0, 0 }, { 1, 1e-300, 1 } }));
  CheckError("too small", setBox({ { 1e20, 0, 0 }, { 1, 1, 1 } }));
  CheckNoError(setBox({ { 6.4e6, 0, 0 }, { 0.01, 1, 1 } }));
  CheckError("outside", [](Description& description) { description.Box.Center.y = 4.0; });
}

/// A wrong array: of the right type but shorter than the image.
void TestShortArray()
{
  TestMisfit(
    [](vtkImageData* image)
    {
      vtkNew<vtkUnsignedShortArray> depth;
      depth->SetName(cslf::DepthName);
      depth->SetNumberOfTuples(image->GetNumberOfPoints() - 1);
      image->GetPointData()->AddArray(depth);
    });
}

void TestColor()
{
  for (double value = 0.0; value <= 1.0; value += 1.0 / 64)
  {
    CSLF_CHECK_NEAR(cslf::SRGBToLinear(cslf::LinearToSRGB(value)), value, 1e-12);
  }
  unsigned char color[4];
  // Opaque colours go through a table.
  for (double value = 0.0; value <= 1.0; value += 1.0 / 99991)
  {
    cslf::EncodeColor({ value, 1.0 - value, 1.0 + value }, 1.0, color);
    CSLF_CHECK(color[0] == cslf::ToByte(cslf::LinearToSRGB(value)));
    CSLF_CHECK(color[1] == cslf::ToByte(cslf::LinearToSRGB(1.0 - value)));
    CSLF_CHECK(color[2] == 255 && color[3] == 255);
  }
  // A mean of 0.5 is 0.7354 encoded.
  cslf::EncodeColor({ 0.3, 5.0, 0.0 }, 0.6, color);
  CSLF_CHECK(color[0] == 113 && color[1] == 153 && color[2] == 0 && color[3] == 153);
  cslf::EncodeColor({ 1.0, 1.0, 1.0 }, 0.0, color);
  CSLF_CHECK(color[0] == 0 && color[3] == 0);
}
}

namespace
{
/// Frames are all slices of the first time, then those of the next.
void TestFrames()
{
  const cslf::Description description = MakeDescription();
  CSLF_CHECK(description.CountFrames() == description.CountTimes() * description.Grid.GetSlices());
  for (int index = 0; index < description.CountFrames(); ++index)
  {
    const cslf::FrameId frame = description.GetFrame(index);
    CSLF_CHECK(description.GetIndex(frame) == index);
    CSLF_CHECK(index == 0 || description.GetFrame(index - 1) < frame);
  }
  CSLF_CHECK(cslf::FrameId(7) == cslf::FrameId(7, 0) && cslf::FrameId(9) < cslf::FrameId(0, 1));
}
}

int TestCSLFDescription(int, char*[])
{
  TestFrames();
  TestRoundTrip();
  TestMisfits();
  TestShortArray();
  TestChannels();
  TestSizes();
  TestPlaces();
  TestColor();
  return cslf::testing::Result();
}
