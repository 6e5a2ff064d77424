// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Scenes, fields and pictures whose arrays store components separately, or compute their values,
// give the same results as ordinary arrays with the same values.
#include "cslfCodecTesting.h"
#include "cslfTesting.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFFieldQuality.h"
#include "vtkCSLFImageQuality.h"
#include "vtkCSLFImageReader.h"
#include "vtkCSLFImageWriter.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFRateControl.h"
#include "vtkCSLFResample.h"
#include "vtkCSLFSampler.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSOADataArrayTemplate.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

// Newer versions of VTK have arrays that compute their values.
#if __has_include(<vtkStdFunctionArray.h>)
#include <vtkStdFunctionArray.h>

#include <functional>
#include <memory>
#define CSLF_HAS_IMPLICIT_ARRAYS
#endif

#include <algorithm>
#include <string>
#include <vector>

namespace
{
/// Makes an array of another layout with the same values.
using Convert = vtkSmartPointer<vtkDataArray> (*)(vtkDataArray* array);

template <typename Value>
vtkSmartPointer<vtkDataArray> MakeSOA(vtkDataArray* array)
{
  vtkNew<vtkSOADataArrayTemplate<Value>> other;
  other->DeepCopy(array);
  return other;
}

vtkSmartPointer<vtkDataArray> ToSOA(vtkDataArray* array)
{
  switch (array->GetDataType())
  {
    vtkTemplateMacro(return MakeSOA<VTK_TT>(array));
    default:
      return nullptr;
  }
}

#ifdef CSLF_HAS_IMPLICIT_ARRAYS
template <typename Value>
vtkSmartPointer<vtkDataArray> MakeImplicit(vtkDataArray* array)
{
  vtkNew<vtkStdFunctionArray<Value>> other;
  const vtkSmartPointer<vtkDataArray> values = array;
  const int components = array->GetNumberOfComponents();
  other->SetBackend(std::make_shared<std::function<Value(int)>>([values, components](int index)
    { return static_cast<Value>(values->GetComponent(index / components, index % components)); }));
  other->SetName(array->GetName());
  other->SetNumberOfComponents(components);
  other->SetNumberOfTuples(array->GetNumberOfTuples());
  return other;
}

vtkSmartPointer<vtkDataArray> ToImplicit(vtkDataArray* array)
{
  switch (array->GetDataType())
  {
    case VTK_UNSIGNED_CHAR:
      return MakeImplicit<unsigned char>(array);
    case VTK_UNSIGNED_SHORT:
      return MakeImplicit<unsigned short>(array);
    case VTK_INT:
      return MakeImplicit<int>(array);
    case VTK_FLOAT:
      return MakeImplicit<float>(array);
    case VTK_DOUBLE:
      return MakeImplicit<double>(array);
    default:
      return nullptr;
  }
}
#endif

/// Replaces all numeric arrays and keeps their attributes.
void ConvertArrays(vtkFieldData* fields, Convert convert)
{
  auto* attributes = vtkDataSetAttributes::SafeDownCast(fields);
  const std::string scalars =
    attributes && attributes->GetScalars() && attributes->GetScalars()->GetName()
    ? attributes->GetScalars()->GetName()
    : "";
  for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
  {
    if (vtkDataArray* array = fields->GetArray(i))
    {
      const vtkSmartPointer<vtkDataArray> other = convert(array);
      CSLF_CHECK(other && !other->HasStandardMemoryLayout());
      other->SetName(array->GetName());
      fields->AddArray(other);
    }
  }
  if (!scalars.empty())
  {
    attributes->SetActiveScalars(scalars.c_str());
  }
}

vtkSmartPointer<vtkImageData> ConvertImage(vtkImageData* image, Convert convert)
{
  auto other = vtkSmartPointer<vtkImageData>::New();
  other->ShallowCopy(image);
  ConvertArrays(other->GetPointData(), convert);
  return other;
}

vtkSmartPointer<vtkImageData> MakePicture(int seed)
{
  auto picture = vtkSmartPointer<vtkImageData>::New();
  picture->SetDimensions(24, 16, 1);
  vtkNew<vtkUnsignedCharArray> pixels;
  pixels->SetName("Pixels");
  pixels->SetNumberOfComponents(3);
  for (int i = 0; i < 3 * 24 * 16; ++i)
  {
    pixels->InsertNextValue(static_cast<unsigned char>((seed * i + i / 7) % 256));
  }
  picture->GetPointData()->SetScalars(pixels);
  return picture;
}

/// A textured sphere with colours at its points, emission at its cells, and two instances.
vtkSmartPointer<vtkPolyData> MakeScene()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(12);
  sphere->SetPhiResolution(8);
  sphere->Update();
  auto scene = vtkSmartPointer<vtkPolyData>::New();
  scene->DeepCopy(sphere->GetOutput());
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Colors");
  colors->SetNumberOfComponents(3);
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetName("Coordinates");
  coordinates->SetNumberOfComponents(2);
  for (vtkIdType i = 0; i < scene->GetNumberOfPoints(); ++i)
  {
    const double* point = scene->GetPoint(i);
    colors->InsertNextTuple3(100 + 200 * point[0], 100 + 200 * point[1], 50 + i);
    coordinates->InsertNextTuple2(point[0] + 0.5, point[2] + 0.5);
  }
  scene->GetPointData()->SetScalars(colors);
  scene->GetPointData()->SetTCoords(coordinates);
  vtkNew<vtkFloatArray> emission;
  emission->SetName(vtkCSLFMaterial::EmissionName());
  emission->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < scene->GetNumberOfCells(); ++i)
  {
    emission->InsertNextTuple3(0.01 * (i % 5), 0.0, 0.02 * (i % 3));
  }
  scene->GetCellData()->AddArray(emission);
  vtkCSLFMaterial::SetRoughness(scene, 0.7);
  vtkCSLFMaterial::SetTexture(scene, vtkCSLFMaterial::BaseColorTexture, MakePicture(5), true, true);
  vtkNew<vtkMatrix4x4> matrix;
  const double white[4] = { 1.0, 1.0, 1.0, 1.0 };
  const double red[4] = { 1.0, 0.2, 0.2, 1.0 };
  vtkCSLFInstances::AddInstance(scene, matrix, white);
  matrix->SetElement(0, 3, 1.5);
  vtkCSLFInstances::AddInstance(scene, matrix, red);
  return scene;
}

vtkSmartPointer<vtkPolyData> ConvertScene(vtkPolyData* scene, Convert convert)
{
  auto other = vtkSmartPointer<vtkPolyData>::New();
  other->ShallowCopy(scene);
  ConvertArrays(other->GetPointData(), convert);
  ConvertArrays(other->GetCellData(), convert);
  ConvertArrays(other->GetFieldData(), convert);
  other->GetPointData()->SetActiveTCoords("Coordinates");
  other->GetPointData()->SetActiveNormals("Normals");
  vtkNew<vtkPoints> points;
  points->SetData(convert(scene->GetPoints()->GetData()));
  other->SetPoints(points);
  return other;
}

vtkSmartPointer<vtkImageData> Sample(vtkPolyData* scene)
{
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputData(scene);
  sampler->SetViewpoints(2);
  sampler->SetResolution(16);
  sampler->SetSamples(4);
  sampler->Update();
  return sampler->GetOutput();
}

void TestSampler(Convert convert)
{
  const auto scene = MakeScene();
  const auto field = Sample(scene);
  // The compared fields are not black.
  CSLF_CHECK(field->GetPointData()->GetArray("Color")->GetRange(0)[1] > 50.0);
  CSLF_CHECK(cslf::testing::HasEqualSlices(Sample(ConvertScene(scene, convert)), field));
}

void TestInstances(Convert convert)
{
  vtkNew<vtkPolyData> scene;
  vtkNew<vtkMatrix4x4> matrix;
  vtkCSLFInstances::AddInstance(scene, matrix);
  ConvertArrays(scene->GetFieldData(), convert);
  matrix->SetElement(1, 3, 2.0);
  vtkCSLFInstances::AddInstance(scene, matrix);
  vtkDataArray* matrices = scene->GetFieldData()->GetArray(vtkCSLFInstances::InstanceMatrix());
  CSLF_CHECK(matrices->GetNumberOfTuples() == 2);
  CSLF_CHECK(matrices->GetComponent(0, 0) == 1.0 && matrices->GetComponent(0, 7) == 0.0);
  CSLF_CHECK(matrices->GetComponent(1, 7) == 2.0);
}

void TestEncoder(vtkImageData* field, vtkImageData* other, const std::string& folder)
{
  for (int keyViews : { 1, 2 })
  {
    vtkImageData* inputs[] = { field, other };
    std::vector<char> files[2];
    for (int k = 0; k < 2; ++k)
    {
      const std::string name = folder + "/" + std::to_string(keyViews) + std::to_string(k) + ".mp4";
      vtkNew<vtkCSLFEncoder> encoder;
      encoder->SetPreset("ultrafast");
      encoder->GetRateControl()->SetKeyViewStep(keyViews);
      CSLF_CHECK(cslf::testing::Encode(encoder, inputs[k], name));
      files[k] = cslf::testing::ReadBytes(name);
    }
    CSLF_CHECK(!files[0].empty() && files[0] == files[1]);
  }
}

void TestImageWriter(vtkImageData* field, vtkImageData* other, const std::string& folder)
{
  vtkNew<vtkCSLFImageWriter> writer;
  writer->SetInputData(other);
  writer->SetFileName((folder + "/images").c_str());
  CSLF_CHECK(writer->Write() == 1);
  vtkNew<vtkCSLFImageReader> reader;
  reader->SetFileName((folder + "/images").c_str());
  reader->Update();
  CSLF_CHECK(cslf::testing::HasEqualSlices(reader->GetOutput(), field));
}

void TestFieldQuality(vtkImageData* field, vtkImageData* other)
{
  vtkNew<vtkCSLFFieldQuality> quality;
  quality->SetInputData(0, other);
  quality->SetInputData(1, field);
  CSLF_CHECK(quality->Measure() == 1);
  CSLF_CHECK(quality->GetNumberOfFigures() == 3);
  for (int i = 0; i < quality->GetNumberOfFigures(); ++i)
  {
    CSLF_CHECK(quality->GetIsEqual(i));
  }
}

void TestResample(vtkImageData* field, vtkImageData* other)
{
  vtkNew<vtkCSLFResample> resample[2];
  resample[0]->SetInputData(field);
  resample[1]->SetInputData(other);
  for (auto& filter : resample)
  {
    filter->SetResolutionDivisor(2);
    filter->SetViewpointStride(2);
    filter->Update();
  }
  CSLF_CHECK(cslf::testing::HasEqualSlices(resample[1]->GetOutput(), resample[0]->GetOutput()));
}

void TestImageQuality(Convert convert)
{
  const auto first = MakePicture(5);
  const auto second = MakePicture(6);
  vtkNew<vtkCSLFImageQuality> quality[2];
  quality[0]->SetInputData(0, first);
  quality[0]->SetInputData(1, second);
  quality[1]->SetInputData(0, ConvertImage(first, convert));
  quality[1]->SetInputData(1, ConvertImage(second, convert));
  for (auto& filter : quality)
  {
    filter->Update();
  }
  CSLF_CHECK(quality[0]->GetPSNR() > 0.0 && quality[0]->GetPSNR() < 30.0);
  CSLF_CHECK(quality[1]->GetPSNR() == quality[0]->GetPSNR());
  CSLF_CHECK(quality[1]->GetSSIM() == quality[0]->GetSSIM());
}

void TestLayout(Convert convert, const std::string& folder)
{
  TestSampler(convert);
  TestInstances(convert);
  TestImageQuality(convert);
  const auto field = cslf::testing::MakeByteField(3, 32);
  const auto other = ConvertImage(field, convert);
  TestEncoder(field, other, folder);
  TestImageWriter(field, other, folder);
  TestFieldQuality(field, other);
  TestResample(field, other);
}
}

int TestCSLFArrayLayouts(int argc, char* argv[])
{
  TestLayout(ToSOA, cslf::testing::MakeFolder(argc, argv, "TestCSLFArrayLayoutsSOA"));
#ifdef CSLF_HAS_IMPLICIT_ARRAYS
  TestLayout(ToImplicit, cslf::testing::MakeFolder(argc, argv, "TestCSLFArrayLayoutsImplicit"));
#endif
  return cslf::testing::Result();
}
