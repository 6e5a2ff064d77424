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

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkCSLFToneMapping;
class vtkCSLFViewTracer;
class vtkCamera;
class vtkImageData;
class vtkImageStencilData;

namespace CLI
{
class App;
}

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

/// The PSNR of a picture without the reference's noise, whose squared error is added to that of the
/// picture: in dB, at most 60, and at most 13 dB above the noise floor.
double SubtractNoise(double psnr, double noiseFloor);

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

struct NovelViewOptions
{
  int Views = 6;
  int Size = 512;    ///< along each side, in pixels
  int Samples = 256; ///< per pixel of the reference
  int Seed = 1;
  std::string TruthFolder; ///< keeps the reference for later runs; if empty, it is not kept

  /// Adds --views, --size, --spp, --seed and --truth, under a heading of the help if there is one.
  void AddTo(CLI::App& command, const std::string& group = "Options");
};

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
