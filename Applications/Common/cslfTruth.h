// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a scene truly looks like: path-traced views, kept in a folder where there is one.
 */
#ifndef cslfTruth_h
#define cslfTruth_h

#include "cslfToneMapping.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <string>

class vtkCSLFViewTracer;
class vtkCamera;
class vtkImageData;
class vtkImageStencilData;

namespace cslf
{
namespace tool
{
class Scene;
class SceneOptions;

/// A path-traced view as red, green and blue bytes over black, and the two halves it is the mean
/// of.
struct Truth
{
  vtkSmartPointer<vtkImageData> Picture;
  vtkSmartPointer<vtkImageData> Halves[2];
};

/// The PSNR that the truth's own noise leaves: the halves' difference has four times the variance
/// of their mean's error, so it is their PSNR plus 10 log10(4) dB.
double ComputeNoiseFloor(const Truth& truth, vtkImageStencilData* stencil);

class TruthTracer
{
public:
  /// What is traced is kept in `folder`, if that is not empty, one file of image data for each
  /// half, named after all that it depends on; what is there already is not traced again. Throws a
  /// Failure where the folder cannot be written to.
  TruthTracer(const SceneOptions& options, const Scene& scene, const std::string& folder);
  ~TruthTracer();

  /// Traces a square view with `samples` per pixel, half of them in each half, and shows it as
  /// bright as asked for. Throws a Failure.
  Truth Trace(
    vtkCamera* camera, int size, int samples, int seed, const ToneMapping& toneMapping = {});

private:
  vtkSmartPointer<vtkImageData> GetHalf(vtkCamera* camera, int size, int samples, int seed);
  vtkSmartPointer<vtkImageData> TraceHalf(vtkCamera* camera, int size, int samples, int seed);
  std::string GetFileName(vtkCamera* camera, int size, int samples, int seed) const;

  vtkNew<vtkCSLFViewTracer> Tracer;
  std::string Folder;
  std::string Description; ///< of the scene and how it is traced
};
}
}

#endif
