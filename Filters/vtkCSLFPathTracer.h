// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFPathTracer
 * @brief   what the filters that path-trace a scene have in common
 *
 * Superclass of vtkCSLFSampler, which makes a light field, and vtkCSLFViewTracer, which makes the
 * picture of one camera. Input port 0 takes any number of connections, each a vtkPolyData,
 * vtkMultiBlockDataSet or vtkPartitionedDataSetCollection (leaves of vtkPolyData); together they
 * are the scene. So is what a vtkRenderer shows: see SetRenderer.
 *
 * - Polygons and triangle strips are traced as triangles, vertex cells as spheres and lines as
 * tubes with round ends, of a radius that vtkCSLFMaterial tells, or for each point an array of
 * point data named `CSLF:PointRadius` or `CSLF:LineRadius`, in world units. Leaves of other types,
 * and cells with coordinates that are not finite, are left out, named in one warning. Triangles
 * without area show nothing and are left out silently. A scene without anything to trace is an
 * error.
 * - Data is shown at each of its instances, if it has any: see vtkCSLFInstances.
 * - Surfaces are two-sided unless their material says otherwise. Point normals, where present,
 * smooth the shading.
 * - Materials, textures and lights are field data: see vtkCSLFMaterial and vtkCSLFLight.
 * - Rays pass surfaces of an opacity below 1 by chance. Alpha is the share of rays that end on some
 * surface; depth is that of the first surface whose opacity is at least one half.
 * - With ScalarVisibility, the active scalars (or what SetInputArrayToProcess chooses: points, then
 * cells) replace the base colour: unsigned chars of 3 or 4 components are sRGB colours; all else is
 * mapped through LookupTable, or the array's own lookup table, or a default one over the range of
 * all inputs' arrays. Colours of points are interpolated after they are made linear; their alpha
 * multiplies the opacity.
 *
 * Light transport: path tracing, where light from surfaces that emit and from environment images
 * is sampled at its source as well as by the surface, combined by the power heuristic; from the
 * fourth reflection on, paths end by Russian roulette. The estimate has no bias but MaximumDepth.
 *
 * Results depend on the parameters only, to the last bit, on processors of one kind with the same
 * libraries: not on the number of threads, nor on the part of the output that is asked for. The
 * record of the sampling has a hash ("arithmetic") that tells processors apart. The scene is built
 * once, and again only when the inputs or the parameters that make it change, so a downstream
 * filter can pull the output piece by piece. Aborting leaves the output empty.
 */
#ifndef vtkCSLFPathTracer_h
#define vtkCSLFPathTracer_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkImageAlgorithm.h"
#include "vtkSmartPointer.h" // for vtkSmartPointer

#include <functional> // for std::function
#include <memory>     // for std::unique_ptr
#include <string>     // for std::string
#include <vector>     // for std::vector

class vtkCSLFEncoder;
class vtkDataObject;
class vtkMultiProcessController;
class vtkRenderer;
class vtkScalarsToColors;

namespace cslf
{
class CacheKeeper;
class CacheShare;
struct BuiltScene;
struct CheckedPicture;
struct PictureLayout;
struct RayGrid;
struct RenderSettings;
struct TexelOutput;
}

class VTKCSLF_EXPORT vtkCSLFPathTracer : public vtkImageAlgorithm
{
public:
  vtkTypeMacro(vtkCSLFPathTracer, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Takes the lookup table's time into account, and that of all that the renderer shows.
   */
  vtkMTimeType GetMTime() override;

  /**
   * The ways to follow light.
   */
  enum Integrators
  {
    PathTracing = 0, ///< every path to its end: no bias but MaximumDepth
    RadianceCaching  ///< paths end where the light of surfaces is worked out beforehand
  };

  ///@{
  /**
   * How light is followed. Path tracing is the reference. Radiance caching works out the light that
   * surfaces diffuse, which looks alike from everywhere, once, at points on them as dense as the
   * light's detail demands; paths then end at the first diffuse surface, where the light between
   * points is interpolated. Reflections of rough dielectrics are looked up, too, where the light
   * that arrives there is smooth enough and none is sampled at its source. What is left of a path
   * is what all else reflects or transmits: mirrors, metals, glass, the reflections of lamps.
   * Documentation/LightTransport.md tells more. Default: radiance caching in vtkCSLFSampler, path
   * tracing in vtkCSLFViewTracer.
   */
  vtkSetClampMacro(Integrator, int, PathTracing, RadianceCaching);
  vtkGetMacro(Integrator, int);
  void SetIntegratorToPathTracing() { this->SetIntegrator(PathTracing); }
  void SetIntegratorToRadianceCaching() { this->SetIntegrator(RadianceCaching); }
  ///@}

  ///@{
  /**
   * The bias of radiance caching: points are added where interpolation would err by more than this,
   * in parts of white as it is displayed (sRGB-encoded, Exposure included), until they are as close
   * as CacheSpacing. One and a half standard errors of each point are kept below it, too, where
   * CacheSamples allow, and so is the root mean square error of reflections that are looked up.
   * Where the output is bytes, what is brighter than white is clipped and need not be right. Where
   * it is floating point, a viewer may change the exposure: all this holds at any exposure from
   * 1/16 to 16 times Exposure, which takes more paths. Default: 1/128, two levels of 8 bits.
   */
  vtkSetClampMacro(CacheTolerance, double, 1e-6, 1.0);
  vtkGetMacro(CacheTolerance, double);
  ///@}

  ///@{
  /**
   * The smallest distance of radiance caching's points, in parts of the diagonal of the scene's
   * bounds: about the width of the sharpest shadow edge. 0 stands for 0.3 divided by the texels or
   * pixels along the longer side of a picture, about half a texel on the far side of the cube.
   * Default: 0.
   */
  vtkSetClampMacro(CacheSpacing, double, 0.0, 1.0);
  vtkGetMacro(CacheSpacing, double);
  ///@}

  /**
   * The spacing that 0 stands for, in parts of the diagonal of the scene's bounds, of pictures of
   * so many texels or pixels along the longer side. Sizes below 1 count as 1.
   */
  static double GetAutomaticCacheSpacing(int size);

  ///@{
  /**
   * The most paths for one point of radiance caching. At least 64. Default: 1024.
   */
  vtkSetClampMacro(CacheSamples, int, 64, VTK_INT_MAX);
  vtkGetMacro(CacheSamples, int);
  ///@}

  ///@{
  /**
   * Whether each new cache is compared with path tracing: at up to 1024 random points of the texels
   * or pixels that the update will render, by 64 paths each, fewer where little is to be rendered.
   * A warning tells where the cache differs by more than the bounds: 2 % of the mean radiance, or
   * three times CacheTolerance as a root mean square of displayed colours, each exceeded by more
   * than three standard errors. Default: on.
   */
  vtkSetMacro(CheckCache, bool);
  vtkGetMacro(CheckCache, bool);
  vtkBooleanMacro(CheckCache, bool);
  ///@}

  ///@{
  /**
   * What the check of the cache has found. CheckedTexels: how many texels or pixels were compared;
   * 0 where there was no check or nothing to see. CacheMeanDifference: the mean radiance by the
   * cache minus that by path tracing, in parts of the latter. CacheRMSDifference: the root mean
   * square difference of the displayed colours, in parts of white, without the noise of the paths.
   * The errors are their standard errors.
   */
  vtkGetMacro(CheckedTexels, int);
  vtkGetMacro(CacheMeanDifference, double);
  vtkGetMacro(CacheMeanDifferenceError, double);
  vtkGetMacro(CacheRMSDifference, double);
  vtkGetMacro(CacheRMSDifferenceError, double);
  ///@}

  /**
   * The spacing of the cache's points that was used, in parts of the diagonal of the scene's
   * bounds: larger than CacheSpacing, with a warning, where the scene would need too many bricks. 0
   * without a cache.
   */
  vtkGetMacro(UsedCacheSpacing, double);

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
   * Where above 0, sampling of a square of 4 x 4 texels ends early, at a power of two of samples,
   * when the standard error of their colours is at most this, in parts of displayed white: 1/256 is
   * one level of 8 bits. Where the output is floating point, this holds at any exposure from 1/16
   * to 16 times Exposure. Texels that see only what radiance caching knows, or nothing, may do with
   * one sample; all others have at least 4 of the Samples. The mean of a texel is not biased: only
   * the other texels of its square decide how many samples it takes. Default: 0, take all Samples.
   */
  vtkSetClampMacro(NoiseTarget, double, 0.0, 1.0);
  vtkGetMacro(NoiseTarget, double);
  ///@}

  ///@{
  /**
   * The number of reflections of the longest path: 0 shows emission only, 1 adds direct light, more
   * add indirect light. Each passage through a surface of glass counts as one. Default: 8.
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

  /**
   * The kinds of light from infinitely far away.
   */
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
   * A renderer whose visible actors and lights are a part of the scene, in place of input
   * connections or beside them: as by an input from a vtkCSLFSceneImporter, where it is told what
   * becomes of actors, properties and lights. Its lights take the place of the environment
   * parameters. Nothing is drawn, and no window is needed. Changes of anything it shows are
   * noticed. Default: none.
   */
  virtual void SetRenderer(vtkRenderer* renderer);
  vtkRenderer* GetRenderer();
  ///@}

  ///@{
  /**
   * Whether colours in the renderer's scene are interpolated as its window does: see
   * vtkCSLFSceneImporter. What comes from inputs is not affected: it is interpolated as its
   * materials say, by default as light. Default: on.
   */
  vtkSetMacro(InterpolateDisplayedColors, bool);
  vtkGetMacro(InterpolateDisplayedColors, bool);
  vtkBooleanMacro(InterpolateDisplayedColors, bool);
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
   * What the output cost: the rays traced for it and the seconds that took; the rays traced to fill
   * the cache, the seconds that took, and the values stored. Sums over all updates since a
   * parameter changed, so a downstream filter may pull the output piece by piece.
   */
  vtkGetMacro(NumberOfRays, vtkTypeUInt64);
  vtkGetMacro(RenderSeconds, double);
  vtkGetMacro(NumberOfCacheRays, vtkTypeUInt64);
  vtkGetMacro(NumberOfCachePoints, vtkTypeUInt64);
  vtkGetMacro(CacheSeconds, double);
  ///@}

  ///@{
  /**
   * Whether each rank of the controller holds a piece of the scene. If on, each rank asks its
   * inputs for its own piece, and every rank traces all, surfaces joined and sorted: the bytes are
   * the same however the scene is cut, also for one rank. Field data describes the whole of a scene
   * and may come with every piece, so equal lights of several ranks are one light; the environment
   * is that of the first rank that has one. All ranks must update together whenever the scene
   * changes, which they find by the times of their pipelines, not of the data. If the input of one
   * rank fails, the update fails on all of them, and each tells why. (Not so where an application
   * such as ParaView replaces the filter's executive.) If off, each rank asks for the whole scene
   * and traces what it gets: the choice where all ranks read the same files. Default: off.
   */
  vtkSetMacro(DistributedScene, bool);
  vtkGetMacro(DistributedScene, bool);
  vtkBooleanMacro(DistributedScene, bool);
  ///@}

  /**
   * The bytes of the pieces of all ranks, all of which came to this rank when a distributed scene
   * was last gathered; 0 if none was. Known before the pieces are sent: the first rank warns if the
   * scenes of the ranks on its computer may not fit into its memory.
   */
  vtkGetMacro(GatheredBytes, vtkTypeUInt64);

  ///@{
  /**
   * What connects the ranks of a distributed scene. Default: the global controller.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  ///@{
  /**
   * Where above 0, a radiance cache that is not there is not made but probed, in about so many
   * seconds: good for a look at what an update will cost, and for pictures that are roughly right.
   * What a probe found is used for the same scene, even if other parameters change, until this is
   * set to another number. Below 0 counts as 0.
   * The expected seconds are those that making the cache would take; 0 where it is there. Used by
   * vtkCSLFBakeEstimator. Default: 0.
   */
  virtual void SetCacheProbeSeconds(double seconds);
  vtkGetMacro(CacheProbeSeconds, double);
  vtkGetMacro(ExpectedCacheSeconds, double);
  ///@}

protected:
  vtkCSLFPathTracer();
  ~vtkCSLFPathTracer() override;

  vtkExecutive* CreateDefaultExecutive() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /**
   * The scene of the inputs, or null after an error. Valid until the next call.
   */
  const cslf::BuiltScene* UpdateScene(vtkInformationVector** inputVector);

  /**
   * The sampling and scene parameters as a JSON object, for the record: everything that the
   * texels depend on, a hash of the scene, and what the check of the cache has found, if that is
   * known. Call it after UpdateScene.
   */
  std::string DescribeSampling();

  /**
   * Renders a picture of the scene that UpdateScene returned, with progress. False when aborted.
   * The layout may be a part of the slices that the whole picture has.
   */
  bool Render(const cslf::PictureLayout& layout, int wholeSlices,
    const std::function<cslf::RayGrid(int slice, int tile)>& grids,
    const cslf::TexelOutput& output);

private:
  vtkCSLFPathTracer(const vtkCSLFPathTracer&) = delete;
  void operator=(const vtkCSLFPathTracer&) = delete;

  // vtkCSLFEncoder sets, while it writes a field, what shares the next cache with other ranks and
  // keeps it for a run that is started again; then null. It is not owned.
  friend class vtkCSLFEncoder;
  void SetCacheKeeper(cslf::CacheKeeper* keeper);

  std::vector<vtkDataObject*> GetSceneInputs(vtkInformationVector** inputVector);
  void WritePipelineTimes(std::ostream& key);
  std::string MakeSceneKey(const std::vector<vtkDataObject*>& inputs);
  bool BuildScene(const std::vector<vtkDataObject*>& inputs);
  void GatherScene(std::vector<vtkSmartPointer<vtkDataObject>>& parts, std::vector<int>& ranks,
    std::string& error);
  cslf::RenderSettings GetRenderSettings();
  std::string MakeCacheKey(double spacing, double displayRange);
  bool UpdateCache(
    double spacing, double displayRange, double share, const cslf::CheckedPicture* checked);
  bool FillCache(double share);
  void MeasureCache(const cslf::CheckedPicture& picture, cslf::CacheShare* ranks);
  void TellCache();
  bool ProbeCache(double spacing, double displayRange);
  void MakeCache(double spacing, double displayRange, cslf::CacheShare* ranks);
  bool MustGather();

  int Integrator = PathTracing;
  int Samples = 64;
  double NoiseTarget = 0.0;
  int MaximumDepth = 8;
  double CacheTolerance = 1.0 / 128;
  double CacheSpacing = 0.0;
  int CacheSamples = 1024;
  bool CheckCache = true;
  int CheckedTexels = 0;
  double CacheMeanDifference = 0.0;
  double CacheMeanDifferenceError = 0.0;
  double CacheRMSDifference = 0.0;
  double CacheRMSDifferenceError = 0.0;
  double UsedCacheSpacing = 0.0;
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
  bool InterpolateDisplayedColors = true;
  vtkTypeUInt64 NumberOfRays = 0;
  vtkTypeUInt64 NumberOfCacheRays = 0;
  vtkTypeUInt64 NumberOfCachePoints = 0;
  double RenderSeconds = 0.0;
  double CacheSeconds = 0.0;
  double CacheProbeSeconds = 0.0;
  double ExpectedCacheSeconds = 0.0;
  vtkMTimeType CostTime = 0; // of the parameters that the cost belongs to
  bool DistributedScene = false;
  vtkTypeUInt64 GatheredBytes = 0;
  vtkMultiProcessController* Controller = nullptr;

  struct vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
