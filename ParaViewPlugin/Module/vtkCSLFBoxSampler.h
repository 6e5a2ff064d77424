// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFBoxSampler
 * @brief   vtkCSLFSampler with its cube in the terms of ParaView's interactive box
 *
 * A cube that is not automatic is set by its lowest corner and its lengths, instead of CubeCenter
 * and CubeEdges. It is wider than the box by a thousandth of the longest length on each side, so
 * that it contains inputs that the box exactly encloses.
 *
 * The field data of the output has the legends of the colours that were baked.
 *
 * @sa vtkCSLFSampler
 */
#ifndef vtkCSLFBoxSampler_h
#define vtkCSLFBoxSampler_h

#include "vtkCSLFEnvironment.h"
#include "vtkCSLFParaViewModule.h" // for export macro
#include "vtkCSLFRadianceCacheOptions.h"
#include "vtkCSLFSampler.h"

class vtkDataObject;
class vtkFieldData;

class VTKCSLFPARAVIEW_EXPORT vtkCSLFBoxSampler : public vtkCSLFSampler
{
public:
  static vtkCSLFBoxSampler* New();
  vtkTypeMacro(vtkCSLFBoxSampler, vtkCSLFSampler);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The corner of the lowest coordinates, in world coordinates. Default: -1, -1, -1.
   */
  void SetCubePosition(double x, double y, double z);

  /**
   * The lengths of the edges, in world coordinates: above 0. Default: 2, 2, 2.
   */
  void SetCubeLengths(double x, double y, double z);

  ///@{
  /**
   * Reference bounds, if they are used. They are scaled by CubeLengths and moved by CubePosition to
   * make the box, as in ParaView's other boxes. Default: off, 0, 1, 0, 1, 0, 1.
   */
  void SetUseReferenceBounds(bool use);
  void SetReferenceBounds(
    double xMin, double xMax, double yMin, double yMax, double zMin, double zMax);
  ///@}

  ///@{
  /**
   * Set the environment, see vtkCSLFEnvironment, and the accuracy of radiance caching, see
   * vtkCSLFRadianceCacheOptions. ParaView's properties need setters of the filter.
   */
  void SetEnvironmentMode(int mode) { this->GetEnvironment()->SetMode(mode); }
  void SetEnvironmentColor(double r, double g, double b)
  {
    this->GetEnvironment()->SetColor(r, g, b);
  }
  void SetEnvironmentBottomColor(double r, double g, double b)
  {
    this->GetEnvironment()->SetBottomColor(r, g, b);
  }
  void SetEnvironmentIntensity(double intensity)
  {
    this->GetEnvironment()->SetIntensity(intensity);
  }
  void SetEnvironmentFileName(const char* fileName)
  {
    this->GetEnvironment()->SetFileName(fileName);
  }
  void SetEnvironmentUp(double x, double y, double z) { this->GetEnvironment()->SetUp(x, y, z); }
  void SetShowEnvironment(bool show) { this->GetEnvironment()->SetShow(show); }
  void SetCacheTolerance(double tolerance) { this->GetCacheOptions()->SetTolerance(tolerance); }
  void SetCacheSamples(int samples) { this->GetCacheOptions()->SetSamples(samples); }
  void SetCheckCache(bool check) { this->GetCacheOptions()->SetCheck(check); }
  ///@}

protected:
  vtkCSLFBoxSampler() = default;
  ~vtkCSLFBoxSampler() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCSLFBoxSampler(const vtkCSLFBoxSampler&) = delete;
  void operator=(const vtkCSLFBoxSampler&) = delete;

  void UpdateCube();
  void AddLegends(vtkInformationVector* inputs, vtkFieldData* fields);
  bool IsMapped(vtkDataObject* input);

  double CubePosition[3] = { -1.0, -1.0, -1.0 };
  double CubeLengths[3] = { 2.0, 2.0, 2.0 };
  bool UseReferenceBounds = false;
  double ReferenceBounds[6] = { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 };
};

#endif
