// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reads the lights that data objects carry (vtkCSLFLight).
 */
#ifndef cslfLightReader_h
#define cslfLightReader_h

#include "cslfScene.h"

#include <glm/vec3.hpp>

#include <vector>

class vtkDataObject;

namespace cslf
{
class LightReader
{
public:
  /// Reads the field data of a data object, which may be null.
  void Add(vtkDataObject* data);

  /// The lights or pairs of arrays that could not be used.
  int GetNumberOfRejected() const { return this->Rejected; }

  /// Adds the lights, in scene space.
  void MoveTo(LightSet& lights, const SceneFrame& frame) const;

private:
  struct Light
  {
    glm::dvec3 Place; // position, or direction
    glm::dvec3 Power; // intensity, or irradiance
    glm::dvec3 Axis{ 0.0 };
    double ConeAngle = 0.0; // in degrees
    double Exponent = 0.0;
  };

  void ReadSpots(vtkDataObject* data);
  void Read(vtkDataObject* data, const char* places, const char* powers, bool directions,
    std::vector<Light>& lights);

  std::vector<Light> Directional;
  std::vector<Light> Points;
  int Rejected = 0;
};
}

#endif
