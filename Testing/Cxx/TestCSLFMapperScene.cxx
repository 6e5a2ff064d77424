// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The field among other things: a second field, clipping planes, opacity and translucent actors
// with and without depth peeling, ambient occlusion and shadows, and a property whose settings have
// no meaning.
#include "cslfTestView.h"
#include "cslfTesting.h"

#include <vtkAssembly.h>
#include <vtkCameraPass.h>
#include <vtkFrustumCoverageCuller.h>
#include <vtkLight.h>
#include <vtkOpenGLRenderer.h>
#include <vtkPlane.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderPassCollection.h>
#include <vtkSequencePass.h>
#include <vtkShadowMapBakerPass.h>
#include <vtkShadowMapPass.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace
{
using cslf::testing::ComparePictures;
using cslf::testing::Picture;
using cslf::testing::View;

// A square across the view at a z, with emission only.
vtkSmartPointer<vtkActor> AddSheet(View& view, double z, double half, double opacity)
{
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(-half, -half, z);
  source->SetPoint1(half, -half, z);
  source->SetPoint2(-half, half, z);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  auto actor = view.Add(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(1.0, 0.0, 0.0);
  actor->GetProperty()->SetOpacity(opacity);
  return actor;
}

// Two overlapping fields: each pixel shows the nearer of the two.
void TestTwoFields()
{
  View view;
  const auto first = view.Add(cslf::testing::MakeTestMapper());
  const auto second = view.Add(cslf::testing::MakeTestMapper());
  second->SetPosition(-0.5, 0.2, 0.1);
  second->RotateY(40.0);
  const Picture both = view.Render();
  second->VisibilityOff();
  const Picture one = view.Render();
  second->VisibilityOn();
  first->VisibilityOff();
  const Picture other = view.Render();
  int wrong = 0;
  int fromBoth[2] = { 0, 0 };
  for (std::size_t pixel = 0; pixel < both.Depths.size(); ++pixel)
  {
    const bool isOther = other.Depths[pixel] < one.Depths[pixel];
    const Picture& nearer = isOther ? other : one;
    if (nearer.Depths[pixel] < 1.0)
    {
      ++fromBoth[isOther];
      wrong += both.Depths[pixel] != nearer.Depths[pixel];
    }
  }
  std::cout << "two fields: " << fromBoth[0] << " and " << fromBoth[1] << " pixels, " << wrong
            << " wrong\n";
  CSLF_CHECK(wrong == 0);
  CSLF_CHECK(fromBoth[0] > 1000 && fromBoth[1] > 1000);
}

// Partly covered pixels are drawn at once if the field is the last prop and the others are opaque.
// Neither this nor the order of the props changes the picture.
void TestSilhouettes()
{
  View last;
  AddSheet(last, -2.5, 4.0, 1.0);
  const auto outside = AddSheet(last, -20.0, 0.1, 0.5);
  outside->SetPosition(30.0, 0.0, 0.0);
  outside->VisibilityOff();
  vtkNew<vtkAssembly> assembly;
  assembly->VisibilityOff();
  last.Renderer->AddViewProp(assembly);
  const auto lastMapper = cslf::testing::MakeTestMapper();
  const auto field = last.Add(lastMapper);
  const Picture expected = last.Render();
  CSLF_CHECK(!lastMapper->HasTranslucentPolygonalGeometry());
  const auto check = [&](const char* what, const Picture& picture)
  {
    CSLF_CHECK(picture.Depths == expected.Depths);
    const double same = ComparePictures(picture, expected);
    std::cout << what << ": " << same << " dB\n";
    CSLF_CHECK(same > 50.0);
  };

  View first;
  const auto firstMapper = cslf::testing::MakeTestMapper();
  first.Add(firstMapper);
  AddSheet(first, -2.5, 4.0, 1.0);
  check("before an opaque actor", first.Render());
  CSLF_CHECK(firstMapper->HasTranslucentPolygonalGeometry());

  outside->VisibilityOn();
  check("with a translucent actor", last.Render());
  CSLF_CHECK(lastMapper->HasTranslucentPolygonalGeometry());
  outside->VisibilityOff();
  check("with a hidden one", last.Render());
  CSLF_CHECK(!lastMapper->HasTranslucentPolygonalGeometry());
  assembly->VisibilityOn();
  check("with an assembly", last.Render());
  CSLF_CHECK(lastMapper->HasTranslucentPolygonalGeometry());
  assembly->VisibilityOff();

  // Other orders of drawing than that of the props.
  last.Renderer->UseHiddenLineRemovalOn();
  last.Render();
  CSLF_CHECK(lastMapper->HasTranslucentPolygonalGeometry());
  last.Renderer->UseHiddenLineRemovalOff();
  vtkNew<vtkFrustumCoverageCuller> culler;
  culler->SetSortingStyleToFrontToBack();
  last.Renderer->AddCuller(culler);
  check("front to back", last.Render());
  CSLF_CHECK(lastMapper->HasTranslucentPolygonalGeometry());
  last.Renderer->RemoveCuller(culler);
  check("with nothing of these", last.Render());
  CSLF_CHECK(!lastMapper->HasTranslucentPolygonalGeometry());

  // A translucent field is drawn once.
  field->GetProperty()->SetOpacity(0.5);
  CSLF_CHECK(field->HasTranslucentPolygonalGeometry());
  CSLF_CHECK(last.Render().Depths != expected.Depths);
}

// The visible part lies on the positive side of the plane, and does not change.
void TestClippingPlanes()
{
  View view;
  const auto mapper = cslf::testing::MakeTestMapper();
  const auto actor = view.Add(mapper);
  actor->SetPosition(0.1, 0.0, 0.0);
  actor->RotateZ(15.0);
  view.GetCamera()->ParallelProjectionOn();
  view.GetCamera()->SetParallelScale(1.5);
  view.GetCamera()->SetPosition(0.0, 0.0, 5.0);
  const Picture whole = view.Render();
  vtkNew<vtkPlane> plane;
  plane->SetNormal(1.0, 0.0, 0.0);
  plane->SetOrigin(0.25, 0.0, 0.0);
  mapper->AddClippingPlane(plane);
  const auto check = [&](const Picture& cut, auto isKept)
  {
    int wrong = 0;
    for (std::size_t pixel = 0; pixel < cut.Depths.size(); ++pixel)
    {
      const double x = 3.0 * (pixel % cut.Width + 0.5) / cut.Width - 1.5;
      const double z = 5.0 - (1.0 + 11.0 * whole.Depths[pixel]);
      const double expected = isKept(x, z) ? whole.Depths[pixel] : 1.0;
      wrong += std::abs(cut.Depths[pixel] - expected) > 1e-5;
    }
    return wrong;
  };
  CSLF_CHECK(check(view.Render(), [](double x, double) { return x >= 0.25; }) == 0);
  vtkNew<vtkPlane> back;
  back->SetNormal(0.0, 0.0, 1.0);
  back->SetOrigin(0.0, 0.0, 0.3);
  mapper->AddClippingPlane(back);
  CSLF_CHECK(check(view.Render(), [](double x, double z) { return x >= 0.25 && z >= 0.3; }) == 0);
  mapper->RemoveAllClippingPlanes();
  CSLF_CHECK(ComparePictures(view.Render(), whole) == 99.0);
}

void CheckBlend(const char* what, const Picture& picture, const Picture& front, double opacity,
  const Picture& back)
{
  Picture blended = picture;
  for (std::size_t i = 0; i < blended.Colors.size(); ++i)
  {
    blended.Colors[i] = static_cast<unsigned char>(
      std::lround(opacity * front.Colors[i] + (1.0 - opacity) * back.Colors[i]));
  }
  std::cout << what << ": " << ComparePictures(picture, blended) << " dB\n";
  CSLF_CHECK(ComparePictures(picture, blended) > 35.0);
}

// A sheet in front of the field, and one behind a field that is translucent itself.
void TestBlending(bool peeling)
{
  View view;
  view.Renderer->SetUseDepthPeeling(peeling);
  view.Renderer->SetMaximumNumberOfPeels(8);
  view.Renderer->SetOcclusionRatio(0.0);
  const auto field = view.Add(cslf::testing::MakeTestMapper());
  const auto sheet = AddSheet(view, 0.8, 3.0, 1.0);
  const Picture red = view.Render();
  sheet->VisibilityOff();
  const Picture alone = view.Render();

  sheet->VisibilityOn();
  sheet->GetProperty()->SetOpacity(0.4);
  CheckBlend(peeling ? "sheet before, peeled" : "sheet before", view.Render(), red, 0.4, alone);

  // The field is blended over the sheet; elsewhere the sheet does not change.
  sheet->SetPosition(0.0, 0.0, -2.0);
  sheet->GetProperty()->SetOpacity(1.0);
  const Picture over = view.Render();
  field->GetProperty()->SetOpacity(0.5);
  CheckBlend(
    peeling ? "field over sheet, peeled" : "field over sheet", view.Render(), over, 0.5, red);

  // Two translucent ones, with the field in front: only peeling always sorts them.
  if (peeling)
  {
    sheet->GetProperty()->SetOpacity(0.5);
    Picture half = red;
    for (unsigned char& value : half.Colors)
    {
      value /= 2;
    }
    field->GetProperty()->SetOpacity(0.999);
    const Picture nearlyOpaque = view.Render();
    field->GetProperty()->SetOpacity(0.5);
    CheckBlend("field over translucent sheet, peeled", view.Render(), nearlyOpaque, 0.5, half);
  }
}

void TestForced()
{
  View view;
  const auto field = view.Add(cslf::testing::MakeTestMapper());
  const Picture free = view.Render();
  field->ForceTranslucentOn();
  CSLF_CHECK(ComparePictures(view.Render(), free) > 45.0);
  field->ForceTranslucentOff();
  field->ForceOpaqueOn();
  CSLF_CHECK(ComparePictures(view.Render(), free) > 45.0);
}

void TestProperty()
{
  View view;
  const auto field = view.Add(cslf::testing::MakeTestMapper());
  const Picture plain = view.Render();
  vtkProperty* property = field->GetProperty();
  property->SetColor(1.0, 0.0, 0.0);
  property->SetAmbient(0.5);
  property->SetSpecular(1.0);
  property->EdgeVisibilityOn();
  property->VertexVisibilityOn();
  property->FrontfaceCullingOn();
  property->BackfaceCullingOn();
  property->SetInterpolationToPBR();
  property->SetLineWidth(3.0);
  field->SetBackfaceProperty(property);
  CSLF_CHECK(ComparePictures(view.Render(), plain) == 99.0);
  property->SetRepresentationToWireframe();
  CSLF_CHECK(ComparePictures(view.Render(), plain) == 99.0);
  property->SetRepresentationToPoints();
  CSLF_CHECK(ComparePictures(view.Render(), plain) == 99.0);
}

// Ambient occlusion darkens the field's creases about as it darkens those of its surfaces.
void TestAmbientOcclusion()
{
  View view;
  const auto field = view.Add(cslf::testing::MakeTestMapper());
  const auto surfaces = view.Add(cslf::testing::MakeSurfaceMapper());
  surfaces->GetProperty()->SetAmbient(1.0);
  surfaces->GetProperty()->SetDiffuse(0.0);
  const auto darken = [&](vtkActor* shown)
  {
    field->SetVisibility(shown == field);
    surfaces->SetVisibility(shown == surfaces);
    view.Renderer->UseSSAOOff();
    const double before = view.Render().GetMean();
    view.Renderer->UseSSAOOn();
    view.Renderer->SetSSAORadius(0.8);
    view.Renderer->SetSSAOKernelSize(64);
    view.Renderer->SetSSAOBias(0.05);
    return view.Render().GetMean() / before;
  };
  const double fieldLeft = darken(field);
  const double surfacesLeft = darken(surfaces);
  std::cout << "ambient occlusion leaves " << fieldLeft << " of the field, " << surfacesLeft
            << " of its surfaces\n";
  CSLF_CHECK(fieldLeft < 0.98);
  CSLF_CHECK_NEAR(fieldLeft, surfacesLeft, 0.06);
}

// The shadow on a wall behind is that of the surfaces; the field's own picture does not change.
void TestShadows()
{
  View view;
  const auto field = view.Add(cslf::testing::MakeTestMapper());
  const auto surfaces = view.Add(cslf::testing::MakeSurfaceMapper());
  const auto wall = AddSheet(view, -1.5, 3.0, 1.0);
  wall->GetProperty()->LightingOn();
  view.GetCamera()->SetClippingRange(1.0, 20.0);
  vtkNew<vtkLight> light;
  light->SetPosition(-4.0, 2.0, 6.0);
  light->SetFocalPoint(0.0, 0.0, -1.0);
  light->SetPositional(1);
  light->SetConeAngle(25.0);
  view.Renderer->AddLight(light);
  field->VisibilityOff();
  surfaces->VisibilityOff();
  const Picture bare = view.Render();
  field->VisibilityOn();
  const Picture unshadowed = view.Render();

  vtkNew<vtkShadowMapPass> shadows;
  vtkNew<vtkSequencePass> sequence;
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(shadows->GetShadowMapBakerPass());
  passes->AddItem(shadows);
  sequence->SetPasses(passes);
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(sequence);
  vtkOpenGLRenderer::SafeDownCast(view.Renderer)->SetPass(camera);

  const Picture fieldPicture = view.Render();
  field->VisibilityOff();
  surfaces->VisibilityOn();
  const Picture surfacesPicture = view.Render();
  int fieldShadow = 0;
  int surfacesShadow = 0;
  int bothShadow = 0;
  int changed = 0;
  for (std::size_t pixel = 0; pixel < bare.Depths.size(); ++pixel)
  {
    const bool onWall = std::abs(fieldPicture.Depths[pixel] - bare.Depths[pixel]) < 1e-4 &&
      std::abs(surfacesPicture.Depths[pixel] - bare.Depths[pixel]) < 1e-4;
    const bool byField = fieldPicture.Colors[3 * pixel] + 40 < bare.Colors[3 * pixel];
    const bool bySurfaces = surfacesPicture.Colors[3 * pixel] + 40 < bare.Colors[3 * pixel];
    fieldShadow += onWall && byField;
    surfacesShadow += onWall && bySurfaces;
    bothShadow += onWall && byField && bySurfaces;
    for (int c = 0; c < 3 && fieldPicture.Depths[pixel] + 1e-4 < bare.Depths[pixel]; ++c)
    {
      changed += fieldPicture.Colors[3 * pixel + c] != unshadowed.Colors[3 * pixel + c];
    }
  }
  std::cout << "shadows: " << fieldShadow << " pixels of the field, " << surfacesShadow
            << " of its surfaces, " << bothShadow << " of both; " << changed << " values changed\n";
  CSLF_CHECK(surfacesShadow > 100);
  CSLF_CHECK(bothShadow > 0.85 * std::max(fieldShadow, surfacesShadow));
  CSLF_CHECK(changed < 300);
}
}

int TestCSLFMapperScene(int, char*[])
{
  TestTwoFields();
  TestSilhouettes();
  TestClippingPlanes();
  TestBlending(false);
  TestBlending(true);
  TestForced();
  TestProperty();
  TestAmbientOcclusion();
  TestShadows();
  return cslf::testing::Result();
}
