// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A molecule of balls and sticks becomes a light field: buckminsterfullerene, C60, as glyphs of a
// vtkGlyph3DMapper, of which one ball and one stick are kept, however many there are.
// Molecule [viewpoints per side] [texels per side] [samples]
#include "Example.h"

#include <vtkCamera.h>
#include <vtkCylinderSource.h>
#include <vtkDoubleArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkLookupTable.h>
#include <vtkMath.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

#include <array>
#include <cmath>
#include <set>

namespace
{
using Point = std::array<double, 3>;

/// The atoms of C60: the corners of a truncated icosahedron of edge 2.
std::set<Point> MakeAtoms()
{
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  const Point forms[] = { { 0.0, 1.0, 3.0 * golden }, { 1.0, 2.0 + golden, 2.0 * golden },
    { golden, 2.0, 2.0 * golden + 1.0 } };
  std::set<Point> atoms;
  for (const Point& form : forms)
  {
    for (int turn = 0; turn < 3; ++turn)
    {
      for (int signs = 0; signs < 8; ++signs)
      {
        Point atom;
        for (int axis = 0; axis < 3; ++axis)
        {
          const double value = form[(turn + axis) % 3];
          atom[axis] = (signs >> axis) & 1 && value != 0.0 ? -value : value;
        }
        atoms.insert(atom);
      }
    }
  }
  return atoms;
}

/// Points with a named array; add the array's tuples together with the points.
vtkSmartPointer<vtkPolyData> MakePoints(const char* name, int components)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  data->SetPoints(points);
  vtkNew<vtkDoubleArray> values;
  values->SetName(name);
  values->SetNumberOfComponents(components);
  data->GetPointData()->AddArray(values);
  return data;
}

/// Shows a source at each point.
vtkSmartPointer<vtkGlyph3DMapper> AddGlyphs(
  vtkRenderer* renderer, vtkPolyData* data, vtkAlgorithm* source)
{
  auto mapper = vtkSmartPointer<vtkGlyph3DMapper>::New();
  mapper->SetInputData(data);
  mapper->SetSourceConnection(source->GetOutputPort());
  mapper->ScalingOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.55, 0.55, 0.55);
  renderer->AddActor(actor);
  return mapper;
}

void AddBalls(vtkRenderer* renderer, const std::set<Point>& atoms)
{
  const auto data = MakePoints("height", 1);
  for (const Point& atom : atoms)
  {
    data->GetPoints()->InsertNextPoint(atom.data());
    data->GetPointData()->GetArray("height")->InsertNextTuple(&atom[2]);
  }
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.62);
  ball->SetThetaResolution(24);
  ball->SetPhiResolution(16);
  vtkNew<vtkLookupTable> colors;
  colors->SetHueRange(0.6, 0.05);
  colors->SetSaturationRange(0.75, 0.75);
  const auto balls = AddGlyphs(renderer, data, ball);
  balls->SetLookupTable(colors);
  balls->SetScalarModeToUsePointFieldData();
  balls->SelectColorArray("height");
  balls->SetScalarRange(-5.0, 5.0);
}

/// Sticks between neighbours, rotated along the bonds: glyphs point along x.
void AddSticks(vtkRenderer* renderer, const std::set<Point>& atoms)
{
  const auto data = MakePoints("direction", 3);
  for (auto first = atoms.begin(); first != atoms.end(); ++first)
  {
    for (auto second = std::next(first); second != atoms.end(); ++second)
    {
      Point direction;
      vtkMath::Subtract(second->data(), first->data(), direction.data());
      if (vtkMath::Norm(direction.data()) < 2.01)
      {
        Point middle;
        for (int axis = 0; axis < 3; ++axis)
        {
          middle[axis] = (*first)[axis] + 0.5 * direction[axis];
        }
        data->GetPoints()->InsertNextPoint(middle.data());
        data->GetPointData()->GetArray("direction")->InsertNextTuple(direction.data());
      }
    }
  }
  vtkNew<vtkCylinderSource> cylinder;
  cylinder->SetRadius(0.22);
  cylinder->SetHeight(2.0);
  cylinder->SetResolution(16);
  vtkNew<vtkTransform> turn;
  turn->RotateZ(-90.0);
  vtkNew<vtkTransformPolyDataFilter> stick;
  stick->SetInputConnection(cylinder->GetOutputPort());
  stick->SetTransform(turn);
  const auto sticks = AddGlyphs(renderer, data, stick);
  sticks->SetOrientationArray("direction");
  sticks->SetOrientationModeToDirection();
  sticks->ScalarVisibilityOff();
}
}

int main(int argc, char* argv[])
{
  const std::set<Point> atoms = MakeAtoms();
  vtkNew<vtkRenderer> molecule;
  AddBalls(molecule, atoms);
  AddSticks(molecule, atoms);

  // The scene of the renderer as a light field; its headlight becomes light from all around.
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetRenderer(molecule);
  example::SetSizes(sampler, argc, argv);

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.12, 0.13, 0.16);
  renderer->AddActor(example::MakeFieldActor(sampler));
  renderer->GetActiveCamera()->SetPosition(9.0, 7.0, 24.0);
  renderer->ResetCameraClippingRange();
  vtkNew<vtkRenderWindow> window;
  window->SetSize(640, 640);
  window->AddRenderer(renderer);
  return example::SavePicture(window, "Molecule.png");
}
