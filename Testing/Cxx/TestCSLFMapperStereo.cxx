// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A field that is cut by a plane, among other actors, for both eyes. The left half is for the left
// eye.
#include "cslfTestImage.h"
#include "cslfTestMixedScene.h"
#include "cslfTestView.h"
#include "cslfTesting.h"

#include <vtkPlane.h>

int TestCSLFMapperStereo(int argc, char* argv[])
{
  cslf::testing::View view;
  view.Window->SetSize(600, 300);
  const auto mapper = cslf::testing::MakeTestMapper();
  cslf::testing::AddMixedScene(view.Renderer, mapper);
  vtkNew<vtkPlane> plane;
  plane->SetNormal(-0.8, -0.6, 0.0);
  plane->SetOrigin(0.35, 0.15, 0.1);
  mapper->AddClippingPlane(plane);
  view.GetCamera()->SetEyeAngle(6.0);
  view.Window->SetStereoTypeToSplitViewportHorizontal();
  view.Window->StereoRenderOn();
  CSLF_CHECK(cslf::testing::MatchesBaseline(argc, argv, view.Window));
  return cslf::testing::Result();
}
