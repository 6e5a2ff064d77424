// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * References: path-traced views of a scene, kept in a folder if there is one.
 */
#ifndef cslfTruth_h
#define cslfTruth_h

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <string>

class vtkCSLFToneMapping;
class vtkCSLFViewTracer;
class vtkCamera;
class vtkImageData;
class vtkImageStencilData;

namespace cslf::tool
{
class Scene;
class SceneOptions;

/// A path-traced view as red, green and blue bytes over black, and its two halves, whose mean it
/// is.
struct Truth
{
  vtkSmartPointer<vtkImageData> Picture;
  vtkSmartPointer<vtkImageData> Halves[2];
};

/// The PSNR of the reference's own noise: the halves' difference has four times the variance of
/// their mean's error, so it is their PSNR plus 10 log10(4) dB.
double ComputeNoiseFloor(const Truth& truth, vtkImageStencilData* stencil);

class TruthTracer
{
public:
  /// If `folder` is not empty, traced pictures are kept in it, with one file of image data for each
  /// half, whose name depends on all settings. Existing ones are not traced again. Throws a Failure
  /// if the folder is not writable.
  TruthTracer(const SceneOptions& options, const Scene& scene, const std::string& folder);
  ~TruthTracer();

  /// Traces a square view with `samples` per pixel, half of them in each half, and applies the tone
  /// mapping. Throws a Failure.
  Truth Trace(vtkCamera* camera, int size, int samples, int seed, vtkCSLFToneMapping* toneMapping);

private:
  vtkSmartPointer<vtkImageData> GetHalf(vtkCamera* camera, int size, int samples, int seed);
  vtkSmartPointer<vtkImageData> TraceHalf(vtkCamera* camera, int size, int samples, int seed);
  std::string GetFileName(vtkCamera* camera, int size, int samples, int seed) const;

  vtkNew<vtkCSLFViewTracer> Tracer;
  std::string Folder;
  std::string Description; ///< of the scene and the settings of tracing
};
}

#endif
