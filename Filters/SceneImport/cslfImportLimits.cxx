// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfImportLimits.h"

#include <cstddef>
#include <iterator>

namespace cslf
{
namespace
{
// clang-format off
constexpr ImportLimitText Texts[] = {
  { ImportLimit::OtherProps,
    "props other than actors",
    "volumes, annotations, 2D actors, widgets",
    "left out",
    true },
  { ImportLimit::OtherMappers,
    "mappers of other than surfaces",
    "what the mapper draws; a light field, say",
    "left out",
    true },
  { ImportLimit::NoGeometry,
    "props whose mappers draw something else than surfaces, lines and points",
    "what the mapper draws",
    "nothing",
    true },
  { ImportLimit::SourceTableTrees,
    "glyphs of a source table tree",
    "glyphs",
    "left out",
    true },
  { ImportLimit::GraphIcons,
    "icons and outlines of graphs' vertices",
    "icons that face the camera; a rim around each vertex",
    "vertices as spheres or circles, without them",
    true },
  { ImportLimit::Splats,
    "splats of point Gaussian mappers",
    "spots that fade outwards, and add up where they are emissive, or what a shader draws",
    "spheres of the splats' radii, with their colours and opacities",
    true },
  { ImportLimit::Followers,
    "followers",
    "actors that face the camera always",
    "actors that face where the camera is now",
    true },
  { ImportLimit::BackfaceProperties,
    "properties of back faces of PBR surfaces and of glyphs",
    "black back faces, in VTK 9.1",
    "back faces by the colours and coefficients of their property",
    true },
  { ImportLimit::CulledEdges,
    "edges of culled faces",
    "hidden with their faces",
    "visible from all sides",
    true },
  { ImportLimit::ClippedLines,
    "clipping planes across lines, points, spheres and sticks",
    "cut where the planes are",
    "tubes that end round where their centre line is cut, and whole spheres with their centre on the "
    "side that is kept",
    true },
  { ImportLimit::Coats,
    "coats",
    "a clear coat over the PBR surface",
    "the surface without its coat",
    true },
  { ImportLimit::Anisotropy,
    "anisotropy",
    "highlights that are longer in one direction",
    "isotropic highlights",
    true },
  { ImportLimit::PartMetals,
    "PBR surfaces of a metallic part between 0 and 1",
    "a diffuse base that is duller than the metal and of another hue",
    "one colour for base and metal, up to 5 levels of 255 off; 8 where a highlight is white in the "
    "window, and 20 where a texture gives the part",
    false },
  { ImportLimit::OpposedNormals,
    "normals that point to the backs of their faces",
    "black; so are mirrored actors with normals, in some versions of VTK",
    "lit as if the normals pointed to the front",
    false },
  { ImportLimit::Layers,
    "translucent surfaces that overlap",
    "displayed colours, mixed",
    "light, mixed: brighter once it is displayed",
    false },
  { ImportLimit::TexturedTables,
    "scalars interpolated before mapping on a textured surface",
    "scalars mapped in each pixel, times the texture",
    "scalars mapped at each point, times the texture",
    true },
  { ImportLimit::Widths,
    "widths of lines and points",
    "pixels, however far away",
    "tubes and spheres of a size in the world, by `PixelSize`",
    false },
  { ImportLimit::StickEnds,
    "ends of sticks, of molecules' bonds and of lines drawn as tubes",
    "flat",
    "round",
    false },
  { ImportLimit::Diagonals,
    "polygons of four corners or more",
    "split into triangles from their first corner, which colours between corners depend on",
    "split along short diagonals",
    false },
  { ImportLimit::CubeMapEnvironments,
    "an environment texture that is a cube map, or without an image",
    "light from the cube map",
    "no light from it",
    true },
  { ImportLimit::EnvironmentImages,
    "an environment texture that is not two-dimensional, of floats or unsigned chars, "
    "and of 3 or 4 components",
    "light from the texture",
    "no light from it",
    true },
  { ImportLimit::ClassicEnvironments,
    "an environment texture over surfaces that are not PBR",
    "no light from it on them",
    "light from it on all surfaces",
    true },
  { ImportLimit::Shadows,
    "shadows, light between surfaces",
    "none, unless passes add some of them",
    "both",
    false },
  { ImportLimit::Shading,
    "surfaces that do not face the light",
    "displayed colours times the cosine to the light",
    "light times the cosine, so brighter once it is displayed: 0.73 in place of 0.5 at 60 degrees; "
    "sums of several lights differ likewise. Where a surface faces the light, both show the same; of "
    "light kits and camera lights, where it faces the camera now. In "
    "PBR both multiply light, but by its own curve the window shows dark places up to 9 levels of "
    "255 brighter",
    false },
  { ImportLimit::Highlights,
    "highlights of flat, Gouraud and Phong shading",
    "the cosine to a power, added to the displayed colour",
    "microfacets (GGX) as high and as wide, with a longer tail. Where colours vary, highlights are "
    "those of a middle colour: brighter than the window's on dark colours, fainter on bright ones",
    false },
  { ImportLimit::UnlitLines,
    "lines, points and edges",
    "as wide as so many pixels; without normals, in their colours without any light",
    "tubes and spheres of one width in the world, under the lights, with these colours where they "
    "face the light; darker in dim light",
    false },
  { ImportLimit::Headlights,
    "headlights",
    "a light at the camera",
    "the same light from all around, since a light field has cameras everywhere; "
    "`HeadlightsAllAroundOff` leaves it where the camera is now",
    false },
};
// clang-format on

constexpr bool IsInOrder()
{
  for (std::size_t i = 0; i < std::size(Texts); ++i)
  {
    if (static_cast<std::size_t>(Texts[i].Limit) != i)
    {
      return false;
    }
  }
  return std::size(Texts) == static_cast<std::size_t>(ImportLimit::Count);
}
static_assert(IsInOrder(), "each limit has a row, in the order of ImportLimit");
}

const ImportLimitText& GetText(ImportLimit limit)
{
  return Texts[static_cast<std::size_t>(limit)];
}

std::string ToText(const MetLimits& limits)
{
  std::string text;
  for (const auto& [limit, details] : limits)
  {
    const ImportLimitText& row = GetText(limit);
    text += (text.empty() ? "" : "; ") + std::string(row.Name);
    const char* separator = ": ";
    for (const std::string& detail : details)
    {
      text += separator + detail;
      separator = ", ";
    }
    text += std::string(" (") + row.Bake + ")";
  }
  return text;
}
}
