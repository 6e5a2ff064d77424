// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A path-traced view that refines while it is shown.
 */
#ifndef cslfRefiningTruth_h
#define cslfRefiningTruth_h

#include "Scenes/cslfSceneFiles.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <vector>

class vtkCSLFToneMapping;
class vtkCSLFViewTracer;
class vtkCamera;
class vtkImageData;

namespace cslf::tool
{
class RefiningTruth
{
public:
  /// The options define how the scene is traced.
  RefiningTruth(const SceneOptions& options, const Scene& scene);
  ~RefiningTruth();
  RefiningTruth(const RefiningTruth&) = delete;
  RefiningTruth& operator=(const RefiningTruth&) = delete;

  /// Whether the picture shows this view in this size.
  bool Shows(vtkCamera* camera, const int size[2]) const;

  /// Adds a pass to the view's picture, or begins a picture for a new view. Passes take more
  /// samples if they are fast, so that the window stays responsive, but no pixel gets more than
  /// `mostSamples`. Throws a Failure.
  void Refine(vtkCamera* camera, const int size[2], int mostSamples);

  /// The samples per pixel so far.
  int GetSamples() const { return this->Samples; }

  /// The picture as displayed over a background.
  vtkSmartPointer<vtkImageData> MakePicture(
    vtkCSLFToneMapping* toneMapping, const double background[3]) const;

private:
  vtkNew<vtkCSLFViewTracer> Tracer;
  vtkNew<vtkCamera> Camera; ///< of the picture
  int Size[2] = { 0, 0 };
  int Samples = 0;
  int Passes = 0;
  int PassSamples = 1;      ///< of the next pass
  std::vector<double> Sums; ///< linear red, green, blue and coverage, of all samples
};
}

#endif
