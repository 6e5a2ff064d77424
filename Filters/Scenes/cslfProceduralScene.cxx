// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfProceduralScene.h"

namespace cslf
{
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
