// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The appearance of a field among other actors.
#include "cslfTestImage.h"
#include "cslfTestMixedScene.h"
#include "cslfTestView.h"
#include "cslfTesting.h"

int TestCSLFMapperMixed(int argc, char* argv[])
{
  cslf::testing::View view(300);
  cslf::testing::AddMixedScene(view.Renderer, cslf::testing::MakeTestMapper());
  CSLF_CHECK(cslf::testing::MatchesBaseline(argc, argv, view.Window));
  return cslf::testing::Result();
}
