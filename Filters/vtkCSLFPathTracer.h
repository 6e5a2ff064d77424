// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFPathTracer
 * @brief   what the filters that path-trace a scene have in common
 *
 * Superclass of vtkCSLFSampler, which makes a light field, and vtkCSLFViewTracer, which makes the
 * picture of one camera. Input port 0 takes any number of connections, each a vtkPolyData,
 * vtkMultiBlockDataSet or vtkPartitionedDataSetCollection (leaves of vtkPolyData); together they
 * are the scene.
 *
 * - Polygons and triangle strips are traced. Lines, vertex cells, leaves of other types, and
 * polygons with coordinates that are not finite are left out, named in one warning. Triangles
 * without area show nothing and are left out silently. A scene without any triangle is an error.
 * - Surfaces are two-sided. Point normals, where present, smooth the shading.
 * - Materials and lights are field data: see vtkCSLFMaterial and vtkCSLFLight.
 * - With ScalarVisibility, the active scalars (or what SetInputArrayToProcess chooses: points, then
 * cells) replace the base colour: unsigned chars of 3 or 4 components are sRGB colours; all else is
 * mapped through LookupTable, or the array's own lookup table, or a default one over the range of
 * all inputs' arrays. Colours of points are interpolated after they are made linear.
 *
 * Light transport: path tracing, where light from emissive triangles and environment images
 * is sampled at its source as well as by the surface, combined by the power heuristic; from the
 * fourth reflection on, paths end by Russian roulette. The estimate has no bias but MaximumDepth.
 *
 * Results depend on the parameters only, to the last bit: not on the number of threads, nor on the
 * part of the output that is asked for. The scene is built once, and again only when the inputs or
 * the parameters that make it change, so a downstream filter can pull the output piece by piece.
 * Aborting leaves the output empty.
 */
#ifndef vtkCSLFPathTracer_h
#define vtkCSLFPathTracer_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkImageAlgorithm.h"

#include <memory> // for std::unique_ptr
#include <string> // for std::string

class vtkMultiProcessController;
class vtkScalarsToColors;

namespace cslf
{
struct BuiltScene;
struct RenderSettings;
class TexelRenderer;
}

class VTKCSLF_EXPORT vtkCSLFPathTracer : public vtkImageAlgorithm
{
public:
  vtkTypeMacro(vtkCSLFPathTracer, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Takes the lookup table's time into account.
   */
  vtkMTimeType GetMTime() override;

  ///@{
  /**
   * The paths traced for each texel or pixel, spread over its area; powers of two are spread best.
   * At least 1. Default: 64.
   */
  vtkSetClampMacro(Samples, int, 1, VTK_INT_MAX);
  vtkGetMacro(Samples, int);
  ///@}

  ///@{
  /**
   * The number of reflections of the longest path: 0 shows emission only, 1 adds direct light, more
   * add indirect light. Default: 8.
   */
  vtkSetClampMacro(MaximumDepth, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumDepth, int);
  ///@}

  ///@{
  /**
   * The seed of all random numbers. Different seeds give independent noise. Default: 0.
   */
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * What radiance is multiplied by before it is stored. Not negative. Default: 1.
   */
  vtkSetClampMacro(Exposure, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Exposure, double);
  ///@}

  ///@{
  /**
   * Whether rays that miss the scene show the environment, with alpha 1, or nothing, with alpha 0.
   * Default: off.
   */
  vtkSetMacro(ShowEnvironment, bool);
  vtkGetMacro(ShowEnvironment, bool);
  vtkBooleanMacro(ShowEnvironment, bool);
  ///@}

  enum EnvironmentModes
  {
    NoEnvironment = 0,   ///< darkness
    ConstantEnvironment, ///< EnvironmentColor all around
    GradientEnvironment, ///< from EnvironmentBottomColor to EnvironmentColor, along EnvironmentUp
    ImageEnvironment     ///< the lat-long image EnvironmentFileName
  };

  ///@{
  /**
   * The light from infinitely far away. Default: constant, and white.
   */
  vtkSetClampMacro(EnvironmentMode, int, NoEnvironment, ImageEnvironment);
  vtkGetMacro(EnvironmentMode, int);
  void SetEnvironmentModeToNone() { this->SetEnvironmentMode(NoEnvironment); }
  void SetEnvironmentModeToConstant() { this->SetEnvironmentMode(ConstantEnvironment); }
  void SetEnvironmentModeToGradient() { this->SetEnvironmentMode(GradientEnvironment); }
  void SetEnvironmentModeToImage() { this->SetEnvironmentMode(ImageEnvironment); }
  ///@}

  ///@{
  /**
   * The colour of a constant environment, and of a gradient at its top: sRGB, in [0,1]. Default:
   * white.
   */
  vtkSetVector3Macro(EnvironmentColor, double);
  vtkGetVector3Macro(EnvironmentColor, double);
  ///@}

  ///@{
  /**
   * The colour of a gradient at its bottom: sRGB, in [0,1]. Between bottom and top, radiance is
   * linear in the height of the direction's unit vector. Default: 0.2, 0.2, 0.2.
   */
  vtkSetVector3Macro(EnvironmentBottomColor, double);
  vtkGetVector3Macro(EnvironmentBottomColor, double);
  ///@}

  ///@{
  /**
   * What the environment's linear radiance is multiplied by. Not negative. Default: 1.
   */
  vtkSetClampMacro(EnvironmentIntensity, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(EnvironmentIntensity, double);
  ///@}

  ///@{
  /**
   * A lat-long image in any format that OpenImageIO reads: floating-point formats hold linear
   * radiance, others sRGB, unless the file says otherwise. It lies around the scene like the
   * environment texture of a vtkRenderer: the image's middle is the direction +X, +Z is a quarter
   * of its width further right.
   */
  vtkSetFilePathMacro(EnvironmentFileName);
  vtkGetFilePathMacro(EnvironmentFileName);
  ///@}

  ///@{
  /**
   * The direction of a gradient's or an image's top, of any length but 0. For an image, +X is made
   * perpendicular to it. Default: 0, 1, 0.
   */
  vtkSetVector3Macro(EnvironmentUp, double);
  vtkGetVector3Macro(EnvironmentUp, double);
  ///@}

  ///@{
  /**
   * Whether scalars replace the base colour. Default: on.
   */
  vtkSetMacro(ScalarVisibility, bool);
  vtkGetMacro(ScalarVisibility, bool);
  vtkBooleanMacro(ScalarVisibility, bool);
  ///@}

  ///@{
  /**
   * What maps scalars to colours, with its own range. Default: none, see above.
   */
  virtual void SetLookupTable(vtkScalarsToColors* lookupTable);
  vtkScalarsToColors* GetLookupTable();
  ///@}

  ///@{
  /**
   * Whether each rank of the controller holds a piece of the scene, as where the inputs are read or
   * made in pieces. If on, each rank asks its inputs for its own piece, and every rank traces all
   * of them together, in the order of the ranks. Lights, which are field data and so may be on
   * every piece, are taken from the first rank that has some on an input, or on a leaf of it. All
   * ranks must update together whenever the scene changes. If off, each rank asks for the whole
   * scene and traces what it gets: the choice where all ranks read the same files. Default: off.
   */
  vtkSetMacro(DistributedScene, bool);
  vtkGetMacro(DistributedScene, bool);
  vtkBooleanMacro(DistributedScene, bool);
  ///@}

  ///@{
  /**
   * What connects the ranks of a distributed scene. Default: the global controller.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

protected:
  vtkCSLFPathTracer();
  ~vtkCSLFPathTracer() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /**
   * The scene of the inputs, or null after an error. Valid until the next call.
   */
  const cslf::BuiltScene* UpdateScene(vtkInformationVector** inputVector);

  /**
   * The parameters, as the renderer takes them.
   */
  cslf::RenderSettings GetRenderSettings();

  /**
   * The sampling and scene parameters as a JSON object, for the record: everything that the
   * texels depend on, and a hash of the scene. Call it after UpdateScene.
   */
  std::string DescribeSampling();

  /**
   * Renders with progress. False when aborted.
   */
  bool Render(const cslf::TexelRenderer& renderer);

private:
  vtkCSLFPathTracer(const vtkCSLFPathTracer&) = delete;
  void operator=(const vtkCSLFPathTracer&) = delete;

  std::string MakeSceneKey(vtkInformationVector** inputVector);
  bool BuildScene(vtkInformationVector** inputVector);
  bool MustGather();

  int Samples = 64;
  int MaximumDepth = 8;
  int Seed = 0;
  double Exposure = 1.0;
  bool ShowEnvironment = false;
  int EnvironmentMode = ConstantEnvironment;
  double EnvironmentColor[3] = { 1.0, 1.0, 1.0 };
  double EnvironmentBottomColor[3] = { 0.2, 0.2, 0.2 };
  double EnvironmentIntensity = 1.0;
  char* EnvironmentFileName = nullptr;
  double EnvironmentUp[3] = { 0.0, 1.0, 0.0 };
  bool ScalarVisibility = true;
  bool DistributedScene = false;
  vtkMultiProcessController* Controller = nullptr;

  struct vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
