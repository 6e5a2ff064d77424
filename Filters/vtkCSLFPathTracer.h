// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFPathTracer
 * @brief   superclass of the filters that path-trace a scene
 *
 * This is the superclass of vtkCSLFSampler, which makes a light field, and vtkCSLFViewTracer, which
 * makes the picture of one camera. Input port 0 takes any number of connections, each a
 * vtkPolyData, vtkMultiBlockDataSet or vtkPartitionedDataSetCollection with leaves of vtkPolyData.
 * Together they form the scene. A vtkRenderer can contribute to the scene as well, see SetRenderer.
 *
 * - Polygons and triangle strips are traced as triangles, vertex cells as spheres, and lines as
 * tubes with round ends. Their radius is set by vtkCSLFMaterial or, for each point, by a point-data
 * array named `CSLF:PointRadius` or `CSLF:LineRadius`, in world units. Leaves of other types and
 * cells with coordinates that are not finite are left out, and one warning names them. Triangles
 * without area are invisible and are left out silently. A scene without anything to trace is an
 * error.
 * - Data that has instances is shown at each of them, see vtkCSLFInstances.
 * - Surfaces are two-sided unless their material says otherwise. Point normals, if present, give
 * smooth shading.
 * - Materials, textures and lights are field data, see vtkCSLFMaterial and vtkCSLFLight.
 * - Rays pass surfaces with an opacity below 1 at random. Alpha is the fraction of rays that end on
 * a surface. Depth is that of the first surface whose opacity is at least one half, if there is
 * one.
 * - With ScalarVisibility, the active scalars, or those that SetInputArrayToProcess selects (of
 * points, then of cells), replace the base colour. Unsigned chars of 3 or 4 components are sRGB
 * colours. All other scalars are mapped through LookupTable, or the array's own lookup table, or a
 * default table over the range of the arrays of all inputs. Colours of points are converted to
 * linear before they are interpolated. Their alpha multiplies the opacity. Data with finished
 * colours (see vtkCSLFMaterial), such as that of a renderer, keeps them.
 *
 * Light transport is path tracing. Light from emissive surfaces and environment images is sampled
 * both at its source and by the surface, and the power heuristic combines the two. From the fourth
 * reflection on, paths end by Russian roulette. MaximumDepth is the only bias.
 *
 * On processors of one kind with the same libraries, results depend only on the parameters, to the
 * last bit. They do not depend on the number of threads or on the requested part of the output. The
 * record of the sampling contains a hash ("arithmetic") that identifies the kind of processor. The
 * scene is built once, and again only if the inputs or the parameters that affect it change, so a
 * downstream filter can request the output piece by piece.
 *
 * During an update, GetProgressText() is the name of the phase, such as "Filling the radiance
 * cache", and GetProgress() the share of the update that is done. It never decreases. Aborting ends
 * each phase within about a second and leaves the output empty; the next update makes it.
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

class vtkCSLFEnvironment;
class vtkCSLFRadianceCacheOptions;
class vtkDataArraySelection;
class vtkDataObject;
class vtkMultiProcessController;
class vtkRenderer;
class vtkScalarsToColors;

namespace cslf
{
class CacheShare;
class ViewpointSamples;
struct BuiltScene;
struct CheckedPicture;
struct PictureLayout;
struct PixelBeam;
struct RayGrid;
struct RenderSettings;
struct TracedPixel;
}

class VTKCSLF_EXPORT vtkCSLFPathTracer : public vtkImageAlgorithm
{
public:
  vtkTypeMacro(vtkCSLFPathTracer, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Includes the modification times of the environment, the cache options, the lookup table and
   * everything that the renderer shows.
   */
  vtkMTimeType GetMTime() override;

  /**
   * The methods of light transport.
   */
  enum Integrators
  {
    PathTracing = 0, ///< traces every path to its end; MaximumDepth is the only bias
    RadianceCaching  ///< paths end at surfaces whose light is precomputed
  };

  ///@{
  /**
   * The method of light transport. Path tracing is the reference. Radiance caching computes the
   * light of diffuse surfaces, which looks the same from all directions, once, at points on the
   * surfaces that are as dense as the detail of the light requires. Paths end at the first diffuse
   * surface, where the light is interpolated between these points. Reflections of rough dielectrics
   * are looked up as well, if the arriving light is smooth enough and is not sampled at its source.
   * The remaining light is traced: mirrors, metals, glass and reflections of lamps. See
   * Documentation/LightTransport.md. Default: radiance caching in vtkCSLFSampler, path tracing in
   * vtkCSLFViewTracer.
   */
  void SetIntegrator(int integrator);
  vtkGetMacro(Integrator, int);
  /** Traces every path to its end: the reference, and slow. */
  void SetIntegratorToPathTracing() { this->SetIntegrator(PathTracing); }
  /** Looks up the light of diffuse surfaces, which is computed once. */
  void SetIntegratorToRadianceCaching() { this->SetIntegrator(RadianceCaching); }
  ///@}

  /**
   * What surfaces show.
   */
  enum ColorModes
  {
    Lit = 0, ///< the light that they reflect and emit
    Exact    ///< their own colours
  };

  ///@{
  /**
   * What surfaces show. If exact, every surface shows its own colour, as in a scalar bar, from all
   * directions: that of its scalars, texture or material, plus what it emits, clamped at white.
   * There is no light from elsewhere, no shadow and no reflection, metals and glass show their base
   * colour, and Integrator, MaximumDepth and Exposure have no effect. Colours and textures are
   * interpolated as displayed values. Scalars of points are interpolated before they are mapped, so
   * no colour is seen that the table does not contain, except with textures and with tables of
   * categories. A renderer's lights and the coefficients of its properties are ignored.
   * Opacity has the same meaning in both modes. Default: lit.
   */
  void SetColors(int colors);
  vtkGetMacro(Colors, int);
  /** The light that surfaces reflect and emit. */
  void SetColorsToLit() { this->SetColors(Lit); }
  /** Their own colours, as in a scalar bar. */
  void SetColorsToExact() { this->SetColors(Exact); }
  ///@}

  enum
  {
    Colored, ///< that of their colours
    Neutral  ///< that of a grey
  };

  ///@{
  /**
   * The light that surfaces reflect onto others whose colours a map of scalars tells, or which keep
   * arrays. Coloured: that of their colours, as in reality. Neutral: that of a grey of their mean
   * albedo, so that the light of fields does not depend on the map, and also fits the colours that
   * are chosen after the bake; then views differ from path tracing, and so does the certificate of
   * files. It needs radiance caching. Sharp mirrors still show colours, rough reflections that the
   * cache stores do not. Default: coloured.
   */
  void SetInterreflection(int interreflection);
  vtkGetMacro(Interreflection, int);
  /** That of their colours. */
  void SetInterreflectionToColored() { this->SetInterreflection(Colored); }
  /** That of a grey. */
  void SetInterreflectionToNeutral() { this->SetInterreflection(Neutral); }
  ///@}

  ///@{
  /**
   * The accuracy and cost of radiance caching. Null selects new options with the default values.
   */
  virtual void SetCacheOptions(vtkCSLFRadianceCacheOptions* cacheOptions);
  vtkCSLFRadianceCacheOptions* GetCacheOptions();
  ///@}

  /**
   * The spacing that 0 selects in the cache options for a quality, as a fraction of the diagonal of
   * the scene's bounds, for pictures with `size` texels or pixels along the longer side. Sizes
   * below 1 are treated as 1.
   */
  static double GetAutomaticCacheSpacing(int size, int quality = Good);

  ///@{
  /**
   * The results of the check of the cache. CheckedTexels is the number of compared texels or
   * pixels; it is 0 if there was no check or nothing was visible. CacheMeanDifference is the mean
   * radiance of the cache minus that of path tracing, as a fraction of the latter.
   * CacheRMSDifference is the root mean square difference of the displayed colours, as a fraction
   * of white, without the noise of the paths. The errors are their standard errors.
   */
  vtkGetMacro(CheckedTexels, int);
  vtkGetMacro(CacheMeanDifference, double);
  vtkGetMacro(CacheMeanDifferenceError, double);
  vtkGetMacro(CacheRMSDifference, double);
  vtkGetMacro(CacheRMSDifferenceError, double);
  ///@}

  /**
   * The actual spacing of the cache's points, as a fraction of the diagonal of the scene's bounds.
   * It is larger than the Spacing of the cache options, with a warning, if the scene would need too
   * many bricks. It is 0 without a cache.
   */
  vtkGetMacro(UsedCacheSpacing, double);

  /**
   * Qualities of the light, from fast to accurate.
   */
  enum Qualities
  {
    Preview = 0, ///< fast; noise is visible
    Good,        ///< for most purposes
    Best         ///< for references; takes several times longer than Good
  };

  ///@{
  /**
   * The quality of the light. It determines the parameters that are automatic, as they are by
   * default: Samples, NoiseTarget, and Tolerance and Samples of the cache options. The size of a
   * picture or field is independent of it. Preview: 4, 0.02, 1/16, 32. Good: 32, 0.004, 1/64, 512.
   * Best: 256, 0.001, 1/256, 4096. The automatic Spacing of the cache is four times larger for
   * Preview. Default: Good.
   */
  void SetQuality(int quality);
  vtkGetMacro(Quality, int);
  /** Fast; noise is visible. vtkCSLFEncoder codes such fields fast, too. */
  void SetQualityToPreview() { this->SetQuality(Preview); }
  /** For most purposes. */
  void SetQualityToGood() { this->SetQuality(Good); }
  /** For references; takes several times longer than Good. */
  void SetQualityToBest() { this->SetQuality(Best); }
  ///@}

  ///@{
  /**
   * The values in use: those that are set, or where these are automatic, those of the Quality.
   * With exact Colors, path tracing, without reflections, and an exposure of 1.
   */
  int GetUsedIntegrator();
  int GetUsedMaximumDepth();
  double GetUsedExposure();
  int GetUsedSamples();
  double GetUsedNoiseTarget();
  double GetUsedCacheTolerance();
  int GetUsedCacheSamples();
  ///@}

  ///@{
  /**
   * The number of paths for each texel or pixel, distributed over its area. Powers of two are
   * distributed best. 0 is automatic, see Quality. Range: 0 to 1048576. Default: 0.
   */
  void SetSamples(int samples);
  vtkGetMacro(Samples, int);
  ///@}

  ///@{
  /**
   * If above 0, sampling of a square of 4 x 4 texels ends early, at a power of two of samples, when
   * the standard error of their colours is at most this fraction of displayed white. 1/256 is one
   * level of 8 bits. For floating-point output, this holds at any exposure from 1/16 to 16 times
   * Exposure. Texels that see only cached light, or nothing, may need only one sample; all others
   * take at least 4 of the Samples. The mean of a texel is not biased, because only the radiance of
   * the other texels of its square determines its number of samples. With SurfaceTexels, only
   * samples whose colour counts are judged, and each texel goes on until it has two of them. 0
   * takes all Samples. Values below 0 are automatic, see Quality. Range: -1 to 1. Default: -1.
   */
  void SetNoiseTarget(double target);
  vtkGetMacro(NoiseTarget, double);
  ///@}

  ///@{
  /**
   * The maximum number of reflections of a path: 0 shows emission only, 1 adds direct light, and
   * higher values add indirect light. Each passage through a glass surface counts as a reflection.
   * Range: 0 to 1000. Default: 8.
   */
  void SetMaximumDepth(int depth);
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
   * The factor of the radiance before it is stored. At least 0. Default: 1.
   */
  void SetExposure(double exposure);
  vtkGetMacro(Exposure, double);
  ///@}

  ///@{
  /**
   * The light from infinitely far away. Default, and what null selects: a new environment with the
   * default values, which is white.
   */
  virtual void SetEnvironment(vtkCSLFEnvironment* environment);
  vtkCSLFEnvironment* GetEnvironment();
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
   * A renderer whose visible actors and lights are part of the scene, instead of or in addition to
   * input connections. The result is the same as for the output of a vtkCSLFSceneImporter as input;
   * its documentation describes the conversion of actors, properties and lights. The renderer's
   * lights replace the Environment. The renderer is not drawn and needs no window.
   * Changes of anything it shows are detected. It is not kept alive, but its scene is, see
   * vtkCSLFSceneImporter::SetRenderer. Default: none.
   */
  virtual void SetRenderer(vtkRenderer* renderer);
  vtkRenderer* GetRenderer();
  ///@}

  ///@{
  /**
   * Whether colours in the renderer's scene are interpolated as in its window, see
   * vtkCSLFSceneImporter. Inputs are not affected: their materials determine the interpolation,
   * which is linear in light by default. Default: on.
   */
  vtkSetMacro(InterpolateDisplayedColors, bool);
  vtkGetMacro(InterpolateDisplayedColors, bool);
  vtkBooleanMacro(InterpolateDisplayedColors, bool);
  ///@}

  ///@{
  /**
   * The lookup table that maps scalars to colours, with its own range. Default: none, see above.
   */
  virtual void SetLookupTable(vtkScalarsToColors* lookupTable);
  vtkScalarsToColors* GetLookupTable();
  ///@}

  ///@{
  /**
   * The cost of the output: the rays traced for it and their seconds, and for the cache, its rays,
   * seconds and stored values. The numbers are sums over all updates since a parameter changed, so
   * a downstream filter can request the output piece by piece.
   */
  vtkGetMacro(NumberOfRays, vtkTypeUInt64);
  vtkGetMacro(RenderSeconds, double);
  vtkGetMacro(NumberOfCacheRays, vtkTypeUInt64);
  vtkGetMacro(NumberOfCachePoints, vtkTypeUInt64);
  vtkGetMacro(CacheSeconds, double);
  ///@}

  ///@{
  /**
   * Whether each rank of the controller holds a piece of the scene.
   *
   * If on, each rank requests its own piece from its inputs, and every rank traces the whole scene,
   * with surfaces joined and sorted. The bytes are the same for any division of the scene,
   * including a single rank. Field data describes the whole scene and may come with every piece, so
   * equal lights of several ranks count as one light. The environment is that of the first rank
   * that has one. All ranks must update together whenever the scene changes; changes are detected
   * by the times of their pipelines, not of the data. If the input of one rank fails, the update
   * fails on all ranks, and each reports the reason. (This does not apply if an application such as
   * ParaView replaces the filter's executive.)
   *
   * If off, each rank requests the whole scene and traces what it receives. Use this if all ranks
   * read the same files. Default: off.
   */
  vtkSetMacro(DistributedScene, bool);
  vtkGetMacro(DistributedScene, bool);
  vtkBooleanMacro(DistributedScene, bool);
  ///@}

  /**
   * The size in bytes of the pieces of all ranks, which this rank received when a distributed scene
   * was last gathered; 0 if none was. The size is known before the pieces are sent: the first rank
   * warns if the scenes of the ranks on its computer may not fit into its memory.
   */
  vtkGetMacro(GatheredBytes, vtkTypeUInt64);

  ///@{
  /**
   * The controller of the ranks of a distributed scene. Default: the global controller.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  ///@{
  /**
   * If above 0, a missing radiance cache is not computed but probed, in about this number of
   * seconds. Use it to predict the cost of an update, or for approximate pictures. The result of a
   * probe is used for the same scene, even if other parameters change, until this is set to another
   * number. Values below 0 are treated as 0. ExpectedCacheSeconds is the predicted time to compute
   * the cache, or 0 if it exists. Used by vtkCSLFBakeEstimator. Default: 0.
   */
  virtual void SetCacheProbeSeconds(double seconds);
  vtkGetMacro(CacheProbeSeconds, double);
  vtkGetMacro(ExpectedCacheSeconds, double);
  ///@}

  /**
   * The hash of the scene of the last update, which is in the record of the sampling. Empty if
   * there is no scene.
   */
  std::string GetSceneHash();

  /**
   * Traces all paths, whatever the Integrator, of some pixels of the scene of the last update, with
   * its light, MaximumDepth and Exposure. Returns false if `progress`, which gets numbers from 0 to
   * 1, does. Used by vtkCSLFEncoder and vtkCSLFFieldCertifier.
   */
  VTK_WRAPEXCLUDE
  bool TracePixels(const std::vector<cslf::PixelBeam>& beams, int samples, int seed,
    const std::function<bool(double)>& progress, std::vector<cslf::TracedPixel>& pixels);

protected:
  vtkCSLFPathTracer();
  ~vtkCSLFPathTracer() override;

  vtkExecutive* CreateDefaultExecutive() override;
  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  /**
   * The scene of the inputs, or null after an error or if aborted. Valid until the next call.
   */
  const cslf::BuiltScene* UpdateScene(vtkInformationVector** inputVector);

  /**
   * The sampling and scene parameters as a JSON object, for the record: everything that affects the
   * texels, a hash of the scene, and the results of the check of the cache, if known. Call it after
   * UpdateScene.
   */
  std::string DescribeSampling();

  /**
   * Renders `count` slices, from number `first` on, of a picture of the scene that UpdateScene
   * returned, with progress. Returns false if aborted. The output has the arrays of the requested
   * channels. With `surfaceTexels`, only samples on the surface at a texel's centre give its
   * colour. The name is that of the phase.
   */
  bool Render(const cslf::CheckedPicture& whole, int first, int count,
    const cslf::ViewpointSamples& output, bool surfaceTexels, const char* name);

  /**
   * Renders single rays, the first of each grid, as such a picture would show them. Each becomes a
   * texel of the output. Returns false if aborted. The name is that of the phase.
   */
  bool RenderRays(const cslf::CheckedPicture& whole, const std::vector<cslf::RayGrid>& rays,
    const cslf::ViewpointSamples& output, const char* name);

  /**
   * Prepares such rendering: fills the cache, if one is used. With `isAgain`, one that is there is
   * used at once; otherwise ranks agree about it. Returns false if aborted.
   */
  bool PrepareRendering(
    const cslf::CheckedPicture& whole, bool isFloat, bool isAgain, cslf::RenderSettings& settings);

  /**
   * The arrays of point data that surfaces of the scene keep. Null for none, which is the default.
   */
  virtual vtkDataArraySelection* FindKeptArrays() { return nullptr; }

private:
  vtkCSLFPathTracer(const vtkCSLFPathTracer&) = delete;
  void operator=(const vtkCSLFPathTracer&) = delete;

  std::vector<vtkDataObject*> GetSceneInputs(vtkInformationVector** inputVector);
  void WritePipelineTimes(std::ostream& key);
  std::string MakeSceneKey(const std::vector<vtkDataObject*>& inputs);
  bool BuildScene(const std::vector<vtkDataObject*>& inputs);
  void GatherScene(std::vector<vtkSmartPointer<vtkDataObject>>& parts, std::vector<int>& ranks,
    std::string& error);
  cslf::RenderSettings GetRenderSettings();
  bool RenderTexels(const cslf::PictureLayout& layout, const cslf::RenderSettings& settings,
    const std::function<cslf::RayGrid(int slice, int tile)>& grids,
    const cslf::ViewpointSamples& output, const char* name);
  std::string MakeCacheKey(double spacing, double displayRange);
  bool UpdateCache(double spacing, double displayRange, const cslf::CheckedPicture* checked);
  bool FillCache();
  bool MeasureCache(const cslf::CheckedPicture& picture, cslf::CacheShare* ranks);
  void ReportCache();
  bool ProbeCache(double spacing, double displayRange);
  void MakeCache(double spacing, double displayRange, cslf::CacheShare* ranks);
  bool MustGather();

  int Colors;
  int Interreflection;
  int Integrator = PathTracing;
  int Quality;
  int Samples;
  double NoiseTarget;
  int MaximumDepth;
  int CheckedTexels = 0;
  double CacheMeanDifference = 0.0;
  double CacheMeanDifferenceError = 0.0;
  double CacheRMSDifference = 0.0;
  double CacheRMSDifferenceError = 0.0;
  double UsedCacheSpacing = 0.0;
  int Seed;
  double Exposure;
  bool ScalarVisibility;
  bool InterpolateDisplayedColors;
  vtkTypeUInt64 NumberOfRays = 0;
  vtkTypeUInt64 NumberOfCacheRays = 0;
  vtkTypeUInt64 NumberOfCachePoints = 0;
  double RenderSeconds = 0.0;
  double CacheSeconds = 0.0;
  double CacheProbeSeconds = 0.0;
  double ExpectedCacheSeconds = 0.0;
  vtkMTimeType CostTime = 0; // of the parameters that the cost belongs to
  bool DistributedScene;
  vtkTypeUInt64 GatheredBytes = 0;
  vtkMultiProcessController* Controller = nullptr;

  struct vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
