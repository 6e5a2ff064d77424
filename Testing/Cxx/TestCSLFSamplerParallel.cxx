// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A scene with a piece on each rank is sampled like the whole on one rank: every byte, and the
// description, are the same.
#include "cslfDescription.h"
#include "cslfTesting.h"
#include "vtkCSLFLight.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFRadianceCacheOptions.h"
#include "vtkCSLFSampler.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommunicator.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkMPIController.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

namespace
{
/// The piece of the scene on a rank: a sphere with its own colour.
vtkSmartPointer<vtkPolyData> MakePiece(int rank)
{
  vtkNew<vtkSphereSource> source;
  source->SetCenter(1.2 * rank, 0.0, 0.0);
  source->Update();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Colors");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(source->GetOutput()->GetNumberOfPoints());
  colors->FillComponent(0, 250.0 - 100.0 * rank);
  colors->FillComponent(1, 100.0 * rank);
  colors->FillComponent(2, 77.0);
  auto piece = vtkSmartPointer<vtkPolyData>::New();
  piece->DeepCopy(source->GetOutput());
  piece->GetPointData()->SetScalars(colors);
  vtkCSLFMaterial::SetRoughness(piece, 0.2 + 0.2 * rank);
  vtkCSLFMaterial::SetIndexOfRefraction(piece, 1.5);
  return piece;
}

/// A light for the whole scene, because field data is the same on all pieces.
void AddLight(vtkDataObject* data)
{
  const double direction[3] = { -1.0, -2.0, -1.0 };
  const double irradiance[3] = { 0.5, 0.4, 0.3 };
  vtkCSLFLight::AddDirectionalLight(data, direction, irradiance);
}

vtkSmartPointer<vtkMultiBlockDataSet> MakeBlocks(const std::vector<int>& ranks, int count)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  blocks->SetNumberOfBlocks(static_cast<unsigned int>(count));
  for (int rank : ranks)
  {
    blocks->SetBlock(static_cast<unsigned int>(rank), MakePiece(rank));
  }
  AddLight(blocks);
  vtkCSLFMaterial::SetMetallic(blocks, 0.5);
  return blocks;
}

void SetUp(vtkCSLFSampler* sampler, vtkMultiProcessController* controller)
{
  sampler->SetController(controller);
  sampler->DistributedSceneOn();
  sampler->SetViewpoints(2);
  sampler->SetResolution(12);
  sampler->SetSamples(4);
  // The test needs equal bytes, not a good picture.
  sampler->GetCacheOptions()->SetSamples(64);
}

/// A field's description and its samples.
struct Sampled
{
  std::string Text;
  std::string Bytes;
};

Sampled Sample(vtkCSLFSampler* sampler)
{
  sampler->Update();
  std::string error;
  const auto description = cslf::Description::ReadFrom(sampler->GetOutput(), error);
  CSLF_CHECK(description.has_value());
  Sampled field;
  field.Text = description ? description->ToText() : std::string();
  for (const char* name : { cslf::ColorName, cslf::DepthName })
  {
    vtkDataArray* array = sampler->GetOutput()->GetPointData()->GetArray(name);
    const auto size =
      static_cast<std::size_t>(array->GetNumberOfValues()) * array->GetDataTypeSize();
    field.Bytes.append(static_cast<const char*>(array->GetVoidPointer(0)), size);
  }
  return field;
}

void TestBlocks(vtkMultiProcessController* controller)
{
  const int rank = controller->GetLocalProcessId();
  const int count = controller->GetNumberOfProcesses();
  vtkNew<vtkCSLFSampler> together;
  SetUp(together, controller);
  together->SetInputDataObject(MakeBlocks({ rank }, count));
  const Sampled field = Sample(together);

  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  vtkNew<vtkCSLFSampler> alone;
  SetUp(alone, nullptr);
  alone->SetInputDataObject(MakeBlocks(all, count));
  const Sampled whole = Sample(alone);
  CSLF_CHECK(whole.Text == field.Text && whole.Bytes == field.Bytes);
}

/// A surface of emissive quads, tubes and spheres, coloured by cells or by points.
vtkSmartPointer<vtkPolyData> MakeSurface(bool cellColors)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->LatLongTessellationOn();
  sphere->Update();
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->DeepCopy(sphere->GetOutput());
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < 20; i += 2)
  {
    const vtkIdType line[2] = { i, i + 1 };
    lines->InsertNextCell(2, line);
    vertices->InsertNextCell(1, line);
  }
  surface->SetLines(lines);
  surface->SetVerts(vertices);
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName("Scalars");
  const vtkIdType count = cellColors ? surface->GetNumberOfCells() : surface->GetNumberOfPoints();
  for (vtkIdType i = 0; i < count; ++i)
  {
    scalars->InsertNextValue(std::sin(0.7 * i));
  }
  vtkDataSetAttributes* attributes = surface->GetPointData();
  if (cellColors)
  {
    attributes = surface->GetCellData();
  }
  attributes->SetScalars(scalars);
  vtkCSLFMaterial::SetEmission(surface, 0.2, 0.1, 0.4);
  vtkCSLFMaterial::SetPointRadius(surface, 0.1);
  vtkCSLFMaterial::SetLineRadius(surface, 0.05);
  return surface;
}

/// Every n-th cell; the others are ghosts.
vtkSmartPointer<vtkPolyData> Cut(vtkPolyData* whole, int piece, int pieces)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  const vtkIdType count = whole->GetNumberOfCells();
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    ghosts->InsertNextValue(cell % pieces == piece ? 0 : vtkDataSetAttributes::DUPLICATECELL);
  }
  auto cut = vtkSmartPointer<vtkPolyData>::New();
  cut->ShallowCopy(whole);
  cut->GetCellData()->AddArray(ghosts);
  return cut;
}

/// One surface, cut regardless of the position of its parts.
void TestCuts(vtkMultiProcessController* controller, bool cellColors, int integrator)
{
  const vtkSmartPointer<vtkPolyData> surface = MakeSurface(cellColors);
  vtkNew<vtkLookupTable> table;
  table->SetTableRange(-1.0, 1.0);
  Sampled fields[2];
  for (const bool cut : { false, true })
  {
    vtkNew<vtkCSLFSampler> sampler;
    SetUp(sampler, cut ? controller : nullptr);
    sampler->SetIntegrator(integrator);
    sampler->SetLookupTable(table);
    sampler->SetInputData(cut
        ? Cut(surface, controller->GetLocalProcessId(), controller->GetNumberOfProcesses())
        : surface);
    fields[cut ? 1 : 0] = Sample(sampler);
  }
  CSLF_CHECK(fields[0].Text == fields[1].Text);
  CSLF_CHECK(fields[0].Bytes == fields[1].Bytes);
}

/// A source that makes its sphere in pieces. Every rank gets all of it.
void TestPieces(vtkMultiProcessController* controller)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(24);
  vtkNew<vtkCSLFSampler> together;
  SetUp(together, controller);
  together->SetInputConnection(source->GetOutputPort());
  const Sampled field = Sample(together);
  const std::string mine = field.Text + field.Bytes;
  std::string first = mine;
  controller->Broadcast(first.data(), static_cast<vtkIdType>(first.size()), 0);
  CSLF_CHECK(first == mine);
  CSLF_CHECK(source->GetOutput()->GetNumberOfPolys() < 200);

  // If not distributed, each rank traces its whole input.
  together->DistributedSceneOff();
  const Sampled whole = Sample(together);
  vtkNew<vtkCSLFSampler> alone;
  SetUp(alone, nullptr);
  alone->DistributedSceneOff();
  alone->SetInputConnection(source->GetOutputPort());
  const Sampled expected = Sample(alone);
  CSLF_CHECK(expected.Text == whole.Text && expected.Bytes == whole.Bytes);
}
}

int TestCSLFSamplerParallel(int argc, char* argv[])
{
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv, 0);
  TestBlocks(controller);
  for (const bool cellColors : { false, true })
  {
    TestCuts(controller, cellColors, vtkCSLFSampler::PathTracing);
    TestCuts(controller, cellColors, vtkCSLFSampler::RadianceCaching);
  }
  TestPieces(controller);
  const int mine = cslf::testing::Failures();
  int all = 0;
  controller->AllReduce(&mine, &all, 1, vtkCommunicator::SUM_OP);
  controller->Finalize();
  return all == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
