// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfProceduralScene.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>

#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace cslf
{
namespace
{
// Two planetary gears on a plate, in millimetres. Their axes are along Z.
constexpr double Module = 4.0; // of the gears: the diameter of the pitch circle for each tooth
const double Turn = glm::radians(360.0);

/// The corners of a plane figure, counterclockwise, as seen from its middle.
using Outline = std::vector<glm::dvec2>;

glm::dvec2 ToPoint(double radius, double angle)
{
  return { radius * std::cos(angle), radius * std::sin(angle) };
}

Outline MakeCircle(double radius, int corners)
{
  Outline outline;
  for (int i = 0; i < corners; ++i)
  {
    outline.push_back(ToPoint(radius, Turn * i / corners));
  }
  return outline;
}

Outline MakeRectangle(double width, double height)
{
  const double x = 0.5 * width;
  const double y = 0.5 * height;
  return { { x, -y }, { x, y }, { -x, y }, { -x, -y } };
}

/// Teeth of a module on a pitch circle, the first of which is at an angle.
Outline MakeGear(int teeth, double module, double angle, double outer, double inner)
{
  constexpr int steps = 4; // along each flank
  const double pitch = 0.5 * module * teeth;
  Outline outline;
  for (int tooth = 0; tooth < teeth; ++tooth)
  {
    for (int side : { -1, 1 })
    {
      for (int i = 0; i <= steps; ++i)
      {
        // Flanks are curved: wide at the root, narrow at the tip.
        const double height = static_cast<double>(side < 0 ? i : steps - i) / steps;
        const double radius = pitch + module * (height * (outer + inner) - inner);
        const double half = 0.36 - 0.16 * height - 0.07 * height * height;
        outline.push_back(ToPoint(radius, angle + Turn / teeth * (tooth + side * half)));
      }
    }
  }
  return outline;
}

/// A body of one material, tessellated as CAD programs do it: faces are fans, and thin triangles
/// between outlines of few and of many corners.
class Body
{
public:
  /// Adds what is between two outlines, or within the outer one, from a height to a higher one.
  void Add(
    const Outline& outer, const Outline& inner, const glm::dvec2& place, double bottom, double top)
  {
    const vtkIdType outerLow = this->AddLoop(outer, place, bottom);
    const vtkIdType outerHigh = this->AddLoop(outer, place, top);
    const auto corners = static_cast<vtkIdType>(outer.size());
    this->AddWall(outerLow, outerHigh, corners);
    if (inner.empty())
    {
      for (vtkIdType i = 1; i + 1 < corners; ++i)
      {
        this->AddTriangle(outerHigh, outerHigh + i, outerHigh + i + 1);
        this->AddTriangle(outerLow, outerLow + i + 1, outerLow + i);
      }
      return;
    }
    const vtkIdType innerLow = this->AddLoop(inner, place, bottom);
    const vtkIdType innerHigh = this->AddLoop(inner, place, top);
    this->AddWall(innerHigh, innerLow, static_cast<vtkIdType>(inner.size()));
    this->AddRing(outer, inner, outerLow, outerHigh, innerLow, innerHigh);
  }

  void Add(const Outline& outer, const glm::dvec2& place, double bottom, double top)
  {
    this->Add(outer, {}, place, bottom, top);
  }

  /// Adds the body to the renderer: a metal or a plastic.
  void Show(vtkRenderer* renderer, const glm::dvec3& color, double metallic, double roughness) const
  {
    vtkNew<vtkPolyData> data;
    data->SetPoints(this->Points);
    data->SetPolys(this->Triangles);
    vtkNew<vtkPolyDataNormals> normals; // smooth, except at edges
    normals->SetInputData(data);
    normals->SetFeatureAngle(35.0);
    normals->SplittingOn();
    normals->ConsistencyOff();
    normals->Update();
    vtkProperty* property = AddSurface(renderer, normals->GetOutput())->GetProperty();
    property->SetInterpolationToPBR();
    property->SetColor(color.x, color.y, color.z);
    property->SetMetallic(metallic);
    property->SetRoughness(roughness);
  }

private:
  vtkIdType AddLoop(const Outline& outline, const glm::dvec2& place, double height)
  {
    const vtkIdType first = this->Points->GetNumberOfPoints();
    for (const glm::dvec2& corner : outline)
    {
      this->Points->InsertNextPoint(place.x + corner.x, place.y + corner.y, height);
    }
    return first;
  }

  void AddTriangle(vtkIdType a, vtkIdType b, vtkIdType c)
  {
    this->Triangles->InsertNextCell({ a, b, c });
  }

  void AddWall(vtkIdType low, vtkIdType high, vtkIdType corners)
  {
    for (vtkIdType i = 0; i < corners; ++i)
    {
      const vtkIdType next = (i + 1) % corners;
      this->AddTriangle(low + i, low + next, high + next);
      this->AddTriangle(low + i, high + next, high + i);
    }
  }

  /// The faces between two outlines, whose next corner is always the one at the smaller angle.
  void AddRing(const Outline& outer, const Outline& inner, vtkIdType outerLow, vtkIdType outerHigh,
    vtkIdType innerLow, vtkIdType innerHigh)
  {
    const auto outerCorners = static_cast<vtkIdType>(outer.size());
    const auto innerCorners = static_cast<vtkIdType>(inner.size());
    const vtkIdType begin = FindNearest(inner, outer[0]);
    vtkIdType i = 0;
    vtkIdType k = 0;
    while (i < outerCorners || k < innerCorners)
    {
      const vtkIdType a = i % outerCorners;
      const vtkIdType b = (begin + k) % innerCorners;
      const vtkIdType nextA = (i + 1) % outerCorners;
      const vtkIdType nextB = (begin + k + 1) % innerCorners;
      const bool advancesOuter = k == innerCorners ||
        (i < outerCorners &&
          GetAngle(outer[0], outer[nextA], i + 1 == outerCorners) <
            GetAngle(outer[0], inner[nextB], k + 1 == innerCorners));
      if (advancesOuter)
      {
        this->AddTriangle(outerHigh + a, outerHigh + nextA, innerHigh + b);
        this->AddTriangle(outerLow + nextA, outerLow + a, innerLow + b);
        ++i;
      }
      else
      {
        this->AddTriangle(innerHigh + nextB, innerHigh + b, outerHigh + a);
        this->AddTriangle(innerLow + b, innerLow + nextB, outerLow + a);
        ++k;
      }
    }
  }

  /// The angle from one corner to another, in [0, 2 pi]; that of a last corner is above pi.
  static double GetAngle(const glm::dvec2& from, const glm::dvec2& to, bool isLast)
  {
    const double angle = std::atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y);
    return angle < 0.0 || (isLast && angle < 0.5 * Turn) ? angle + Turn : angle;
  }

  static vtkIdType FindNearest(const Outline& outline, const glm::dvec2& corner)
  {
    vtkIdType nearest = 0;
    double least = Turn;
    for (std::size_t i = 0; i < outline.size(); ++i)
    {
      const double angle = GetAngle(corner, outline[i], false);
      if (angle < least)
      {
        least = angle;
        nearest = static_cast<vtkIdType>(i);
      }
    }
    return nearest;
  }

  vtkNew<vtkPoints> Points;
  vtkNew<vtkCellArray> Triangles;
};

struct Materials
{
  Body Steel;
  Body Brass;
  Body Aluminium;
  Body RedPlastic;
  Body BlackPlastic;
};

/// A bolt with a washer, whose head is on a face at a height.
void AddBolt(Materials& materials, const glm::dvec2& place, double height, double size)
{
  materials.RedPlastic.Add(
    MakeCircle(1.1 * size, 40), MakeCircle(0.55 * size, 28), place, height, height + 0.2 * size);
  materials.Steel.Add(MakeCircle(0.9 * size, 6), place, height + 0.2 * size, height + 0.9 * size);
  materials.Steel.Add(MakeCircle(0.5 * size, 36), place, height - 1.6 * size, height + 1.1 * size);
}

/// Two rings, and rollers between them.
void AddBearing(Materials& materials, const glm::dvec2& place, double inner, double outer,
  double bottom, double top)
{
  constexpr int rollers = 10;
  const double ring = 0.2 * (outer - inner);
  const double roller = 0.5 * (outer - inner) - ring;
  materials.Steel.Add(MakeCircle(outer, 72), MakeCircle(outer - ring, 72), place, bottom, top);
  materials.Steel.Add(MakeCircle(inner + ring, 48), MakeCircle(inner, 48), place, bottom, top);
  for (int i = 0; i < rollers; ++i)
  {
    materials.Steel.Add(MakeCircle(roller, 24),
      place + ToPoint(0.5 * (inner + outer), Turn * i / rollers), bottom + 0.5, top - 0.5);
  }
}

/// A sun, planets around it, and a ring, whose teeth mesh.
void AddPlanetaryGear(Materials& materials, Body& planetBody, const glm::dvec2& place, int sun,
  int planet, double module)
{
  constexpr int planets = 4;
  const int ring = sun + 2 * planet;
  const double distance = 0.5 * module * (sun + planet);
  const double outside = 0.5 * module * ring + 4.5 * module;

  // The housing: a square plate with a round hole, and the ring with its bolts.
  materials.Aluminium.Add(MakeRectangle(2.0 * outside + 16.0, 2.0 * outside + 16.0),
    MakeCircle(0.5 * module * sun, 96), place, -8.0, 0.0);
  materials.Aluminium.Add(MakeCircle(outside, 160),
    MakeGear(ring, module, 0.5 * Turn / ring, 1.15, 0.9), place, 0.0, 22.0);
  for (int i = 0; i < 12; ++i)
  {
    AddBolt(
      materials, place + ToPoint(outside - 1.4 * module, Turn * (i + 0.5) / 12), 22.0, module);
  }
  for (const glm::dvec2& corner : MakeRectangle(2.0 * outside, 2.0 * outside))
  {
    AddBolt(materials, place + corner, 0.0, 1.4 * module);
  }

  // The sun on its shaft, with a knob.
  materials.Steel.Add(
    MakeGear(sun, module, 0.0, 0.9, 1.15), MakeCircle(0.25 * module * sun, 64), place, 4.0, 20.0);
  materials.Steel.Add(MakeCircle(0.25 * module * sun, 64), place, -20.0, 44.0);
  materials.BlackPlastic.Add(MakeGear(40, 0.02 * module * sun, 0.0, 0.6, 0.6),
    MakeCircle(0.25 * module * sun, 64), place, 30.0, 42.0);

  for (int i = 0; i < planets; ++i)
  {
    const double angle = Turn * i / planets;
    const glm::dvec2 center = place + ToPoint(distance, angle);
    const double bore = 0.3 * module * planet;
    planetBody.Add(MakeGear(planet, module, angle + 0.5 * Turn + 0.5 * Turn / planet, 0.9, 1.15),
      MakeCircle(bore, 72), center, 4.0, 20.0);
    AddBearing(materials, center, 0.5 * bore, bore, 5.0, 19.0);
    materials.Steel.Add(MakeCircle(0.5 * bore, 48), center, 0.0, 26.0);
  }
}
}

void AddAssembly(vtkRenderer* renderer)
{
  Materials materials;
  AddPlanetaryGear(materials, materials.Brass, { -150.0, 0.0 }, 24, 18, Module);
  AddPlanetaryGear(materials, materials.RedPlastic, { 110.0, 0.0 }, 20, 16, 0.75 * Module);
  materials.Steel.Show(renderer, { 0.56, 0.57, 0.58 }, 1.0, 0.25);
  materials.Brass.Show(renderer, { 0.89, 0.72, 0.36 }, 1.0, 0.3);
  materials.Aluminium.Show(renderer, { 0.80, 0.81, 0.82 }, 1.0, 0.5);
  materials.RedPlastic.Show(renderer, { 0.60, 0.06, 0.05 }, 0.0, 0.35);
  materials.BlackPlastic.Show(renderer, { 0.03, 0.03, 0.035 }, 0.0, 0.4);
}
}
