// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The novel views for measuring a light field: their cameras, their references, and the pixels that
 * count.
 */
#ifndef cslfNovelViews_h
#define cslfNovelViews_h

#include "cslfCube.h"
#include "cslfTruth.h"

#include <vtkSmartPointer.h>

#include <vector>

class vtkCamera;
class vtkImageData;
class vtkImageStencilData;

namespace cslf::tool
{
class FieldRenderer;
struct NovelViewOptions;

/// Cameras around the cube, spread evenly over the sphere, or over the cap of 35 degrees around +Z
/// where the Cornell box opens.
std::vector<vtkSmartPointer<vtkCamera>> MakeNovelViews(
  const Cube& cube, int count, int seed, bool isCornellBox);

/// A view for measuring lookups.
struct NovelView
{
  vtkSmartPointer<vtkCamera> Camera;
  vtkSmartPointer<vtkImageData> Picture; ///< the reference, over black
  vtkSmartPointer<vtkImageStencilData> Stencil;
  double NoiseFloor = 0.0; ///< of the picture, in dB
};

/// Makes and traces square views of a field's cube. Throws a Failure.
std::vector<NovelView> TraceNovelViews(
  const SceneOptions& options, const Scene& scene, const Cube& cube, const NovelViewOptions& novel);

/// The quality of a lookup in the views, one figure for each view.
struct ViewQuality
{
  std::vector<double> PSNR; ///< in dB
  std::vector<double> SSIM;
};

/// Draws the views with a lookup, in the size of their pictures, and compares. Throws a Failure.
ViewQuality MeasureViews(FieldRenderer& renderer, int lookup, const std::vector<NovelView>& views);

/// Compares the change from one view to the next with that of the references: the PSNR in dB, at
/// most 60, of the difference between the errors of both, in the pixels of `stencil`. All pictures
/// are red, green and blue bytes of the same size.
double ComputeChangePSNR(vtkImageData* truthBefore, vtkImageData* pictureBefore,
  vtkImageData* truth, vtkImageData* picture, vtkImageStencilData* stencil);

/// The pixels whose ray meets the cube. Row 0 is at the bottom, as in VTK's images.
vtkSmartPointer<vtkImageStencilData> MakeCubeStencil(
  const Cube& cube, vtkCamera* camera, int width, int height);
}

#endif
