// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfImportedScene.h"

#include "cslfJoin.h"

#include <cstddef>
#include <iterator>

namespace cslf
{
namespace
{
// clang-format off
constexpr ImportLimitText Texts[] = {
  { ImportLimit::OtherProps,
    "props other than actors and volumes",
    "annotations, 2D actors, widgets",
    "left out",
    true },
  { ImportLimit::OtherMappers,
    "mappers that do not draw surfaces",
    "what the mapper draws, for example a light field",
    "left out",
    true },
  { ImportLimit::NoGeometry,
    "props whose mappers draw no surfaces, lines or points",
    "what the mapper draws",
    "left out",
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
    "splats that fade outwards and add up if they are emissive, or what a shader draws",
    "spheres of the splats' radii, with their colours and opacities",
    true },
  { ImportLimit::Followers,
    "followers",
    "actors that always face the camera",
    "actors that face the current camera",
    true },
  { ImportLimit::Shaders,
    "shader replacements and shader code of actors",
    "what the shaders draw",
    "the surface by its property, scalars and textures",
    true },
  { ImportLimit::ProjectiveMatrices,
    "projective matrices of actors",
    "points divided by their fourth coordinate",
    "the surface by the affine part of the matrix",
    true },
  { ImportLimit::ForcedOpaque,
    "ForceOpaque of actors with an opacity below 1",
    "the nearest layer, blended with what was drawn before it",
    "translucent surfaces, with all their layers",
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
    "cut at the planes",
    "tubes with round ends where their centre line is cut, and whole spheres whose centre is on "
    "the kept side",
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
    "PBR surfaces with a metallic factor between 0 and 1",
    "a diffuse base that is duller than the metal and has another hue",
    "one colour for base and metal, up to 5 levels of 255 off; 8 where a highlight is white in the "
    "window, and 20 where a texture gives the factor",
    false },
  { ImportLimit::OpposedNormals,
    "normals that point to the backs of their faces",
    "black, like mirrored actors with normals in some versions of VTK",
    "lit as if the normals pointed to the front",
    false },
  { ImportLimit::Layers,
    "translucent surfaces that overlap",
    "displayed colours, blended",
    "linear light, blended: brighter when displayed",
    false },
  { ImportLimit::PropertyTextures,
    "several textures of an actor and its property, without PBR",
    "the surface's colours times all of them",
    "its colours times the actor's texture, or else the property's first",
    true },
  { ImportLimit::TexturedTables,
    "scalars interpolated before mapping on a textured surface",
    "scalars mapped at each pixel, times the texture",
    "scalars mapped at each point, times the texture",
    true },
  { ImportLimit::Widths,
    "widths of lines and points",
    "constant in pixels at any distance",
    "tubes and spheres of constant size in the world, set by `PixelSize` of "
    "`vtkCSLFSceneImporter`; those of glyphs are scaled by the glyph's size relative to the median "
    "glyph",
    false },
  { ImportLimit::LineNormals, "points, lines and edges that have normals",
    "lit by their normals: black where these point away",
    "spheres and tubes, lit by their own shape", false },
  { ImportLimit::StickEnds,
    "ends of sticks, of molecules' bonds and of lines drawn as tubes",
    "flat",
    "round",
    false },
  { ImportLimit::Diagonals,
    "polygons of four corners or more",
    "split into triangles from their first corner, which affects facets, shading and the colours "
    "between corners, and covers holes and what is beside a concave outline",
    "split along short diagonals; outlines that touch or cross themselves are filled by the "
    "even-odd rule",
    false },
  { ImportLimit::Coplanar,
    "surfaces in one plane",
    "the one that was drawn first or last, or that is nearer by its polygon offset",
    "mixed at random; move them apart by a small distance",
    false },
  { ImportLimit::VolumeBlending,
    "blend modes of volumes other than composite",
    "maxima, minima, means, sums, slices or isosurfaces",
    "left out",
    true },
  { ImportLimit::VolumeGradients,
    "gradient opacity and two-dimensional functions of volumes",
    "opacities that depend on the gradient",
    "the functions of the scalars alone",
    true },
  { ImportLimit::VolumeMasks,
    "masks and label maps of volumes",
    "a part of the volume, or parts with colours of their own",
    "the whole volume, with the colours of its scalars",
    true },
  { ImportLimit::VolumeCropping,
    "cropping regions of volumes other than a box",
    "the regions that are on",
    "the whole volume",
    true },
  { ImportLimit::DependentComponents,
    "volumes of several components that depend on each other",
    "colours and opacities from different components",
    "left out",
    true },
  { ImportLimit::IndependentComponents,
    "volumes of several independent components",
    "means of the components, weighted by opacity",
    "a volume for each component, all in one place: opacities multiply",
    true },
  { ImportLimit::ResampledVolumes,
    "volumes of data that is neither an image nor a rectilinear grid",
    "the cells",
    "an image with about two points for each cell along an edge, at most 256: details that are "
    "smaller are lost",
    true },
  { ImportLimit::VolumeShading,
    "shading of volumes",
    "highlights and shades by the gradient, as of surfaces",
    "light that the volume scatters in all directions, with its colours as albedo",
    true },
  { ImportLimit::VolumeSurfaces,
    "surfaces behind or inside volumes",
    "displayed colours, blended",
    "linear light, blended: brighter when displayed. Volumes cast shadows and shine on surfaces",
    false },
  { ImportLimit::CubeMapEnvironments,
    "environment textures that are cube maps or have no image",
    "light from the cube map",
    "no light from them",
    true },
  { ImportLimit::EnvironmentImages,
    "environment textures other than two-dimensional images of floats or unsigned chars with 3 or "
    "4 components",
    "light from the texture",
    "no light from them",
    true },
  { ImportLimit::ClassicEnvironments,
    "environment textures with surfaces that are not PBR",
    "no light from them on these surfaces",
    "light from them on all surfaces",
    true },
  { ImportLimit::RenderPasses,
    "render passes",
    "what the renderer's pass draws",
    "the scene as without the pass",
    true },
  { ImportLimit::Shadows,
    "shadows and light between surfaces",
    "none, unless render passes add some",
    "both",
    false },
  { ImportLimit::Shading,
    "surfaces that do not face the light",
    "displayed colours times the cosine to the light",
    "linear light times the cosine, which is brighter when displayed: 0.73 instead of 0.5 at 60 "
    "degrees; sums of several lights differ likewise. Both agree where a surface faces the light, "
    "or, with light kits and camera lights, the current camera. In PBR both multiply linear light, "
    "but the window's own curve shows dark places up to 9 levels of 255 brighter",
    false },
  { ImportLimit::Highlights,
    "highlights of flat, Gouraud and Phong shading",
    "the cosine to a power, added to the displayed colour",
    "microfacets (GGX) of the same height and width, with a longer tail. Where colours vary, "
    "highlights are those of a middle colour: brighter than the window's on dark colours, fainter "
    "on bright ones",
    false },
  { ImportLimit::UnlitLines,
    "lines, points and edges",
    "a constant width in pixels; without normals, unlit in their own colours, but wide edges of "
    "wireframes are black in some directions",
    "lit tubes and spheres of constant width in the world, with these colours where they face the "
    "light; they emit what a dim or coloured light lacks",
    false },
  { ImportLimit::Headlights,
    "headlights",
    "a light at the camera",
    "the same light from all around, since a light field has cameras everywhere; "
    "`HeadlightsAllAroundOff` of `vtkCSLFSceneImporter` keeps it at the current camera",
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
    text += (details.empty() ? "" : ": ") + Join(details) + " (" + row.Bake + ")";
  }
  return text;
}
}
