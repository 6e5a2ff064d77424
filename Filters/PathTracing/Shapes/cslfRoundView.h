// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Samples the directions in which spheres and tubes are seen from a point outside, and computes the
 * density of these samples.
 */
#ifndef cslfRoundView_h
#define cslfRoundView_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfTube.h"

#include <glm/vec2.hpp>

namespace cslf
{
/// A point of a round shape, seen from another point. A density of 0 means that there is none.
struct RoundSample
{
  glm::vec3 Direction{ 0.0f }; ///< of unit length, towards the shape
  float Distance = 0.0f;
  float Along = 0.0f; ///< on a tube: as in Tube::FindAlong
  float Pdf = 0.0f;   ///< per solid angle
};

/// A sphere, sampled uniformly over the solid angle of its visible cap.
class VTKCSLF_EXPORT SphereView
{
public:
  SphereView(const glm::vec3& from, const glm::vec3& center, float radius);

  /// 0 if the point is not outside.
  float GetSolidAngle() const;

  /// The density in every direction that hits the sphere.
  float GetPdf() const;

  RoundSample Sample(const glm::vec2& u) const;

private:
  glm::vec3 Path; // to the centre
  float Radius;
  float Distance;         // of the centre
  float CapHeight = 0.0f; // 1 less the cosine of the cone's half angle
};

/**
 * A tube. Its two round ends are sampled as spheres, and the side between them as a cone: the
 * azimuth uniformly over the visible part, which is the same all along a cone, the place along the
 * tube in proportion to the inverse squared distance from the point (Kulla and Fajardo, "Importance
 * Sampling Techniques for Path Tracing in Participating Media", EGSR 2012). The three parts are
 * chosen approximately by their solid angles; ends at joints are not chosen. Samples of an end's
 * sphere inside the tube are rejected, so the density's integral may be less than 1.
 */
class VTKCSLF_EXPORT TubeView
{
public:
  TubeView(const glm::vec3& from, const Tube& tube);

  RoundSample Sample(const glm::vec2& u) const;

  /// The density of the direction of a ray that first hits the tube at about the given distance.
  float GetPdf(const glm::vec3& direction, float distance) const;

private:
  void LookAtSide();
  float EstimateEnd(int end) const;
  float EstimateSide() const;
  RoundSample SampleEnd(int end, const glm::vec2& u) const;
  RoundSample SampleSide(const glm::vec2& u) const;
  float GetSidePdf(float along, const glm::vec3& normal, const glm::vec3& path) const;

  glm::vec3 From;
  Tube Shape;
  SphereView Ends[2];
  float Shares[3] = { 0.0f, 0.0f, 0.0f }; // the probabilities of the start, the end and the side

  // Of the side: the plane through the axis and the point, and the line of the surface in that
  // plane that is nearest to the point.
  glm::vec3 Towards{ 0.0f }; // from the axis to the point, of unit length
  float AxisDistance = 0.0f; // of the point
  float CosSlant = 1.0f;     // of the angle between the surface and the axis
  float Azimuth = 0.0f;      // half of the visible range
  float LineHeight = 0.0f;   // of the point above the line's tangent plane
  float LinePlace = 0.0f;    // of the point's foot on the line
  float LineAngle = 0.0f;    // in which the line is seen
};
}

#endif
