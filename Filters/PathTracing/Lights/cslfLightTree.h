// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Chooses one of many lights to sample at a surface point.
 */
#ifndef cslfLightTree_h
#define cslfLightTree_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfLightBounds.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cslf
{
/// A point for which light is sampled.
struct LightReceiver
{
  glm::vec3 Position{ 0.0f };
  glm::vec3 Normal{ 0.0f }; ///< on the side from which light comes; 0 if light may come from both
};

/**
 * A tree of lights with up to four children per node. Sampling descends from the root and chooses a
 * child in proportion to an estimate of the light that the receiver may get from it, from bounds of
 * the child's positions and directions and from the receiver's horizon: Conty Estevez and Kulla,
 * "Importance Sampling of Many Lights with Adaptive Tree Splitting", PACMCGIT 1(2), 2018, without
 * the splitting. Lights with indistinguishable bounds, such as the two triangles of a rectangle,
 * share a leaf and are chosen by their power. The cost is proportional to the depth of the tree.
 * Only lights from which no light can arrive have the probability 0.
 */
class VTKCSLF_EXPORT LightTree
{
public:
  LightTree() = default;

  /// Powers must be above 0.
  explicit LightTree(const std::vector<LightBounds>& lights);

  bool IsEmpty() const { return this->Nodes.empty(); }

  struct Choice
  {
    std::uint32_t Light = 0;
    double Probability = 0.0; ///< 0 if there is no light for the receiver
    double Remainder = 0.0;   ///< the random number used, stretched to [0,1]
  };

  /// Chooses a light by a number in [0,1).
  Choice Sample(const LightReceiver& receiver, double u) const;

  /// The probability with which Sample chooses a light.
  double GetProbability(const LightReceiver& receiver, std::uint32_t light) const;

private:
  static constexpr int Width = 4;

  template <typename Value>
  struct Parts
  {
    Value Values[Width];

    Value& operator[](int part) { return this->Values[part]; }
    const Value& operator[](int part) const { return this->Values[part]; }
  };

  struct Vec3Parts
  {
    Parts<float> X;
    Parts<float> Y;
    Parts<float> Z;

    void Set(int part, const glm::vec3& value);
  };

  /// A node: the bounds of its children as a structure of arrays.
  struct Node
  {
    Vec3Parts Center;
    Vec3Parts HalfSize;
    Parts<float> Radius; // of the sphere around the box
    Parts<float> Power;  // 0 if there is no child
    Vec3Parts Axis;
    Parts<float> CosCone; // below -1 for light all around
    Parts<float> SinCone;
    Parts<float> TwoSided;      // whether the cone's opposite counts, too: 1 or 0
    Parts<float> Beyond;        // the factor of the light beyond the cone: 1 or 0
    Parts<std::uint32_t> Next;  // another group, or the first of a leaf's lights
    Parts<std::uint32_t> Count; // of a leaf's lights; 0 for a group
    std::uint32_t Parent;
    int ParentPart;
    int PartCount;
    bool HasCones = false; // whether any light does not emit all around

    void Set(int part, const LightBounds& bounds, double totalPower);

    /// Estimates the light that may come from each child. Returns the sum.
    double FindImportances(const LightReceiver& receiver, Parts<float>& importances) const;
    void ThinByCones(const glm::vec3& position, Parts<float>& importances) const;
  };

  // A light in a leaf; or the position of a light: a child of a node.
  struct Entry
  {
    std::uint32_t Index;
    float Share; // of the light in the leaf's power
  };

  struct Item
  {
    LightBounds Bounds;
    std::uint32_t Light;
  };

  struct Range
  {
    std::size_t Begin;
    std::size_t End;
    LightBounds Bounds;
    bool CanSplit = true;
  };

  void Build(std::vector<Item>& items, const Range& range, std::uint32_t node);
  void MakeLeaf(const std::vector<Item>& items, const Range& range, std::uint32_t node, int part);
  static std::vector<Range> Divide(std::vector<Item>& items, const Range& range);
  static std::size_t Split(std::vector<Item>& items, const Range& range);
  static Range MakeRange(const std::vector<Item>& items, std::size_t begin, std::size_t end);

  std::vector<Node> Nodes;   // the root first
  std::vector<Entry> Lights; // of the leaves
  std::vector<Entry> Leaves; // of each light
  double TotalPower = 0.0;
};
}

#endif
