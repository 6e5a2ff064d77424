// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The mapper with inputs that are not light fields, changing inputs, float colour, released
// graphics resources, and two windows.
#include "cslfTestField.h"
#include "cslfTestView.h"
#include "cslfTesting.h"

#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTestErrorObserver.h>
#include <vtkUnsignedCharArray.h>

#include <cstring>
#include <string>

namespace
{
constexpr int Size = 64;

struct View : cslf::testing::View
{
  vtkSmartPointer<vtkActor> Actor;

  explicit View(vtkCSLFMapper* mapper)
    : cslf::testing::View(Size)
    , Actor(this->Add(mapper))
  {
    this->GetCamera()->SetPosition(1.0, 0.5, 5.0);
  }

  /// The mean of the picture's red, green and blue.
  double Render()
  {
    this->Renderer->ResetCameraClippingRange();
    return cslf::testing::View::Render().GetMean();
  }
};

void TestRefused(vtkImageData* image, const char* message)
{
  vtkNew<vtkTest::ErrorObserver> errors;
  vtkNew<vtkCSLFMapper> mapper;
  mapper->AddObserver(vtkCommand::ErrorEvent, errors);
  mapper->SetInputData(image);
  View view(mapper);
  CSLF_CHECK(view.Render() == 0.0);
  CSLF_CHECK(errors->GetErrorMessage().find(message) != std::string::npos);
  // Reported once, not for every picture.
  errors->Clear();
  view.Render();
  CSLF_CHECK(!errors->GetError());
  double bounds[6];
  mapper->GetBounds(bounds);
  CSLF_CHECK(bounds[0] > bounds[1]);
}

void TestRefusals()
{
  vtkNew<vtkImageData> empty;
  TestRefused(empty, "not a light field");

  const cslf::Layout layout(3, 16);
  const auto part = cslf::testing::MakeTestField(
    layout, cslf::Cube(), VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT, 1, 3, 20);
  TestRefused(part, "only a part");

  const auto moved =
    cslf::testing::MakeTestField(layout, cslf::Cube(), VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT, 1);
  moved->SetSpacing(2.0, 1.0, 1.0);
  TestRefused(moved, "spacing");

  // Colour of 3 components, depth of 8 bits, as the description says, too.
  cslf::Description description;
  description.Grid = layout;
  description.Channels = { { cslf::ColorName, VTK_UNSIGNED_CHAR, 3, cslf::SRGBEncoding },
    { cslf::DepthName, VTK_UNSIGNED_CHAR, 1, cslf::DepthEncoding } };
  vtkNew<vtkImageData> narrow;
  narrow->CopyStructure(moved);
  narrow->SetSpacing(1.0, 1.0, 1.0);
  for (const cslf::Channel& channel : description.Channels)
  {
    vtkNew<vtkUnsignedCharArray> array;
    array->SetName(channel.Name.c_str());
    array->SetNumberOfComponents(channel.Components);
    array->SetNumberOfTuples(narrow->GetNumberOfPoints());
    narrow->GetPointData()->AddArray(array);
  }
  description.WriteTo(narrow->GetFieldData());
  TestRefused(narrow, "\"Color\" has a type");

  vtkNew<vtkCSLFMapper> mapper;
  View view(mapper);
  CSLF_CHECK(view.Render() == 0.0);
}

void TestChanges()
{
  const cslf::Layout layout(3, 16);
  const auto bytes =
    cslf::testing::MakeTestField(layout, cslf::Cube(), VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT, 1);
  const auto floats = cslf::testing::MakeTestField(layout, cslf::Cube(), VTK_FLOAT, VTK_FLOAT, 1);
  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputData(bytes);
  View view(mapper);
  CSLF_CHECK(mapper->GetTextureBytes() == 0);
  const double brightness = view.Render();
  CSLF_CHECK(brightness > 5.0);
  // Nine of the thirty tiles of 3 x 3 viewpoints, one each, and a layer for missing ones.
  constexpr vtkTypeInt64 texels = (9 * 9 + 1) * 16 * 16;
  CSLF_CHECK(mapper->GetTextureBytes() == 6 * texels);

  // Released graphics resources are created again.
  mapper->ReleaseGraphicsResources(view.Window);
  CSLF_CHECK(mapper->GetTextureBytes() == 0);
  CSLF_CHECK(view.Render() == brightness);

  // A second window shows the same.
  {
    View other(mapper);
    CSLF_CHECK(other.Render() == brightness);
    CSLF_CHECK(view.Render() == brightness);
  }

  // Float colour is interpolated before it is encoded: nearly the same picture.
  mapper->SetInputData(floats);
  CSLF_CHECK_NEAR(view.Render(), brightness, 2.0);
  CSLF_CHECK(mapper->GetTextureBytes() == 12 * texels);

  // Another field replaces the first, also if it was changed in place.
  const auto black = vtkSmartPointer<vtkImageData>::New();
  black->DeepCopy(bytes);
  auto* colors =
    vtkUnsignedCharArray::SafeDownCast(black->GetPointData()->GetArray(cslf::ColorName));
  mapper->SetInputData(black);
  CSLF_CHECK(view.Render() == brightness);
  std::memset(colors->GetVoidPointer(0), 0, colors->GetNumberOfValues());
  black->Modified();
  CSLF_CHECK(view.Render() == 0.0);
}
}

int TestCSLFMapperInput(int, char*[])
{
  TestRefusals();
  TestChanges();
  return cslf::testing::Result();
}
