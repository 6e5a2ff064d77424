// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Exposure and tone mapping: the shader compared with the C++ version, for 8-bit and float fields,
// and the curves themselves.
#include "cslfColor.h"
#include "cslfTestField.h"
#include "cslfTestView.h"
#include "cslfTesting.h"
#include "vtkCSLFToneMapping.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace
{
using cslf::testing::Picture;
using cslf::testing::View;

glm::dvec3 MapTone(double exposure, int curve, glm::dvec3 color)
{
  vtkNew<vtkCSLFToneMapping> toneMapping;
  toneMapping->SetExposure(exposure);
  toneMapping->SetCurve(curve);
  toneMapping->MapTone(&color.x, &color.x);
  return color;
}

// The C++ functions convert the plain picture to the mapped one, up to rounding.
void TestPictures(int type)
{
  View view;
  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputData(
    cslf::testing::MakeTestField(cslf::Layout(3, 32), cslf::Cube(), type, VTK_UNSIGNED_SHORT, 1));
  mapper->SetLookupToNearest();
  view.Add(mapper);
  const Picture plain = view.Render();
  for (const double exposure : { 0.5, 1.0, 1.6 })
  {
    for (int curve = vtkCSLFToneMapping::Clamp; curve <= vtkCSLFToneMapping::ACES; ++curve)
    {
      mapper->GetToneMapping()->SetExposure(exposure);
      mapper->GetToneMapping()->SetCurve(curve);
      const Picture seen = view.Render();
      double most = 0.0;
      for (std::size_t i = 0; i < seen.Colors.size(); i += 3)
      {
        const glm::dvec3 color(plain.Colors[i], plain.Colors[i + 1], plain.Colors[i + 2]);
        const glm::dvec3 mapped =
          cslf::LinearToSRGB(MapTone(exposure, curve, cslf::SRGBToLinear(color / 255.0)));
        for (int c = 0; c < 3; ++c)
        {
          most = std::max(most, std::abs(seen.Colors[i + c] - 255.0 * mapped[c]));
        }
      }
      std::cout << mapper->GetToneMapping()->GetCurveAsString() << " at " << exposure << ": "
                << most << " levels at most\n";
      CSLF_CHECK(most < 3.0);
    }
  }
  mapper->SetToneMapping(nullptr);
  CSLF_CHECK(cslf::testing::ComparePictures(view.Render(), plain) == 99.0);
}

// Values brighter than white are recovered if the field is float.
void TestRange()
{
  const auto field = cslf::testing::MakeTestField(
    cslf::Layout(3, 16), cslf::Cube(), VTK_FLOAT, VTK_UNSIGNED_SHORT, 1);
  vtkDataArray* colors = field->GetPointData()->GetArray(cslf::ColorName);
  for (vtkIdType texel = 0; texel < colors->GetNumberOfTuples(); ++texel)
  {
    for (int c = 0; c < 3; ++c)
    {
      colors->SetComponent(texel, c, 8.0 * colors->GetComponent(texel, 3));
    }
  }
  View view;
  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputData(field);
  view.Add(mapper);
  const auto brightest = [&]
  {
    const Picture picture = view.Render();
    return *std::max_element(picture.Colors.begin(), picture.Colors.end());
  };
  CSLF_CHECK(brightest() == 255);
  mapper->GetToneMapping()->SetExposure(1.0 / 16.0);
  CSLF_CHECK_NEAR(brightest(), 255.0 * cslf::LinearToSRGB(0.5), 1.0);
  mapper->GetToneMapping()->SetExposure(1.0);
  mapper->GetToneMapping()->SetCurveToReinhard();
  CSLF_CHECK_NEAR(brightest(), 255.0 * cslf::LinearToSRGB(8.0 / 9.0), 1.0);
}

void TestCurves()
{
  const glm::dvec3 color(0.2, 0.4, 0.1);
  CSLF_CHECK((MapTone(2.0, vtkCSLFToneMapping::Clamp, color) == 2.0 * color));
  // Reinhard preserves hues and stays below white.
  const glm::dvec3 mapped = MapTone(1.0, vtkCSLFToneMapping::Reinhard, color);
  CSLF_CHECK_NEAR(mapped.x / mapped.y, 0.5, 1e-12);
  CSLF_CHECK(MapTone(1e6, vtkCSLFToneMapping::Reinhard, glm::dvec3(1.0)).x < 1.0);
  // The film-like curve increases everywhere.
  double last = -1.0;
  for (double value = 0.0; value < 10.0; value += 0.1)
  {
    const double shown = MapTone(1.0, vtkCSLFToneMapping::ACES, glm::dvec3(value)).x;
    CSLF_CHECK(shown > last);
    last = shown;
  }
  CSLF_CHECK(vtkNew<vtkCSLFToneMapping>()->IsIdentity());
}

void TestSettings()
{
  vtkNew<vtkCSLFMapper> mapper;
  vtkNew<vtkCSLFToneMapping> toneMapping;
  mapper->SetToneMapping(toneMapping);
  const auto before = mapper->GetMTime();
  toneMapping->SetCurveToACES();
  CSLF_CHECK(mapper->GetMTime() > before);
  vtkNew<vtkCSLFMapper> copy;
  copy->ShallowCopy(mapper);
  CSLF_CHECK(copy->GetToneMapping() == toneMapping);
  copy->SetToneMapping(nullptr);
  CSLF_CHECK(copy->GetToneMapping() && copy->GetToneMapping()->IsIdentity());
  copy->GetToneMapping()->DeepCopy(toneMapping);
  CSLF_CHECK(copy->GetToneMapping()->GetCurve() == vtkCSLFToneMapping::ACES);
}
}

int TestCSLFMapperToneMapping(int, char*[])
{
  TestPictures(VTK_UNSIGNED_CHAR);
  TestPictures(VTK_FLOAT);
  TestRange();
  TestCurves();
  TestSettings();
  return cslf::testing::Result();
}
