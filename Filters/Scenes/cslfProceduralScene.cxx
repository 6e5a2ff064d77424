// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfProceduralScene.h"

#include <array>
#include <cstddef>
#include <vector>

#include <vtkActor.h>
#include <vtkColorTransferFunction.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>

namespace cslf
{
namespace
{
/// Colours at equal distances.
vtkSmartPointer<vtkColorTransferFunction> MakeColors(
  double lowest, double highest, const std::vector<std::array<double, 3>>& colors)
{
  auto function = vtkSmartPointer<vtkColorTransferFunction>::New();
  for (std::size_t i = 0; i < colors.size(); ++i)
  {
    const double part = static_cast<double>(i) / static_cast<double>(colors.size() - 1);
    const auto& [red, green, blue] = colors[i];
    function->AddRGBPoint(lowest + part * (highest - lowest), red, green, blue);
  }
  return function;
}
}

vtkActor* AddActor(vtkRenderer* renderer, vtkMapper* mapper)
{
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  return actor;
}

vtkActor* AddSurface(vtkRenderer* renderer, vtkPolyData* data)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
  return AddActor(renderer, mapper);
}

vtkActor* AddSurface(vtkRenderer* renderer, vtkPolyData* data, vtkScalarsToColors* colors)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetLookupTable(colors);
  mapper->UseLookupTableScalarRangeOn();
  mapper->InterpolateScalarsBeforeMappingOn();
  return AddActor(renderer, mapper);
}

vtkSmartPointer<vtkScalarsToColors> MakeCoolToWarm(double lowest, double highest)
{
  const auto colors = MakeColors(
    lowest, highest, { { 0.231, 0.298, 0.753 }, { 0.865, 0.865, 0.865 }, { 0.706, 0.016, 0.149 } });
  colors->SetColorSpaceToDiverging();
  return colors;
}

vtkSmartPointer<vtkScalarsToColors> MakeViridis(double lowest, double highest)
{
  const auto colors = MakeColors(lowest, highest,
    { { 0.267, 0.005, 0.329 }, { 0.230, 0.322, 0.546 }, { 0.128, 0.567, 0.551 },
      { 0.369, 0.789, 0.383 }, { 0.993, 0.906, 0.144 } });
  colors->SetColorSpaceToLab();
  return colors;
}

vtkSmartPointer<vtkScalarsToColors> MakeLandColors(double lowest, double highest)
{
  return MakeColors(lowest, highest,
    { { 0.35, 0.50, 0.25 }, { 0.55, 0.62, 0.33 }, { 0.72, 0.62, 0.42 }, { 0.60, 0.50, 0.42 },
      { 0.95, 0.95, 0.97 } });
}

const std::vector<ProceduralScene>& GetProceduralScenes()
{
  static const std::vector<ProceduralScene> scenes = {
    { "isosurfaces", "Three nested isosurfaces of VTK's wavelet, coloured by value.",
      SceneLight::White, AddIsosurfaces },
    { "streamlines", "150 streamlines of a ring vortex as tubes, coloured by speed.",
      SceneLight::White, AddStreamlines },
    { "glyphs", "20 000 arrows, instances of one, in a field of three vortices.", SceneLight::White,
      AddArrows },
#if VTK_MODULE_ENABLE_VTK_DomainsChemistry
    { "molecule", "Helices of alanine, 5000 atoms as balls and sticks.", SceneLight::Gradient,
      AddMolecule },
#endif
    { "terrain", "400 x 400 heights in UTM metres, with a sun and the sky.", SceneLight::Window,
      AddTerrain },
    { "assembly", "Two planetary gears of metals and plastics, tessellated as by CAD programs.",
      SceneLight::Gradient, AddAssembly },
    { "turbulence", "An isosurface of two million triangles in procedural noise.",
      SceneLight::White, AddTurbulence },
    { "pipes", "Pipes, half pipes and bowls: open sheets, seen from both sides.",
      SceneLight::Gradient, AddPipes },
  };
  return scenes;
}
}
