// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Materials and lights in field data, and the Cornell box that contains them.
#include "cslfColor.h"
#include "cslfTesting.h"
#include "vtkCSLFCornellBoxSource.h"
#include "vtkCSLFLight.h"
#include "vtkCSLFMaterial.h"

#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkLight.h>
#include <vtkMath.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>

namespace
{
void TestDefaultsAndRanges()
{
  vtkNew<vtkPolyData> data;
  double tuple[3];
  vtkCSLFMaterial::GetBaseColor(data, tuple);
  CSLF_CHECK(tuple[0] == 0.8 && tuple[1] == 0.8 && tuple[2] == 0.8);
  vtkCSLFMaterial::GetEmission(data, tuple);
  CSLF_CHECK(tuple[0] == 0.0 && tuple[1] == 0.0 && tuple[2] == 0.0);
  vtkCSLFMaterial::GetDisplayedWhite(data, tuple);
  CSLF_CHECK(tuple[0] == 0.0 && tuple[1] == 0.0 && tuple[2] == 0.0);
  CSLF_CHECK(vtkCSLFMaterial::GetMetallic(data) == 0.0);
  CSLF_CHECK(vtkCSLFMaterial::GetRoughness(data) == 1.0);
  CSLF_CHECK(vtkCSLFMaterial::GetIndexOfRefraction(data) == 1.0);
  CSLF_CHECK(vtkCSLFMaterial::GetTransmission(data) == 0.0);
  CSLF_CHECK(vtkCSLFMaterial::GetOpacity(data) == 1.0);
  CSLF_CHECK(data->GetFieldData()->GetNumberOfArrays() == 0);
  CSLF_CHECK(vtkCSLFMaterial::GetOpacity(nullptr) == 1.0);

  const vtkMTimeType before = data->GetMTime();
  vtkCSLFMaterial::SetBaseColor(data, 0.1, 2.0, -1.0);
  CSLF_CHECK(data->GetMTime() > before);
  vtkCSLFMaterial::GetBaseColor(data, tuple);
  CSLF_CHECK(tuple[0] == 0.1 && tuple[1] == 1.0 && tuple[2] == 0.0);
  vtkCSLFMaterial::SetEmission(data, 17.0, 0.0, -1.0);
  vtkCSLFMaterial::GetEmission(data, tuple);
  CSLF_CHECK(tuple[0] == 17.0 && tuple[2] == 0.0);
  vtkCSLFMaterial::SetRoughness(data, std::numeric_limits<double>::quiet_NaN());
  CSLF_CHECK(vtkCSLFMaterial::GetRoughness(data) == 1.0);
  vtkCSLFMaterial::SetRoughness(data, 0.25);
  vtkCSLFMaterial::SetMetallic(data, 0.5);
  vtkCSLFMaterial::SetIndexOfRefraction(data, 0.5);
  vtkCSLFMaterial::SetTransmission(data, 0.75);
  vtkCSLFMaterial::SetOpacity(data, 0.125);
  CSLF_CHECK(vtkCSLFMaterial::GetRoughness(data) == 0.25);
  CSLF_CHECK(vtkCSLFMaterial::GetMetallic(data) == 0.5);
  CSLF_CHECK(vtkCSLFMaterial::GetIndexOfRefraction(data) == 1.0);
  CSLF_CHECK(vtkCSLFMaterial::GetTransmission(data) == 0.75);
  CSLF_CHECK(vtkCSLFMaterial::GetOpacity(data) == 0.125);
  CSLF_CHECK(data->GetFieldData()->GetNumberOfArrays() == 7);
  vtkCSLFMaterial::SetOpacityCutoff(data, 1.5);
  vtkCSLFMaterial::SetNormalScale(data, -0.5);
  CSLF_CHECK(vtkCSLFMaterial::GetOpacityCutoff(data) == 1.0);
  CSLF_CHECK(vtkCSLFMaterial::GetNormalScale(data) == -0.5);

  // A block keeps its own values and takes the others from its root.
  vtkNew<vtkPolyData> block;
  vtkCSLFMaterial::SetRoughness(block, 0.5);
  vtkCSLFMaterial::Inherit(block, data);
  CSLF_CHECK(vtkCSLFMaterial::GetRoughness(block) == 0.5);
  CSLF_CHECK(vtkCSLFMaterial::GetOpacity(block) == 0.125);
}

void TestProperty()
{
  vtkNew<vtkProperty> property;
  vtkNew<vtkPolyData> data;
  property->SetColor(1.0, 0.5, 0.25);
  property->SetDiffuse(0.5);
  property->SetSpecular(0.5);
  property->SetSpecularColor(1.0, 1.0, 1.0);
  property->SetSpecularPower(30.0);
  property->SetMetallic(1.0);
  property->SetOpacity(0.5);
  double tuple[3];
  vtkCSLFMaterial::SetFromProperty(data, property);
  vtkCSLFMaterial::GetBaseColor(data, tuple);
  // The boundary and the metal reflect a part of the light, which the base does not get.
  CSLF_CHECK_NEAR(tuple[0], 0.55, 0.02);
  CSLF_CHECK_NEAR(tuple[2], 0.14, 0.02);
  CSLF_CHECK_NEAR(vtkCSLFMaterial::GetMetallic(data), 0.15, 0.1);
  // A highlight of cosine^30 is half as high at 12.3 degrees, where the facets' normals are at half
  // that.
  const double cosine = std::pow(0.5, 1.0 / 30.0);
  const double alpha2 = (1.0 - cosine) / (1.0 + cosine) / (std::sqrt(2.0) - 1.0);
  CSLF_CHECK_NEAR(vtkCSLFMaterial::GetRoughness(data), std::pow(alpha2, 0.25), 1e-9);
  CSLF_CHECK(vtkCSLFMaterial::GetIndexOfRefraction(data) > 1.2);
  CSLF_CHECK(vtkCSLFMaterial::GetOpacity(data) == 0.5);
  property->SetSpecular(0.0);
  vtkCSLFMaterial::SetFromProperty(data, property);
  CSLF_CHECK(vtkCSLFMaterial::GetIndexOfRefraction(data) == 1.0);
  CSLF_CHECK(vtkCSLFMaterial::GetRoughness(data) == 1.0);
  vtkCSLFMaterial::GetBaseColor(data, tuple);
  CSLF_CHECK(tuple[0] == 0.5 && tuple[1] == 0.25 && tuple[2] == 0.125);

  // The ambient term is emission; without lighting everything is.
  property->SetAmbient(0.5);
  vtkCSLFMaterial::SetFromProperty(data, property);
  vtkCSLFMaterial::GetEmission(data, tuple);
  CSLF_CHECK_NEAR(tuple[1], cslf::SRGBToLinear(0.25), 1e-9);
  vtkCSLFMaterial::GetBaseColor(data, tuple);
  CSLF_CHECK_NEAR(
    cslf::SRGBToLinear(tuple[1]), cslf::SRGBToLinear(0.5) - cslf::SRGBToLinear(0.25), 1e-9);
  property->LightingOff();
  vtkCSLFMaterial::SetFromProperty(data, property);
  vtkCSLFMaterial::GetEmission(data, tuple);
  CSLF_CHECK_NEAR(tuple[1], cslf::SRGBToLinear(0.5), 1e-9);
  vtkCSLFMaterial::GetBaseColor(data, tuple);
  CSLF_CHECK(tuple[1] == 0.0);
  property->LightingOn();

  // Colours of physically based shading are linear.
  property->SetDiffuse(1.0);
  property->SetInterpolationToPBR();
  property->SetRoughness(0.3);
  property->SetBaseIOR(1.4);
  vtkCSLFMaterial::SetFromProperty(data, property);
  vtkCSLFMaterial::GetBaseColor(data, tuple);
  CSLF_CHECK_NEAR(tuple[0], 1.0, 1e-9);
  CSLF_CHECK_NEAR(tuple[1], cslf::LinearToSRGB(0.5), 1e-9);
  CSLF_CHECK(vtkCSLFMaterial::GetMetallic(data) == 1.0);
  CSLF_CHECK(vtkCSLFMaterial::GetRoughness(data) == 0.3);
  CSLF_CHECK(vtkCSLFMaterial::GetIndexOfRefraction(data) == 1.4);
  vtkCSLFMaterial::GetEmission(data, tuple);
  CSLF_CHECK(tuple[0] == 0.0);
}

void TestLights()
{
  vtkNew<vtkPolyData> data;
  vtkNew<vtkLight> light;
  light->SetPosition(0, 0, 3);
  light->SetFocalPoint(0, 0, 1);
  light->SetIntensity(2.0);
  vtkCSLFLight::AddLight(data, light);
  light->SetSwitch(false);
  vtkCSLFLight::AddLight(data, light);
  light->SetSwitch(true);
  light->SetPositional(true);
  light->SetConeAngle(90.0);
  light->SetDiffuseColor(1.0, 0.5, 0.0);
  vtkCSLFLight::AddLight(data, light);
  const double point[3] = { 1.0, 2.0, 3.0 };
  vtkCSLFLight::AddPointLight(data, point, point);
  const auto array = [&data](const char* name) { return data->GetFieldData()->GetArray(name); };
  vtkDataArray* directions = array(vtkCSLFLight::DirectionalLightDirection());
  vtkDataArray* irradiances = array(vtkCSLFLight::DirectionalLightIrradiance());
  vtkDataArray* intensities = array(vtkCSLFLight::PointLightIntensity());
  CSLF_CHECK(directions && directions->GetNumberOfTuples() == 1);
  CSLF_CHECK(directions && directions->GetComponent(0, 2) < 0.0);
  CSLF_CHECK(irradiances && irradiances->GetNumberOfTuples() == 1);
  CSLF_CHECK_NEAR(irradiances->GetComponent(0, 0), vtkMath::Pi() * cslf::SRGBToLinear(2.0), 1e-9);
  CSLF_CHECK(intensities && intensities->GetNumberOfTuples() == 2);
  CSLF_CHECK_NEAR(
    intensities->GetComponent(0, 1), vtkMath::Pi() * cslf::SRGBToLinear(2.0 * 0.5), 1e-9);
  vtkDataArray* attenuations = array(vtkCSLFLight::PointLightAttenuation());
  CSLF_CHECK(attenuations && attenuations->GetNumberOfTuples() == 2);
  CSLF_CHECK(attenuations && attenuations->GetComponent(0, 0) == 1.0 &&
    attenuations->GetComponent(0, 2) == 0.0);
  CSLF_CHECK(attenuations && attenuations->GetComponent(1, 0) == 0.0 &&
    attenuations->GetComponent(1, 2) == 1.0 && attenuations->GetComponent(1, 3) == 1.0);
  CSLF_CHECK(intensities->GetComponent(1, 2) == 3.0);
  vtkCSLFLight::RemoveLights(data);
  CSLF_CHECK(data->GetFieldData()->GetNumberOfArrays() == 0);
}

void TestCornellBox()
{
  vtkNew<vtkCSLFCornellBoxSource> source;
  source->Update();
  vtkMultiBlockDataSet* box = source->GetOutput();
  double bounds[6];
  box->GetBounds(bounds);
  for (int i = 0; i < 6; ++i)
  {
    CSLF_CHECK_NEAR(bounds[i], i % 2 == 0 ? -1.0 : 1.0, 1e-12);
  }
  bool lamp = false;
  for (unsigned int i = 0; i < box->GetNumberOfBlocks(); ++i)
  {
    const std::string name = box->GetMetaData(i)->Get(vtkCompositeDataSet::NAME());
    vtkDataObject* block = box->GetBlock(i);
    double emission[3];
    double color[3];
    vtkCSLFMaterial::GetEmission(block, emission);
    vtkCSLFMaterial::GetBaseColor(block, color);
    CSLF_CHECK((emission[0] > 0.0) == (name == "Lamp"));
    lamp = lamp || name == "Lamp";
    auto* data = vtkPolyData::SafeDownCast(block);
    CSLF_CHECK(data && data->GetNumberOfPolys() > 0);
    if (name == "LeftWall")
    {
      CSLF_CHECK(color[0] > color[1] && data->GetBounds()[1] == -1.0);
    }
    if (name == "BackWall")
    {
      CSLF_CHECK(data->GetBounds()[5] == -1.0);
    }
  }
  CSLF_CHECK(lamp && box->GetNumberOfBlocks() == 8);
}
}

int TestCSLFMaterial(int, char*[])
{
  TestDefaultsAndRanges();
  TestProperty();
  TestLights();
  TestCornellBox();
  vtkNew<vtkCSLFMaterial> material;
  vtkNew<vtkCSLFLight> light;
  std::ostringstream text;
  material->Print(text);
  light->Print(text);
  CSLF_CHECK(!text.str().empty());
  return cslf::testing::Result();
}
