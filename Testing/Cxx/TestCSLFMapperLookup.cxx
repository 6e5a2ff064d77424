// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Compares every lookup of the mapper's shaders with the C++ version, pixel by pixel: perspective
// and parallel cameras, an actor with a rotation and a non-uniform scale, key views, and a field
// without depth.
#include "Coding/Geometry/cslfGeometryRays.h"
#include "Lookup/cslfLookup.h"
#include "cslfFocus.h"
#include "cslfTestField.h"
#include "cslfTesting.h"
#include "vtkCSLFMapper.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace
{
constexpr int Size = 120;
using FocalPoints = std::array<glm::dvec3, cslf::FaceCount>;

glm::dvec3 Transform(vtkMatrix4x4* matrix, double x, double y, double z)
{
  const double in[4] = { x, y, z, 1.0 };
  double out[4];
  matrix->MultiplyPoint(in, out);
  return { out[0] / out[3], out[1] / out[3], out[2] / out[3] };
}

struct Fixture
{
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkCSLFMapper> Mapper;
  vtkNew<vtkActor> Actor;
  std::optional<cslf::GeometryRays> Surfaces;
  int SeenFaces = 0; ///< one bit each

  Fixture()
  {
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(Size, Size);
    this->Window->AddRenderer(this->Renderer);
    this->Mapper->SetPixelSamples(1);
    this->Actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(this->Actor);
    this->Renderer->SetBackground(0.0, 0.0, 0.0);
  }

  /// From normalised display coordinates to the field's cube space.
  void GetDisplayToCube(const cslf::Cube& box, vtkMatrix4x4* matrix)
  {
    vtkMatrix4x4::Multiply4x4(
      this->Renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(1.0, -1.0, 1.0),
      this->Actor->GetMatrix(), matrix);
    vtkNew<vtkMatrix4x4> cube;
    for (int axis = 0; axis < 3; ++axis)
    {
      cube->SetElement(axis, axis, 0.5 * box.Edges[axis]);
      cube->SetElement(axis, 3, box.Center[axis]);
    }
    vtkMatrix4x4::Multiply4x4(matrix, cube, matrix);
    matrix->Invert();
  }

  /// The faces through which lines of sight enter, one bit each.
  int FindSeenFaces(const cslf::Cube& box)
  {
    vtkNew<vtkMatrix4x4> displayToCube;
    this->GetDisplayToCube(box, displayToCube);
    int faces = 0;
    for (double x = -0.9; x < 1.0; x += 0.05)
    {
      for (double y = -0.9; y < 1.0; y += 0.05)
      {
        const glm::dvec3 from = Transform(displayToCube, x, y, -1.0);
        const auto ray = cslf::RayToCoordinates(from, Transform(displayToCube, x, y, 1.0) - from);
        faces |= ray ? 1 << ray->Entry.Face : 0;
      }
    }
    return faces;
  }

  void Compare(const char* what, const cslf::Description& field, vtkImageData* image)
  {
    this->Compare(what, field, image, cslf::testing::MakeTestSurfaces(field.Box));
  }

  void Compare(
    const char* what, const cslf::Description& field, vtkImageData* image, vtkPolyData* geometry)
  {
    this->Mapper->SetInputData(image);
    this->Mapper->SetGeometryData(geometry);
    this->Surfaces.emplace(geometry, field);
    this->SeenFaces = this->FindSeenFaces(field.Box);
    this->Renderer->ResetCamera();
    cslf::Lookup lookup(field, image);
    lookup.LeaveOut(this->SeenFaces);
    lookup.SetSurfaces(this->Surfaces->GetCells());
    const cslf::ChannelReader colors(field.Grid, image->GetPointData()->GetArray(cslf::ColorName));
    const FocalPoints focalPoints = cslf::FindFocalPoints(field, image);
    for (int mode = vtkCSLFMapper::NEAREST; mode < vtkCSLFMapper::NUMBER_OF_LOOKUPS; ++mode)
    {
      this->Mapper->SetLookup(mode);
      this->Window->Render();
      vtkNew<vtkUnsignedCharArray> pixels;
      this->Window->GetPixelData(0, 0, Size - 1, Size - 1, 0, pixels);
      vtkNew<vtkMatrix4x4> displayToCube;
      this->GetDisplayToCube(field.Box, displayToCube);
      double sum = 0.0;
      int count = 0;
      int lit = 0;
      int different = 0;
      for (int y = 0; y < Size; ++y)
      {
        for (int x = 0; x < Size; ++x)
        {
          const double dx = 2.0 * (x + 0.5) / Size - 1.0;
          const double dy = 2.0 * (y + 0.5) / Size - 1.0;
          const glm::dvec3 from = Transform(displayToCube, dx, dy, -1.0);
          const auto ray =
            cslf::RayToCoordinates(from, Transform(displayToCube, dx, dy, 1.0) - from);
          if (!ray)
          {
            continue;
          }
          const glm::dvec4 color = mode == vtkCSLFMapper::GEOMETRY
            ? this->BlendOnSurface(lookup, colors, *ray)
            : colors.Blend(this->LookUp(lookup, mode, *ray, focalPoints));
          double most = 0.0;
          double squares = 0.0;
          for (int c = 0; c < 3; ++c)
          {
            const double difference = pixels->GetComponent(y * Size + x, c) - 255.0 * color[c];
            squares += difference * difference;
            most = std::max(most, std::abs(difference));
          }
          ++count;
          lit += color.w > 0.0;
          different += most > 8.0;
          sum += most > 8.0 ? 0.0 : squares;
        }
      }
      const double psnr =
        10.0 * std::log10(255.0 * 255.0 * 3.0 * (count - different) / (sum + 1e-9));
      std::cout << what << ", " << this->Mapper->GetLookupAsString() << ": " << psnr << " dB, "
                << different << " of " << count << " pixels differ\n";
      CSLF_CHECK(lit > 500);
      // Rounding can send a ray on an edge either way, and a guess can be confirmed where the
      // search finds another surface first. All other pixels agree.
      CSLF_CHECK(psnr > 50.0);
      CSLF_CHECK(different < 0.01 * count);
    }
  }

  /// The surface that a ray meets in the cube, and what views see there. Elsewhere, and where none
  /// sees it, what the depth lookup finds.
  glm::dvec4 BlendOnSurface(
    const cslf::Lookup& lookup, const cslf::ChannelReader& colors, const cslf::RayCoordinates& ray)
  {
    const bool isOpaque = this->Surfaces->GetCells() != nullptr;
    const auto hit = this->Surfaces->Intersect(ray);
    if (!hit)
    {
      return colors.Blend(isOpaque ? lookup.OffSurface(ray) : lookup.DepthCorrected(ray));
    }
    cslf::LookupResult before;
    if (isOpaque && (before = lookup.InFront(ray, hit->Point)).IsFinal)
    {
      return colors.Blend(before);
    }
    if (hit->IsExact)
    {
      return hit->Color;
    }
    const glm::dvec4 color = colors.Blend(lookup.OnSurface(ray, hit->Point, this->SeenFaces));
    if (isOpaque && color.w <= 0.0 && (before = lookup.CloseInFront(ray, hit->Point)).IsFinal)
    {
      return colors.Blend(before);
    }
    return color.w > 0.0 ? color : colors.Blend(lookup.DepthCorrected(ray));
  }

  static cslf::LookupResult LookUp(const cslf::Lookup& lookup, int mode,
    const cslf::RayCoordinates& ray, const FocalPoints& focalPoints)
  {
    switch (mode)
    {
      case vtkCSLFMapper::NEAREST:
        return lookup.Nearest(ray);
      case vtkCSLFMapper::LINEAR:
        return lookup.Linear(ray);
      case vtkCSLFMapper::BILINEAR:
        return lookup.Bilinear(ray);
      case vtkCSLFMapper::FOCAL:
        return lookup.Focal(ray, focalPoints[ray.Entry.Face]);
      case vtkCSLFMapper::DEPTH:
        return lookup.DepthCorrected(ray);
      default:
        CSLF_CHECK(false); // a lookup without its C++ function
        return {};
    }
  }
};

cslf::Description Describe(vtkImageData* image)
{
  std::string error;
  const auto field = cslf::Description::ReadFrom(image, error);
  CSLF_CHECK(field.has_value());
  return field.value_or(cslf::Description());
}
}

int TestCSLFMapperLookup(int, char*[])
{
  const cslf::Cube box{ { 10.0, -3.0, 2.0 }, { 4.0, 3.0, 5.0 } };
  Fixture fixture;
  vtkCamera* camera = fixture.Renderer->GetActiveCamera();
  camera->SetPosition(14.0, 1.0, 12.0);
  camera->SetFocalPoint(10.0, -3.0, 2.0);

  const auto whole =
    cslf::testing::MakeTestField(cslf::Layout(5, 32), box, VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT);
  fixture.Compare("perspective", Describe(whole), whole);

  // The wall, in front of which the sphere is looked up by depth.
  const auto surfaces = cslf::testing::MakeTestSurfaces(box);
  vtkNew<vtkCellArray> last;
  last->InsertNextCell(surfaces->GetCell(surfaces->GetNumberOfCells() - 1));
  vtkNew<vtkPolyData> wall;
  wall->SetPoints(surfaces->GetPoints());
  wall->SetPolys(last);
  vtkNew<vtkDoubleArray> loss;
  loss->SetName(cslf::GeometryOpaqueLossName);
  loss->InsertNextValue(0.0);
  wall->GetFieldData()->AddArray(loss);
  fixture.Compare("opaque wall", Describe(whole), whole, wall);

  camera->ParallelProjectionOn();
  fixture.Compare("parallel", Describe(whole), whole);
  camera->ParallelProjectionOff();

  const auto keyViews = cslf::testing::MakeTestField(
    cslf::Layout(10, { 0, 2, 7, 9 }, 33), box, VTK_UNSIGNED_CHAR, VTK_FLOAT);
  fixture.Compare("key views", Describe(keyViews), keyViews);

  const auto flat = cslf::testing::MakeTestField(cslf::Layout(4, 32), box, VTK_UNSIGNED_CHAR, 0);
  fixture.Compare("without depth", Describe(flat), flat);

  fixture.Actor->RotateWXYZ(40.0, 1.0, 2.0, 0.5);
  fixture.Actor->SetScale(1.0, 2.0, 0.5);
  fixture.Compare("transformed", Describe(whole), whole);
  return cslf::testing::Result();
}
