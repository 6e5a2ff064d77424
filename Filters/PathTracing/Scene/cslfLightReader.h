// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reads the lights of data objects (vtkCSLFLight).
 */
#ifndef cslfLightReader_h
#define cslfLightReader_h

#include "PathTracing/Lights/cslfEnvironment.h"
#include "cslfScene.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <vector>

class vtkDataObject;

namespace cslf
{
/// Whether a data object, which may be null, contains an environment.
bool HasEnvironment(vtkDataObject* data);

/// Reads it. False if its arrays do not fit each other or are not finite.
bool ReadEnvironment(vtkDataObject* data, Environment& environment);

class LightReader
{
public:
  /// Reads the field data of a data object, which may be null.
  void Add(vtkDataObject* data);

  /// Lights added from now on come from another rank.
  void BeginRank();

  /// Makes the lights independent of order and ranks. Sorts them, and keeps one copy of lights that
  /// several ranks have, because field data comes with every piece of a data set. If one rank has a
  /// light several times, keeps as many copies.
  void Join();

  /// The lights or pairs of arrays that could not be used.
  int GetNumberOfRejected() const { return this->Rejected; }

  /// Adds the lights, in scene space.
  void MoveTo(LightSet& lights, const SceneFrame& frame) const;

private:
  struct Light
  {
    glm::dvec3 Place; // position, or direction
    glm::dvec3 Power; // intensity, or irradiance; negative values count as 0
    glm::dvec3 Axis{ 0.0 };
    double ConeAngle = 0.0; // in degrees
    double Exponent = 0.0;
    glm::dvec3 Attenuation{ 0.0, 0.0, 1.0 };
    double AttenuationExponent = 1.0;

    std::array<double, 15> GetNumbers() const
    {
      return { this->Place.x, this->Place.y, this->Place.z, this->Power.x, this->Power.y,
        this->Power.z, this->Axis.x, this->Axis.y, this->Axis.z, this->ConeAngle, this->Exponent,
        this->Attenuation.x, this->Attenuation.y, this->Attenuation.z, this->AttenuationExponent };
    }
  };

  /// The lights of one kind, and the start of the lights of each rank after the first.
  struct LightList
  {
    std::vector<Light> Lights;
    std::vector<std::size_t> Begins;

    void Join();
  };

  void ReadDirectional(vtkDataObject* data);
  void ReadPoints(vtkDataObject* data);
  void ReadSpots(vtkDataObject* data);

  /// All lights of two arrays, not checked, so that further arrays still match them.
  std::vector<Light> Read(vtkDataObject* data, const char* places, const char* powers);

  /// Both return whether there are arrays that match the lights; attenuations may be missing.
  static bool ReadAttenuations(vtkDataObject* data, const char* name, std::vector<Light>& lights);
  static bool ReadCones(vtkDataObject* data, std::vector<Light>& spots);

  /// Adds a light if it is usable and finite; counts it as rejected if not.
  void AddIf(bool usable, Light light, LightList& list);

  LightList Directional;
  LightList Points;
  int Rejected = 0;
};
}

#endif
