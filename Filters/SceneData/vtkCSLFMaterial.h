// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFMaterial
 * @brief   materials that travel with the data, as field data
 *
 * The path tracing filters read the material of a surface from the field data of its block: from
 * the vtkPolyData itself or, for arrays that it lacks, from the composite data set that it is a
 * leaf of. Any VTK pipeline passes materials on. This class provides the names of the arrays; each
 * holds one tuple:
 *
 * - `CSLF:BaseColor`: 3 components in [0,1], sRGB-encoded, default 0.8, 0.8, 0.8. The diffuse
 * reflectance of a dielectric, the reflectance of a metal at normal incidence, the tint of light
 * that passes through glass.
 * - `CSLF:Metallic`: in [0,1], default 0. 0 is a dielectric, 1 a metal; values between blend the
 * two.
 * - `CSLF:Roughness`: in [0,1], default 1. Perceptual: its square is the alpha of GGX. Surfaces
 * with a roughness below 0.03 are smooth.
 * - `CSLF:Emission`: 3 components, not negative, default 0, 0, 0. Linear radiance from all visible
 * sides. An array of this name in the point data, or else in the cell data, gives each point or
 * cell its own emission.
 * - `CSLF:IndexOfRefraction`: at least 1, default 1. The index of a dielectric's glossy boundary;
 * with 1 there is no boundary.
 * - `CSLF:Transmission`: in [0,1], default 0. The fraction of a dielectric that is glass.
 * - `CSLF:ThinWalled`: 0 or 1, default 0. Whether glass is a thin sheet, which does not refract
 * light.
 * - `CSLF:Opacity`: in [0,1], default 1. The fraction of the light that meets the surface; the rest
 * passes as if there were no surface.
 * - `CSLF:OpacityCutoff`: in [0,1], default 0. If above 0, opacities below it are treated as 0, and
 * all others as 1.
 * - `CSLF:VisibleSides`: 0 for both, 1 for the front, 2 for the back, default 0. The sides from
 * which polygons are visible. Rays that come from the other side pass.
 * - `CSLF:NormalScale`: any number, default 1. How far the normal texture bends normals.
 * - `CSLF:LineRadius`, `CSLF:PointRadius`: not negative, world units, default 0. The radii of the
 * tubes and spheres that represent lines and vertices; 0 selects 0.0005 of the scene's diagonal for
 * lines, and for vertices half of the distance between neighbouring ones, but 0.0001 to 0.02 of the
 * diagonal.
 * - `CSLF:DisplayedWhite`: 3 components, not negative, default 0, 0, 0. The interpolation of
 * colours between points and in textures. With 0, they are interpolated as light, as in glTF. Above
 * 0, they are interpolated as displayed (sRGB-encoded) values, as in VTK's window, in light that
 * gives a white surface this radiance. The middle between blue and red is displayed as 188, 0, 188
 * by the first rule and, with a white of 1, as 128, 0, 128 by the second. Emissions are then
 * interpolated as displayed values as well.
 * - `CSLF:FinishedColors`: 0 or 1, default 0. With 1, the data has its final colours, as what
 * vtkCSLFSceneImporter makes of an actor: base colour, textures and, if there are any, colours of
 * points or cells in an array named `CSLF:Colors` (unsigned char, 3 or 4 components). No other
 * array and no lookup table colours it, whatever is set for the whole scene.
 *
 * The model is the metallic-roughness material of glTF 2.0. The default, metallic 0 and index 1, is
 * purely diffuse. Colours of points or cells, if shown, replace the base colour, and their alpha
 * multiplies the opacity (see vtkCSLFPathTracer).
 *
 * Glass is solid unless it is thin-walled. Its surfaces should be closed, with the vertices of
 * their polygons counterclockwise as seen from outside, because this determines whether light
 * enters or leaves.
 *
 * Textures are images that multiply these factors, mapped by the surface's texture coordinates.
 * They are field data as well, with pixels in an array named `CSLF:BaseColorTexture`,
 * `CSLF:MetallicRoughnessTexture`, `CSLF:NormalTexture` or `CSLF:EmissionTexture`: unsigned char, 1
 * to 4 components (grey, grey and alpha, RGB, RGBA), one tuple per pixel, beginning with the row of
 * v = 0. An array of the same name with `Layout` appended has one tuple of 4 integers: width,
 * height, the wrap beyond [0,1] (0: clamped to the edge, 1: repeated, 2: repeated and mirrored, 3:
 * the border's colour), and whether the image is interpolated. A tuple of 9 integers has the wrap
 * of u as the third, and after these four the wrap of v and red, green, blue and alpha of the
 * border in [0,255]. Colours are sRGB. The alpha of the base colour multiplies the opacity. Blue is
 * metallic and green roughness. Normals are as in glTF.
 *
 * Values out of range are clamped when they are set and when they are read; NaN is replaced by the
 * default. The path tracing filters warn of such values in arrays, and of arrays that do not match.
 *
 * The prefix distinguishes these names from the arrays of simulations and other programs. Version
 * 0.1 used the names without it; Documentation/Materials.md explains when those are still read.
 *
 * @sa vtkCSLFLight vtkCSLFPathTracer
 */
#ifndef vtkCSLFMaterial_h
#define vtkCSLFMaterial_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkObject.h"

class vtkDataObject;
class vtkImageData;
class vtkProperty;
class vtkTexture;

class VTKCSLF_EXPORT vtkCSLFMaterial : public vtkObject
{
public:
  static vtkCSLFMaterial* New();
  vtkTypeMacro(vtkCSLFMaterial, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The names of the arrays. Point-data arrays with the names of the radii give each point its own
   * radius.
   */
  static const char* BaseColorName() { return "CSLF:BaseColor"; }
  static const char* MetallicName() { return "CSLF:Metallic"; }
  static const char* RoughnessName() { return "CSLF:Roughness"; }
  static const char* EmissionName() { return "CSLF:Emission"; }
  static const char* IndexOfRefractionName() { return "CSLF:IndexOfRefraction"; }
  static const char* TransmissionName() { return "CSLF:Transmission"; }
  static const char* ThinWalledName() { return "CSLF:ThinWalled"; }
  static const char* OpacityName() { return "CSLF:Opacity"; }
  static const char* OpacityCutoffName() { return "CSLF:OpacityCutoff"; }
  static const char* VisibleSidesName() { return "CSLF:VisibleSides"; }
  static const char* NormalScaleName() { return "CSLF:NormalScale"; }
  static const char* LineRadiusName() { return "CSLF:LineRadius"; }
  static const char* DisplayedWhiteName() { return "CSLF:DisplayedWhite"; }
  static const char* PointRadiusName() { return "CSLF:PointRadius"; }
  static const char* FinishedColorsName() { return "CSLF:FinishedColors"; }
  ///@}

  /**
   * Sets all arrays from a property.
   *
   * With PBR interpolation: base colour, which VTK takes as linear, metallic, roughness, base index
   * of refraction, opacity, normal scale, and the textures `albedoTex`, `materialTex`, `normalTex`
   * and `emissiveTex`. If there is an emissive texture, the emission is the emissive factor,
   * because VTK multiplies the two; otherwise it is 0. Occlusion textures are ignored, because
   * light transport computes occlusion.
   *
   * With any other interpolation, and for properties without lighting: the opacity, and the colours
   * that VTK's window displays in light that shows colours unchanged. The ambient term, or the
   * whole colour without lighting, becomes emission, and the diffuse term a diffuse base. A
   * specular coefficient adds highlights of the same height and width: white ones by a glossy
   * boundary, coloured ones by a metallic factor. If they would reflect more than a fifth, they
   * brighten the base.
   *
   * Culling of back or front faces sets the visible sides. If both are culled, VTK culls back faces
   * only.
   *
   * vtkCSLFSceneImporter does the same for the actual lights of a renderer.
   *
   * Coats, anisotropy and edge tint are not represented. vtkCSLFSceneImporter also represents
   * properties of back faces, edges, wireframes and points.
   */
  static void SetFromProperty(vtkDataObject* data, vtkProperty* property);

  ///@{
  /**
   * Set or get the base colour, sRGB-encoded, each component in [0,1]. Default: 0.8, 0.8, 0.8.
   */
  static void SetBaseColor(vtkDataObject* data, double red, double green, double blue);
  static void GetBaseColor(vtkDataObject* data, double color[3]);
  ///@}

  ///@{
  /**
   * Set or get the metallic factor, in [0,1]. Default: 0.
   */
  static void SetMetallic(vtkDataObject* data, double metallic);
  static double GetMetallic(vtkDataObject* data);
  ///@}

  ///@{
  /**
   * Set or get the perceptual roughness, in [0,1]. Default: 1.
   */
  static void SetRoughness(vtkDataObject* data, double roughness);
  static double GetRoughness(vtkDataObject* data);
  ///@}

  ///@{
  /**
   * Set or get the emission: linear radiance from all visible sides, not negative. Default: 0, 0,
   * 0.
   */
  static void SetEmission(vtkDataObject* data, double red, double green, double blue);
  static void GetEmission(vtkDataObject* data, double radiance[3]);
  ///@}

  ///@{
  /**
   * Set or get the index of refraction, at least 1. With 1 a dielectric is purely diffuse; glass
   * and plastics have about 1.5. Default: 1.
   */
  static void SetIndexOfRefraction(vtkDataObject* data, double index);
  static double GetIndexOfRefraction(vtkDataObject* data);
  ///@}

  ///@{
  /**
   * Set or get the transmission, in [0,1]. Default: 0.
   */
  static void SetTransmission(vtkDataObject* data, double transmission);
  static double GetTransmission(vtkDataObject* data);
  ///@}

  ///@{
  /**
   * Set or get whether glass is a thin sheet. Default: false.
   */
  static void SetThinWalled(vtkDataObject* data, bool thin);
  static bool GetThinWalled(vtkDataObject* data);
  ///@}

  ///@{
  /**
   * Set or get the opacity, in [0,1]. Default: 1.
   */
  static void SetOpacity(vtkDataObject* data, double opacity);
  static double GetOpacity(vtkDataObject* data);
  ///@}

  ///@{
  /**
   * Set or get the opacity below which a surface is invisible, in [0,1]; 0 for none. Default: 0.
   */
  static void SetOpacityCutoff(vtkDataObject* data, double cutoff);
  static double GetOpacityCutoff(vtkDataObject* data);
  ///@}

  /**
   * The sides of polygons. The front is where their vertices run counterclockwise.
   */
  enum Sides
  {
    BothSides = 0,
    FrontSide,
    BackSide
  };

  ///@{
  /**
   * Set or get the sides from which polygons are visible, by Sides. Rays of all kinds that come
   * from another side pass as if there were no surface: camera rays, reflections and shadows. A
   * point is therefore lit by what a camera there would see. An emission shines to the visible
   * sides. Glass should be visible from both sides; otherwise light is not refracted when it
   * leaves. Spheres and tubes of vertices and lines are always visible from outside. Default:
   * BothSides.
   */
  static void SetVisibleSides(vtkDataObject* data, int sides);
  static int GetVisibleSides(vtkDataObject* data);
  ///@}

  ///@{
  /**
   * Set or get the factor of the normal texture's x and y. Default: 1.
   */
  static void SetNormalScale(vtkDataObject* data, double scale);
  static double GetNormalScale(vtkDataObject* data);
  ///@}

  ///@{
  /**
   * Set or get the radius of lines, in world units; 0 selects a small fraction of the scene's size,
   * see above. Default: 0.
   */
  static void SetLineRadius(vtkDataObject* data, double radius);
  static double GetLineRadius(vtkDataObject* data);
  ///@}

  ///@{
  /**
   * Set or get the radius of vertices, in world units; 0 selects a small fraction of the scene's
   * size, see above. Default: 0.
   */
  static void SetPointRadius(vtkDataObject* data, double radius);
  static double GetPointRadius(vtkDataObject* data);
  ///@}

  ///@{
  /**
   * Set or get the displayed white: the linear radiance of a white surface in the light for which
   * colours of points and in textures are interpolated as displayed values. With 0, they are
   * interpolated as light, see above. The value is used only if all components are above 0.
   * Default: 0, 0, 0.
   */
  static void SetDisplayedWhite(vtkDataObject* data, double red, double green, double blue);
  static void GetDisplayedWhite(vtkDataObject* data, double radiance[3]);
  ///@}

  ///@{
  /**
   * Set or get whether the data has its final colours, see above. Default: false.
   */
  static void SetFinishedColors(vtkDataObject* data, bool finished);
  static bool GetFinishedColors(vtkDataObject* data);
  ///@}

  /**
   * The name of the array, of points or else of cells, that holds the colours of data with finished
   * colours.
   */
  static const char* ColorsName() { return "CSLF:Colors"; }

  /**
   * The uses of textures.
   */
  enum TextureSlots
  {
    BaseColorTexture = 0,     ///< sRGB colour times the base colour, alpha times the opacity
    MetallicRoughnessTexture, ///< blue times metallic, green times roughness
    NormalTexture,  ///< the normal's x, y, z along u, along v, outwards: [-1,1] as [0,255]
    EmissionTexture ///< sRGB colour times the emission
  };

  /**
   * The ways to extend a texture beyond coordinates in [0,1].
   */
  enum TextureWraps
  {
    ClampToEdge = 0, ///< clamped to the edge
    Repeat,          ///< repeated
    MirroredRepeat,  ///< repeated and mirrored alternately
    ClampToBorder    ///< the border's colour
  };

  ///@{
  /**
   * The names of the arrays that hold the pixels and the layout of a texture; null for an invalid
   * slot.
   */
  static const char* TextureName(int slot);
  static const char* TextureLayoutName(int slot);
  ///@}

  /**
   * Sets a texture: a two-dimensional image of unsigned chars with 1 to 4 components, whose pixels
   * are shared, not copied. `repeat` selects whether it is repeated beyond texture coordinates in
   * [0,1], and `interpolate` whether it is interpolated bilinearly between pixels. Returns false,
   * with a warning, for any other image. Null removes the texture.
   */
  static bool SetTexture(vtkDataObject* data, int slot, vtkImageData* image, bool repeat = true,
    bool interpolate = true);

  /**
   * Sets a texture from the image of a vtkTexture, in any plane, with its wrap, border and
   * interpolation. Scalars become colours as in VTK's window, by the texture's colour mode and
   * table; direct float colours are clamped to [0,1]. Cube maps are not supported. The texture's
   * transform is a transform of texture coordinates, which vtkCSLFSceneImporter applies. Returns
   * false, with a warning, if the texture cannot be used. Null removes the texture.
   */
  static bool SetTextureFrom(vtkDataObject* data, int slot, vtkTexture* texture);

  /**
   * Gets a texture. `repeat` returns whether it repeats along u without mirroring; see
   * GetTextureWrap. Returns false, and changes nothing, if there is none.
   */
  static bool GetTexture(
    vtkDataObject* data, int slot, vtkImageData* image, bool& repeat, bool& interpolate);

  ///@{
  /**
   * Set or get the wrap of a texture beyond coordinates in [0,1], by TextureWraps, along u and v.
   * SetTexture sets Repeat or ClampToEdge for both. Returns false, and does nothing else, if there
   * is no texture.
   */
  static bool SetTextureWrap(vtkDataObject* data, int slot, int wrapU, int wrapV);
  static bool GetTextureWrap(vtkDataObject* data, int slot, int wraps[2]);
  ///@}

  ///@{
  /**
   * Set or get the border colour of a texture with ClampToBorder, encoded like its pixels: red,
   * green, blue and alpha, in [0,1]. The alpha is used only if the pixels have one. SetTexture sets
   * 0, 0, 0, 0. Returns false, and does nothing else, if there is no texture.
   */
  static bool SetTextureBorder(
    vtkDataObject* data, int slot, double red, double green, double blue, double alpha);
  static bool GetTextureBorder(vtkDataObject* data, int slot, double color[4]);
  ///@}

  /**
   * Copies the arrays of `fallback` that `data` lacks, for a block that inherits from its root.
   */
  static void Inherit(vtkDataObject* data, vtkDataObject* fallback);

protected:
  vtkCSLFMaterial() = default;
  ~vtkCSLFMaterial() override = default;

private:
  vtkCSLFMaterial(const vtkCSLFMaterial&) = delete;
  void operator=(const vtkCSLFMaterial&) = delete;
};

#endif
