// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Picking: the point on the field's surface, the actor, and the face of the cube, also behind
// something, where the field is empty, and whatever the actor's property says.
#include "cslfTestView.h"
#include "cslfTesting.h"

#include <vtkHardwareSelector.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkPlane.h>
#include <vtkPropPicker.h>
#include <vtkProperty.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>
#include <vtkWorldPointPicker.h>

#include <set>

namespace
{
using cslf::testing::View;

constexpr int Size = 128;
constexpr int Middle = Size / 2;

// Straight at the sphere, whose nearest point is (0.25, 0.15, 0.55).
void LookAtSphere(View& view)
{
  view.GetCamera()->SetPosition(0.25, 0.15, 6.0);
  view.GetCamera()->SetFocalPoint(0.25, 0.15, 0.0);
}

void CheckPosition(const double* position)
{
  CSLF_CHECK_NEAR(position[0], 0.25, 0.03);
  CSLF_CHECK_NEAR(position[1], 0.15, 0.03);
  CSLF_CHECK_NEAR(position[2], 0.55, 0.03);
}

void TestPickers()
{
  View view(Size);
  const auto mapper = cslf::testing::MakeTestMapper();
  const auto actor = view.Add(mapper);
  LookAtSphere(view);
  view.Render();
  vtkNew<vtkPropPicker> picker;
  CSLF_CHECK(picker->Pick(Middle, Middle, 0.0, view.Renderer) != 0);
  CSLF_CHECK(picker->GetActor() == actor);
  CheckPosition(picker->GetPickPosition());
  vtkNew<vtkWorldPointPicker> points;
  points->Pick(Middle, Middle, 0.0, view.Renderer);
  CheckPosition(points->GetPickPosition());
  // Beside the field's surfaces, but within its cube.
  CSLF_CHECK(picker->Pick(2, Middle, 0.0, view.Renderer) == 0);

  // Parts removed by a clipping plane are not picked: the other side of the plane belongs to the
  // wall.
  vtkNew<vtkPlane> plane;
  plane->SetNormal(0.0, 0.0, -1.0);
  mapper->AddClippingPlane(plane);
  view.Render();
  CSLF_CHECK(picker->Pick(Middle, Middle, 0.0, view.Renderer) == 0);
}

// The ids that an area selects.
std::set<vtkIdType> Select(
  View& view, vtkActor* actor, unsigned int x, unsigned int y, int association)
{
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(view.Renderer);
  selector->SetFieldAssociation(association);
  selector->SetArea(x, y, x + 1, y + 1);
  const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  std::set<vtkIdType> cells;
  for (unsigned int i = 0; i < selection->GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode* node = selection->GetNode(i);
    CSLF_CHECK(node->GetProperties()->Get(vtkSelectionNode::PROP()) == actor);
    auto* ids = vtkIdTypeArray::SafeDownCast(node->GetSelectionList());
    for (vtkIdType k = 0; ids && k < ids->GetNumberOfTuples(); ++k)
    {
      cells.insert(ids->GetValue(k));
    }
  }
  return cells;
}

std::set<vtkIdType> SelectCells(View& view, vtkActor* actor, unsigned int x, unsigned int y)
{
  return Select(view, actor, x, y, vtkDataObject::FIELD_ASSOCIATION_CELLS);
}

// A field has no points to select, but selections of points find the actor, too.
void TestPoints()
{
  View view(Size);
  const auto actor = view.Add(cslf::testing::MakeTestMapper());
  LookAtSphere(view);
  view.Render();
  const auto points = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  CSLF_CHECK(!Select(view, actor, Middle, Middle, points).empty());
  CSLF_CHECK(Select(view, actor, 1, Middle, points).empty());
}

void TestCells()
{
  View view(Size);
  const auto actor = view.Add(cslf::testing::MakeTestMapper());
  LookAtSphere(view);
  view.Render();
  const std::set<vtkIdType> front{ 4 };
  CSLF_CHECK(SelectCells(view, actor, Middle, Middle) == front);
  CSLF_CHECK(SelectCells(view, actor, 1, Middle).empty());
  actor->GetProperty()->SetRepresentationToWireframe();
  actor->GetProperty()->EdgeVisibilityOn();
  CSLF_CHECK(SelectCells(view, actor, Middle, Middle) == front);
  // From the right, and turned to the left.
  view.GetCamera()->SetPosition(6.0, 0.15, 0.1);
  view.GetCamera()->SetFocalPoint(0.0, 0.15, 0.1);
  CSLF_CHECK(SelectCells(view, actor, Middle, Middle) == std::set<vtkIdType>{ 0 });
  actor->RotateY(180.0);
  view.GetCamera()->SetPosition(6.0, 0.15, -0.1);
  view.GetCamera()->SetFocalPoint(0.0, 0.15, -0.1);
  CSLF_CHECK(SelectCells(view, actor, Middle, Middle) == std::set<vtkIdType>{ 1 });
}
}

int TestCSLFMapperSelection(int, char*[])
{
  TestPickers();
  TestCells();
  TestPoints();
  return cslf::testing::Result();
}
