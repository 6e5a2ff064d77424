// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFSampler
 * @brief   path-trace the cube surface light field of a scene
 *
 * The output is the light field of the scene on input port 0, as image data of dimensions (5N, N,
 * 6M^2). Each slice is the view from one of M x M viewpoints on each of the cube's 6 faces: a strip
 * of 5 tiles of N x N texels, one for each other face. See Ai, Wang, Kou, "CSLF: Cube Surface Light
 * Field and Its Sampling, Compression, Real-Time Rendering", 2021, section 3.2. Point data:
 *
 * - `Color`: the radiance that leaves through a texel towards the viewpoint, averaged over the
 * texel or one surface in it (SurfaceTexels), times the exposure; as 4 unsigned chars (sRGB-encoded
 * mean of the samples that hit a surface, times alpha) or 4 floats (linear, associated alpha).
 * Alpha is the covered fraction of the texel.
 * - `Depth`: the first intersection of the ray to the texel's centre with a surface whose opacity
 * is at least one half, as a fraction of the distance from the viewpoint to the texel's centre,
 * with 0 to 1 stored as 0 to 65535. If there is none, it is that with the last surface that is not
 * invisible; if this ray misses, but alpha is above 0, the depth of the sample nearest to the
 * centre. If alpha is 0, or the centre shows the environment, it is 65535.
 *
 * Field data holds the light field's description.
 *
 * Output port 1 is the field's geometry, for vtkCSLFMapper and vtkCSLFEncoder: the scene's opaque
 * surfaces as triangles in world coordinates. Spheres, tubes and instances are tessellated, parts
 * that no viewpoint sees are left out, and the rest is simplified to GeometryTriangles. Point
 * scalars are `Color`, of the same type as that of the field: the light that leaves the front along
 * the normal. `BackColor` is that of the back, where corners run
 * clockwise; there is none if nobody sees any back. Surfaces that look the same from all directions
 * have as many triangles as their light needs, within the limit, so that it can be interpolated;
 * where that shows them well, `ExactColor` is 1 or, if it is brighter than white, more (two
 * components, of the front and the back), and mappers ask no viewpoint. Field data holds
 * `GeometryError`, the root mean square distance of the scene's visible surfaces from the
 * triangles, and `GeometryLoss`, the share of them that is more than a texel away and does not
 * count in the former. Above 0.2, the filter warns, and mappers do not use it. Surfaces that are
 * translucent, or visible from one side only, are not in it: the filter warns of them,
 * `GeometryOpaqueLoss`, that of the others, takes the place of `GeometryLoss`, and mappers look
 * them up by depth. Update() makes it with the field, and Update(1) makes it alone. Consumers that
 * request parts of the field do not make it. It is made once, until something changes.
 *
 * The cube must strictly contain the scene; otherwise the filter reports an error.
 *
 * Update extents can request any range of viewpoints (z slices); x and y are always whole. Pieces,
 * as requested by the ranks of ParaView, are such ranges.
 *
 * @sa vtkCSLFViewTracer vtkCSLFMaterial vtkCSLFLight vtkCSLFCornellBoxSource
 */
#ifndef vtkCSLFSampler_h
#define vtkCSLFSampler_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkCSLFPathTracer.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <optional>
#include <string>

class vtkDataArraySelection;
class vtkPolyData;

namespace cslf
{
struct BuiltScene;
struct Description;
struct Geometry;
struct SideColors;
}

class VTKCSLF_EXPORT vtkCSLFSampler : public vtkCSLFPathTracer
{
public:
  static vtkCSLFSampler* New();
  vtkTypeMacro(vtkCSLFSampler, vtkCSLFPathTracer);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * M, the number of viewpoints along each side of a face: from 2 to 1024. Default: 17.
   */
  void SetViewpoints(int viewpoints);
  vtkGetMacro(Viewpoints, int);
  ///@}

  ///@{
  /**
   * N, the number of texels along each side of a tile: from 1 to 8192. Default: 128.
   */
  void SetResolution(int resolution);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * Whether the cube is computed from the scene. If on, it is centred on the scene's bounding box,
   * and its edge is the longest side of that box times (1 + 2 Offset). If off, CubeCenter and
   * CubeEdges set it. Default: on.
   */
  vtkSetMacro(AutomaticCube, bool);
  vtkGetMacro(AutomaticCube, bool);
  vtkBooleanMacro(AutomaticCube, bool);
  ///@}

  ///@{
  /**
   * The margin of an automatic cube on each side of the scene, as a fraction of the scene's longest
   * side. Range: 1e-6 to 1e6. Default: 0.05.
   */
  void SetOffset(double offset);
  vtkGetMacro(Offset, double);
  ///@}

  ///@{
  /**
   * The centre of a cube that is not automatic, in world coordinates. Default: 0, 0, 0.
   */
  vtkSetVector3Macro(CubeCenter, double);
  vtkGetVector3Macro(CubeCenter, double);
  ///@}

  ///@{
  /**
   * The lengths of the three edges of a cube that is not automatic, in world coordinates: above 0.
   * Default: 2, 2, 2.
   */
  vtkSetVector3Macro(CubeEdges, double);
  vtkGetVector3Macro(CubeEdges, double);
  ///@}

  ///@{
  /**
   * The type of `Color`: VTK_UNSIGNED_CHAR or VTK_FLOAT. Default: VTK_UNSIGNED_CHAR.
   */
  vtkSetMacro(ColorType, int);
  vtkGetMacro(ColorType, int);
  /** sRGB-encoded bytes, for display as they are. */
  void SetColorTypeToUnsignedChar() { this->SetColorType(VTK_UNSIGNED_CHAR); }
  /** Linear radiance, whose exposure can be changed when it is displayed. */
  void SetColorTypeToFloat() { this->SetColorType(VTK_FLOAT); }
  ///@}

  ///@{
  /**
   * Whether a texel's colour is the mean of only those of its samples that lie on the surface at
   * its centre: within three quarters of a texel's width of its plane. Otherwise it is the mean of
   * all, as in the paper, so texels at the edges of surfaces mix their colours. The geometry and
   * depth lookups gain by surfaces, because they know which surface they look for. Alpha is the
   * covered fraction of all samples in both cases. Texels whose centre sees nothing, or a surface
   * that is not opaque, are means of all samples. Default: on.
   */
  vtkSetMacro(SurfaceTexels, bool);
  vtkGetMacro(SurfaceTexels, bool);
  vtkBooleanMacro(SurfaceTexels, bool);
  ///@}

  ///@{
  /**
   * The most triangles of the geometry on output port 1. There are fewer where that moves surfaces
   * by less than a tenth of a texel, but none has edges of more than 32 texels if they suffice.
   * Small spheres, sticks and instances may have five times as many, because files store one of
   * them and where the others are. 0 means no geometry: the port's output is empty. Default:
   * 1000000.
   */
  void SetGeometryTriangles(int triangles);
  vtkGetMacro(GeometryTriangles, int);
  ///@}

  /**
   * The geometry, on output port 1. It is filled after Update() or Update(1).
   */
  vtkPolyData* GetGeometry();

  /**
   * The seconds that making the geometry took.
   */
  vtkGetMacro(GeometrySeconds, double);

  ///@{
  /**
   * Whether to generate the array `Depth`: its entry in the selection of channels. Default: on.
   */
  void SetGenerateDepth(bool generate);
  bool GetGenerateDepth();
  vtkBooleanMacro(GenerateDepth, bool);
  ///@}

  /**
   * The channels that can be sampled besides `Color`, by the names of their arrays, and which of
   * them are. Other names have no effect. Default: only `Depth` is enabled.
   */
  vtkDataArraySelection* GetChannelSelection();

  /**
   * The arrays of points and cells, by name, that the geometry keeps besides what gave its surfaces
   * their colours, so that vtkCSLFMapper can show them later: numbers of one or more components.
   * They cost some bytes of the file, and triangles where they vary. Surfaces of one colour get
   * light apart from it. Arrays that are not listed are kept if SetUnknownArraySetting(1) says so.
   * Surfaces that do not look the same from all directions, or whose points or cells have colours
   * that no map tells, have none: a warning names arrays that no surface keeps. Default: none.
   */
  vtkDataArraySelection* GetSurfaceArraySelection();

  /**
   * Includes the modification times of both selections.
   */
  vtkMTimeType GetMTime() override;

  /**
   * Updates the scene without sampling it, and returns a record of all that the field depends on: a
   * hash of the scene and the parameters, as JSON text. Fields of equal records are equal. Empty
   * after an error or if aborted. Used by vtkCSLFSeriesWriter.
   */
  std::string UpdateRecord();

  /**
   * The bounds of the scene of the last update, in world coordinates, with the radii of points and
   * lines. Default: 0, 1 along each axis.
   */
  vtkGetVector6Macro(SceneBounds, double);

protected:
  vtkCSLFSampler();
  ~vtkCSLFSampler() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  vtkDataArraySelection* FindKeptArrays() override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkCSLFSampler(const vtkCSLFSampler&) = delete;
  void operator=(const vtkCSLFSampler&) = delete;

  bool CheckParameters();
  bool Describe(const cslf::BuiltScene& scene, cslf::Description& description);
  bool SampleField(const cslf::CheckedPicture& whole, cslf::Description& description,
    vtkInformation* info, bool hasGeometry);
  void UpdateGeometry(const cslf::BuiltScene& scene, const cslf::Description& description,
    const cslf::CheckedPicture& whole);
  std::optional<cslf::Geometry> MakeSurface(const cslf::BuiltScene& scene,
    const cslf::Description& description, const cslf::CheckedPicture& whole);
  void WarnOfArrays(const cslf::BuiltScene& scene);
  void DropOthers(const cslf::BuiltScene& scene, vtkInformationVector* outputVector);
  std::string MakeRecord(const cslf::BuiltScene& scene, const cslf::Description& description);
  bool RenderSides(
    const cslf::CheckedPicture& whole, const cslf::Geometry& geometry, cslf::SideColors& colors);

  int Viewpoints;
  int Resolution;
  bool AutomaticCube;
  double Offset;
  int GeometryTriangles;
  bool SurfaceTexels;
  double GeometrySeconds = 0.0;
  vtkSmartPointer<vtkPolyData> Geometry; // null unless it was made
  std::string GeometryKey;               // what it was made for
  std::string OutputScene;               // the hash of that of the outputs
  std::string Record;                    // of the field, as of the last update
  bool IsSceneAlone = false;             // whether an update makes no output
  double SceneBounds[6] = { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 };
  double CubeCenter[3] = { 0.0, 0.0, 0.0 };
  double CubeEdges[3] = { 2.0, 2.0, 2.0 };
  int ColorType = VTK_UNSIGNED_CHAR;
  vtkNew<vtkDataArraySelection> ChannelSelection;
  vtkNew<vtkDataArraySelection> SurfaceArraySelection;
};

#endif
