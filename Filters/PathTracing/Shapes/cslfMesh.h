// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Triangles, spheres or tubes of one material, and the values that vary over them.
 */
#ifndef cslfMesh_h
#define cslfMesh_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Materials/cslfSurfaceMaterial.h"
#include "PathTracing/Materials/cslfTexture.h"
#include "Pipeline/cslfSurfaceArray.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cslf
{
struct ColorMap;

/// A point of a triangle; or of a sphere or tube.
struct TrianglePoint
{
  static constexpr std::uint32_t None = 0xffffffffu;

  std::uint32_t Triangle = 0;
  float U = 0.0f; ///< barycentric coordinate of the triangle's second vertex; along a tube
  float V = 0.0f; ///< and of the third
  std::uint32_t Instance = None;
};

/// An instance of a mesh, and its colour.
struct MeshInstance
{
  glm::mat3 Linear{ 1.0f }; ///< with the offset: from the mesh to the scene
  glm::vec3 Offset{ 0.0f };
  glm::vec3 Color{ 1.0f }; ///< linear; used if the mesh has colours of instances
  float Opacity = 1.0f;
  glm::vec3 Emission{ 0.0f }; ///< radiance; used if the mesh has emissions of instances
  glm::vec2 MapPlace{ 0.0f }; ///< used if the mesh has colours of instances, and a map
};

/// Images that multiply factors of the material. Null if there is none.
struct MaterialTextures
{
  std::shared_ptr<const Texture> BaseColor;         ///< its alpha is opacity
  std::shared_ptr<const Texture> MetallicRoughness; ///< blue and green
  std::shared_ptr<const Texture> Normal; ///< in the texture's own frame, [-1,1] stored as [0,1]
  std::shared_ptr<const Texture> Emission;
};

struct VTKCSLF_EXPORT Mesh
{
  enum class ColorsOf
  {
    None,
    Vertices,
    Triangles
  };

  enum class Shapes
  {
    Triangles,
    Spheres, ///< one around each vertex
    Tubes    ///< with round ends, one around each two vertices
  };

  Shapes Shape = Shapes::Triangles;
  std::vector<glm::vec3> Vertices;
  std::vector<float> Radii; ///< of spheres and tubes, one per vertex
  /// Of tubes, one a vertex, or none at all: 1 where the tube goes straight on in another one, so
  /// that its round end lies within that one and is no surface.
  std::vector<std::uint32_t> Joints;
  std::vector<glm::uvec3> Triangles;
  std::vector<glm::vec3> Normals;   ///< one per vertex, or none at all; of length 0 if unknown
  std::vector<glm::vec2> TexCoords; ///< one per vertex; required if there is a texture
  std::vector<glm::vec3> Colors;    ///< linear, replacing the material's base colour
  std::vector<float> Opacities;     ///< those of the colours, or none at all
  ColorsOf Coloring = ColorsOf::None;
  std::vector<glm::vec3> Emissions; ///< radiance, replacing the material's, which is their maximum
  ColorsOf EmissionsOf = ColorsOf::None;

  /// Above 0 if colours and emissions of vertices are displayed (sRGB-encoded) values, and
  /// interpolated as such: emissions unchanged, colours times this radiance of a white surface.
  glm::vec3 DisplayedWhite{ 0.0f };
  SurfaceMaterial Material;
  MaterialTextures Textures;
  /// The map of the texture of base colours; or of the colours of vertices, shapes or instances,
  /// whose places on it follow; or that of one colour; or null.
  std::shared_ptr<const ColorMap> Map;
  std::vector<glm::vec2> MapPlaces;
  std::vector<SurfaceArray> Arrays;      ///< of the vertices, which a geometry keeps
  std::vector<SurfaceArray> ShapeArrays; ///< of the shapes, likewise
  std::string Appearance;                ///< identifies the material, the textures and the map

  /// A grey that takes the place of the base colours, while it is not negative: see
  /// Scene::SetNeutral.
  float NeutralAlbedo = -1.0f;

  /// The instances of the mesh, if it has any. Its vertices may then be in another space than the
  /// scene's.
  std::vector<MeshInstance> Instances;
  bool HasInstanceColors = false;
  bool HasInstanceEmissions = false;
  std::uint32_t FirstInstance = 0; ///< among those of the scene

  std::uint32_t GetNumberOfShapes() const;

  /// Interpolated values of the vertices at a point.
  template <typename Value>
  Value Interpolate(const std::vector<Value>& values, const TrianglePoint& point) const
  {
    switch (this->Shape)
    {
      case Shapes::Spheres:
        return values[point.Triangle];
      case Shapes::Tubes:
      {
        const std::size_t first = 2 * std::size_t(point.Triangle);
        return (1.0f - point.U) * values[first] + point.U * values[first + 1];
      }
      default:
        break;
    }
    const glm::uvec3& corners = this->Triangles[point.Triangle];
    return (1.0f - point.U - point.V) * values[corners.x] + point.U * values[corners.y] +
      point.V * values[corners.z];
  }

  ///@{
  /// The arrays of vertices, and after them those of shapes.
  std::size_t GetNumberOfArrays() const { return this->Arrays.size() + this->ShapeArrays.size(); }
  const SurfaceArray& GetArray(std::size_t number) const
  {
    return number < this->Arrays.size() ? this->Arrays[number]
                                        : this->ShapeArrays[number - this->Arrays.size()];
  }
  double GetArrayValue(std::size_t number, std::size_t component, const TrianglePoint& point) const
  {
    const std::vector<double>& values = this->GetArray(number).Components[component].Values;
    return number < this->Arrays.size() ? this->Interpolate(values, point) : values[point.Triangle];
  }
  ///@}

  ///@{
  /// The length of a triangle's longest edge, and its area, in the mesh's space.
  float GetLongestEdge(std::uint32_t triangle) const;
  float GetArea(std::uint32_t triangle) const;
  ///@}

  /// Whether each of its points is one point of the scene, on a triangle.
  bool CanHoldLattice() const
  {
    return this->Shape == Shapes::Triangles && this->Instances.empty();
  }

  /// Whether it looks the same from all directions, and does not emit light.
  bool IsDiffuse() const { return this->Material.IsLambertian() && !this->Material.IsEmissive(); }

  /// Whether it reflects no light, like surfaces without lighting, which only emit.
  bool IsBlack() const
  {
    return this->Material.IsLambertian() && this->IsUniform() &&
      this->Material.BaseColor == glm::vec3(0.0f);
  }

  /// Whether the material alone determines its colour and roughness everywhere.
  bool IsUniform() const
  {
    return this->NeutralAlbedo < 0.0f && this->Coloring == ColorsOf::None &&
      !this->HasInstanceColors && !this->Textures.BaseColor && !this->Textures.MetallicRoughness;
  }

  /// Whether its base colour is that of the material everywhere.
  bool HasOneColor() const;

  /// The map that alone tells how colours differ over the mesh, which looks the same from all
  /// directions; or null.
  const ColorMap* FindMap() const;

  /// The same if that is the image of a texture, whose colours the material's multiplies.
  const Texture* FindImage() const;

  /// The place on the map, and what multiplies its colour.
  glm::vec2 GetMapPlace(const TrianglePoint& point) const;
  glm::vec3 GetMapFactor() const;

  glm::vec3 GetBaseColor(const TrianglePoint& point) const;

  /// The luminance of the mean of the base colours of all shapes or instances.
  float MeasureAlbedo() const;
  MaterialPoint GetMaterialPoint(const TrianglePoint& point) const;

  /// Whether light passes anywhere through the surface as if it did not exist.
  bool IsTranslucent() const;

  /// Whether light can pass the surface at all: where it is translucent or glass, or from a side on
  /// which it is invisible.
  bool CanBePassed() const
  {
    return this->IsTranslucent() || this->Material.Transmission > 0.0f ||
      this->Material.Hides(false) || this->Material.Hides(true);
  }

  /// The probability that light hits the surface, in [0,1].
  float GetOpacity(const TrianglePoint& point) const;

  /// The radiance of the surface where light hits it.
  glm::vec3 GetEmission(const TrianglePoint& point) const;

  /// The shift of each triangle's plane by the rounding of its normal, in roundings: about the
  /// longest edge, and more for slivers, whose edges are nearly parallel. Set by PrepareRounding
  /// when its corners are known.
  std::vector<float> LengthsOfRounding;
  void PrepareRounding();

  /// Computes the weight of each shape's light. Call it once, after everything else is set.
  void PrepareEmission();

  /// The approximate mean luminance of a shape's emission times its opacity, without that of
  /// instances: the weight of its light in sampling.
  float GetEmissionImportance(std::uint32_t shape) const;

  /// A normal on the front side, bent by the normal texture, which must exist. The edges are those
  /// from the triangle's first corner. Lengths of normals do not matter.
  glm::vec3 BendNormal(
    const glm::vec3& normal, const glm::vec3 edges[2], const TrianglePoint& point) const;

private:
  bool CanHaveMap() const;
  bool HoldsDisplayed() const { return this->DisplayedWhite.x > 0.0f; }
  glm::vec3 GetColor(const TrianglePoint& point) const;
  glm::vec3 GetEmissionFactor(const TrianglePoint& point) const;
  float EstimateEmission(std::uint32_t shape) const;

  std::vector<float> EmissionImportances; // one per shape if it varies, or none at all
};
}

#endif
