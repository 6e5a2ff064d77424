// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFMaterial
 * @brief   materials that travel with the data, as field data
 *
 * The path tracing filters read the material of a surface from the field data of its block: of the
 * vtkPolyData itself, or, for arrays that it lacks, of the composite data set it is a leaf of. Any
 * VTK pipeline carries them along. This class knows the arrays' names; each holds one tuple:
 *
 * - `CSLF:BaseColor`: 3 components in [0,1], sRGB-encoded, by default 0.8, 0.8, 0.8. A dielectric's
 *   diffuse reflectance, a metal's reflectance at normal incidence, the tint of what glass lets
 *   through.
 * - `CSLF:Metallic`: in [0,1], by default 0. 0 is a dielectric, 1 a metal, a blend between.
 * - `CSLF:Roughness`: in [0,1], by default 1. Perceptual; its square is GGX's alpha; below 0.03
 * smooth.
 * - `CSLF:Emission`: 3 components, not negative, by default 0, 0, 0. Radiance, linear, from all
 * visible sides. An array of this name in the point data, else in the cell data, gives each point
 * or cell its own.
 * - `CSLF:IndexOfRefraction`: at least 1, by default 1. Of a dielectric's glossy boundary; 1 has
 * none.
 * - `CSLF:Transmission`: in [0,1], by default 0. The part of a dielectric that is glass.
 * - `CSLF:ThinWalled`: 0 or 1, by default 0. Whether glass is a thin sheet, which does not bend
 * light.
 * - `CSLF:Opacity`: in [0,1], by default 1. The part of the light that meets the surface; the rest
 *   passes as if there were none.
 * - `CSLF:OpacityCutoff`: in [0,1], by default 0. Above 0, opacities below count as 0, others as 1.
 * - `CSLF:VisibleSides`: 0 for both, 1 for the front, 2 for the back, by default 0. From which
 * sides polygons are there at all; for rays that come from the other side, they are not.
 * - `CSLF:NormalScale`: any number, by default 1. How far the normal texture bends normals.
 * - `CSLF:LineRadius`, `CSLF:PointRadius`: not negative, world units, by default 0. Of the tubes
 * and spheres that lines and vertices are shown as; 0 stands for 0.0005 of the scene's diagonal.
 * - `CSLF:DisplayedWhite`: 3 components, not negative, by default 0, 0, 0. How colours of points
 * and in textures are interpolated in between. 0: as light, as glTF has it. Above 0: as the
 * sRGB-encoded values that are displayed, as VTK's window does, in light that gives a white surface
 * this radiance. The middle between blue and red is displayed as 188, 0, 188 by the first rule and,
 * with a white of 1, as 128, 0, 128 by the second. Emissions are then interpolated as displayed,
 * too.
 *
 * The model is the metallic-roughness material of glTF 2.0. The default, metallic 0 and index 1, is
 * purely diffuse. Colours of points or cells, where they are shown, replace the base colour, and
 * their alpha multiplies the opacity (see vtkCSLFPathTracer).
 *
 * Glass is solid unless it is thin-walled: its surfaces should be closed, with the vertices of
 * their polygons counterclockwise seen from outside, since that tells light whether it enters or
 * leaves.
 *
 * Textures are images that multiply these factors; they lie on the surface by its texture
 * coordinates. They travel as field data too, pixels in an array named `CSLF:BaseColorTexture`,
 * `CSLF:MetallicRoughnessTexture`, `CSLF:NormalTexture` or `CSLF:EmissionTexture`: unsigned char, 1
 * to 4 components (grey, grey and alpha, RGB, RGBA), one tuple a pixel, the row of v = 0 first. An
 * array of the same name and `Layout` has one tuple of 4 integers: width, height, what the image
 * shows beyond [0,1] (0: its edge goes on, 1: it repeats, 2: it repeats mirrored, 3: its border's
 * colour), and whether it is interpolated; or of 9 integers, where the third is for u alone: then
 * follow that for v, and red, green, blue, alpha of the border in [0,255]. Colours are sRGB; the
 * alpha of the base colour multiplies the opacity; blue is metallic and green roughness;
 * normals are as in glTF.
 *
 * Values out of range are clamped when they are set and when they are read; what is no number is
 * the default. The path tracing filters warn of such values in arrays, and of arrays that do not
 * match.
 *
 * The prefix keeps these names apart from the arrays of simulations and other programs. Version 0.1
 * used the names without it; Documentation/Materials.md says where those are still read.
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
   * The arrays' names. Arrays of the radii's names in the point data give each point its own.
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
  ///@}

  /**
   * Sets all arrays from a property.
   *
   * With PBR interpolation: base colour, which VTK takes as linear, metallic, roughness, base index
   * of refraction, opacity, normal scale, and the textures `albedoTex`, `materialTex`, `normalTex`
   * and `emissiveTex`; the emission is the emissive factor where there is an emissive texture,
   * since VTK multiplies the two, and else 0. Occlusion is left to light transport.
   *
   * Any other interpolation, and any property without lighting, gives the opacity and what VTK's
   * window displays in light that shows colours as they are: the ambient term, or all without
   * lighting, as emission; the diffuse term as a diffuse base. A specular coefficient adds
   * highlights of the same height and width: white ones by a boundary, coloured ones by a part of
   * metal. Where they would reflect more than a fifth, they brighten the base.
   *
   * Culling of back or front faces sets the visible sides; where both are culled, VTK culls back
   * faces.
   *
   * vtkCSLFSceneImporter does the same for the lights that there are.
   *
   * Coats, anisotropy and edge tint are not represented; vtkCSLFSceneImporter represents properties
   * of back faces, edges, wireframes and points.
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
   * Set or get how metallic the surface is, in [0,1]. Default: 0.
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
   * Set or get the radiance emitted from all visible sides: linear, not negative. Default: 0, 0, 0.
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
   * Set or get the opacity below which a surface is not there, in [0,1]; 0 for none. Default: 0.
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
   * from another side pass as if there were no surface: those of cameras, reflections and shadows.
   * So what a point is lit by is what a camera there would see. An emission shines to the visible
   * sides. Glass should be visible from both sides, or its rays do not bend where they leave it.
   * Spheres and tubes of vertices and lines are visible from outside in any case. Default:
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
   * Set or get the radius of lines, in world units; 0 for a small part of the scene's size, see
   * above. Default: 0.
   */
  static void SetLineRadius(vtkDataObject* data, double radius);
  static double GetLineRadius(vtkDataObject* data);
  ///@}

  ///@{
  /**
   * Set or get the radius of vertices, in world units; 0 for a small part of the scene's size, see
   * above. Default: 0.
   */
  static void SetPointRadius(vtkDataObject* data, double radius);
  static double GetPointRadius(vtkDataObject* data);
  ///@}

  ///@{
  /**
   * Set or get the linear radiance of a white surface in the light for which colours of points and
   * in textures are interpolated as displayed values; 0 where they are interpolated as light: see
   * above. All components are above 0, or none counts. Default: 0, 0, 0.
   */
  static void SetDisplayedWhite(vtkDataObject* data, double red, double green, double blue);
  static void GetDisplayedWhite(vtkDataObject* data, double radiance[3]);
  ///@}

  /**
   * What a texture is used for.
   */
  enum TextureSlots
  {
    BaseColorTexture = 0,     ///< sRGB colour times the base colour, alpha times the opacity
    MetallicRoughnessTexture, ///< blue times metallic, green times roughness
    NormalTexture,  ///< the normal's x, y, z along u, along v, outwards: [-1,1] as [0,255]
    EmissionTexture ///< sRGB colour times the emission
  };

  /**
   * What a texture shows beyond coordinates in [0,1].
   */
  enum TextureWraps
  {
    ClampToEdge = 0, ///< its edge goes on
    Repeat,          ///< it repeats
    MirroredRepeat,  ///< it repeats, every other time mirrored
    ClampToBorder    ///< one colour, the border's
  };

  ///@{
  /**
   * The names of the arrays that hold a texture's pixels and its layout; null for any other slot.
   */
  static const char* TextureName(int slot);
  static const char* TextureLayoutName(int slot);
  ///@}

  /**
   * Sets a texture: a two-dimensional image of unsigned chars of 1 to 4 components, whose pixels
   * are shared, not copied. `repeat` tells whether it goes on beyond texture coordinates in [0,1],
   * and `interpolate` whether it is bilinear between pixels. Returns false, with a warning, for any
   * other image; null removes the texture.
   */
  static bool SetTexture(vtkDataObject* data, int slot, vtkImageData* image, bool repeat = true,
    bool interpolate = true);

  /**
   * Sets a texture from the input image of a vtkTexture, and its wrap, border and interpolation.
   * Scalars of any type become colours as in VTK's window, by the texture's colour mode and lookup
   * table; direct colours of floats are clamped to [0,1]. Cube maps are no such textures; the
   * texture's transform is one of texture coordinates, which vtkCSLFSceneImporter applies. Returns
   * false, with a warning, where it cannot be used; null removes the texture.
   */
  static bool SetTextureFrom(vtkDataObject* data, int slot, vtkTexture* texture);

  /**
   * Gets a texture. `repeat` tells whether it repeats along u, not mirrored; see GetTextureWrap.
   * Returns false, and leaves all else alone, where there is none.
   */
  static bool GetTexture(
    vtkDataObject* data, int slot, vtkImageData* image, bool& repeat, bool& interpolate);

  ///@{
  /**
   * Set or get what a texture shows beyond coordinates in [0,1], by TextureWraps, along u and v.
   * SetTexture sets Repeat or ClampToEdge for both. Returns false, and does nothing else, where
   * there is no texture.
   */
  static bool SetTextureWrap(vtkDataObject* data, int slot, int wrapU, int wrapV);
  static bool GetTextureWrap(vtkDataObject* data, int slot, int wraps[2]);
  ///@}

  ///@{
  /**
   * Set or get the colour of a texture with ClampToBorder beyond [0,1], encoded as its pixels are:
   * red, green, blue and alpha, in [0,1]. The alpha counts where the pixels have one, too.
   * SetTexture sets 0, 0, 0, 0. Returns false, and does nothing else, where there is no texture.
   */
  static bool SetTextureBorder(
    vtkDataObject* data, int slot, double red, double green, double blue, double alpha);
  static bool GetTextureBorder(vtkDataObject* data, int slot, double color[4]);
  ///@}

  /**
   * Copies the arrays of `fallback` that `data` lacks. For a block that inherits from its root.
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
