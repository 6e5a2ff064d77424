// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFRadianceCacheOptions
 * @brief   accuracy and cost of the radiance cache of a path tracer
 *
 * Used if the integrator of vtkCSLFPathTracer is radiance caching. Several path tracers may share
 * one object.
 *
 * @sa vtkCSLFPathTracer
 */
#ifndef vtkCSLFRadianceCacheOptions_h
#define vtkCSLFRadianceCacheOptions_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkObject.h"

class VTKCSLF_EXPORT vtkCSLFRadianceCacheOptions : public vtkObject
{
public:
  static vtkCSLFRadianceCacheOptions* New();
  vtkTypeMacro(vtkCSLFRadianceCacheOptions, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The bias of radiance caching, as a fraction of displayed white (sRGB-encoded, the path tracer's
   * Exposure included). Points are added where the error of interpolation would exceed this value,
   * until their distance is Spacing. One and a half standard errors of each point are also kept
   * below this value, as far as Samples allows, and so is the root mean square error of reflections
   * that are looked up. For byte output, values above white are clipped and need not be accurate.
   * For floating-point output, a viewer may change the exposure, so the tolerance holds at any
   * exposure from 1/16 to 16 times Exposure, which takes more paths. 0 is automatic, see
   * vtkCSLFPathTracer::SetQuality. Range: 0 to 1. Default: 0.
   */
  void SetTolerance(double tolerance);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * The smallest distance between points of the radiance cache, as a fraction of the diagonal of
   * the scene's bounds. This is about the width of the sharpest shadow edge. 0 selects 0.3 divided
   * by the number of texels or pixels along the longer side of a picture, about half a texel on the
   * far side of the cube, see vtkCSLFPathTracer::GetAutomaticCacheSpacing; for the quality Preview,
   * four times that. Range: 0 to 1. Default: 0.
   */
  void SetSpacing(double spacing);
  vtkGetMacro(Spacing, double);
  ///@}

  ///@{
  /**
   * The maximum number of paths for one point of the radiance cache. Small numbers are rounded:
   * below 64 to 32, and between 64 and 128 to 128. Light that is sampled at its source takes at
   * least 64. 0 is automatic, see vtkCSLFPathTracer::SetQuality. Range: 0 to 1048576. Default: 0.
   */
  void SetSamples(int samples);
  vtkGetMacro(Samples, int);
  ///@}

  ///@{
  /**
   * Whether to compare each new cache with path tracing, at up to 1024 random points of the texels
   * or pixels that the update will render, with 64 paths each; fewer points if little is to be
   * rendered. A warning is given if the cache differs by more than its bounds: 2 % of the mean
   * radiance, or three times Tolerance as a root mean square of displayed colours, each exceeded by
   * more than three standard errors. Default: on.
   */
  vtkSetMacro(Check, bool);
  vtkGetMacro(Check, bool);
  vtkBooleanMacro(Check, bool);
  ///@}

  /**
   * Takes the values of other options. Null is ignored.
   */
  void DeepCopy(vtkCSLFRadianceCacheOptions* source);

protected:
  vtkCSLFRadianceCacheOptions();
  ~vtkCSLFRadianceCacheOptions() override = default;

private:
  vtkCSLFRadianceCacheOptions(const vtkCSLFRadianceCacheOptions&) = delete;
  void operator=(const vtkCSLFRadianceCacheOptions&) = delete;

  double Tolerance;
  double Spacing;
  int Samples;
  bool Check;
};

#endif
