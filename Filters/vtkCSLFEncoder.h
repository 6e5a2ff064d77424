// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFEncoder
 * @brief   writes a cube surface light field as a video, MP4 or Matroska
 *
 * vtkCSLFEncoder codes the image data of a light field: each viewpoint (z slice) becomes one frame
 * of three tracks, colour, coverage and depth. They are coded through FFmpeg's libavcodec as HEVC
 * (paper, section 3.4), AV1 or H.264. The coverage track is omitted if coverage is full everywhere,
 * and the depth track if the field has no depth; both are, if the geometry on input port 1 tells
 * them. Any player based on FFmpeg can show the file, and vtkCSLFDecoder reads it.
 *
 * The input is requested in z slabs through the pipeline's update extents, so the whole field never
 * has to fit in memory. A slab has at most 32 viewpoints for each thread of vtkSMPTools, and fewer
 * if they would exceed 512 MiB. The input's whole extent must be the whole field; a part that was
 * extracted along z is refused. The input needs `Color` as 4 unsigned chars or 4 floats and, if
 * present, `Depth` as unsigned short. Other channels of the field are left out with a warning.
 * Video needs a resolution of at least 16 texels.
 *
 * Float colour, linear radiance times exposure, is coded with 12 bits (H.264: 10) through the
 * perceptual quantizer of SMPTE ST 2084 and decoded to floats, so the exposure can still be changed
 * when the field is viewed. A radiance of 1 corresponds to 203 cd/m^2 (ITU-R BT.2408). Values that
 * are negative or above 49.26, the end of the curve at 10000 cd/m^2, are clipped with a warning.
 * Alpha keeps 8 bits. Float colour cannot be lossless.
 *
 * vtkCSLFRateControl sets the quality. Instead of a rate factor, it can set a target: the size of
 * the file (TargetSize), its ratio to the raw colours (TargetRatio), or the quality of its colours
 * (TargetPSNR). A sample of the viewpoints is then coded first, for which they may be requested
 * from the input twice. With KeyViewStep, only an evenly spread subset of the viewpoints is
 * requested and coded: the file is a field of fewer viewpoints (paper, section 3.3). See
 * Documentation/Compression.md.
 *
 * Viewpoints are coded in closed groups of at most GroupLength, beginning with those of the
 * coarsest nested grid. Groups and tracks are coded in parallel with vtkSMPTools, and the file has
 * the same bytes for any number of threads. While the file is written, its parts are in a folder
 * named like the file with `.partial` appended. The complete file appears by renaming, when its
 * bytes are on the disk, and replaces an older one only then, or never (Overwrite).
 * Documentation/FileFormat.md specifies the file.
 *
 * As soon as the coarsest grid is coded, that folder also has a preview: the file `preview.mp4` (or
 * `.mkv`) with all groups so far, which is replaced from time to time. Writing it takes at most one
 * second in fifty. vtkCSLFDecoder reads it, and vtkCSLFMapper draws the viewpoints that are there.
 *
 * If a process is killed, is aborted or fails, for example because the disk is full, it leaves that
 * folder with the groups that are finished. The next process that writes the same field to the same
 * file, with the same settings and builds of the libraries, resumes from there: it requests only
 * the viewpoints of missing groups, and the first viewpoint, and produces the same bytes. Parts of
 * another field or of other settings are discarded with a warning. They are detected by the field's
 * description and first viewpoint, so an input must change one of these if it changes any
 * viewpoint; vtkCSLFSampler does, because its description contains a hash of the scene. Two
 * processes cannot write one file at the same time: the second one fails.
 *
 * If the input is fed by a path tracer with radiance caching, the finished cache is stored in that
 * folder, too, and the next process need not compute it again. Several ranks compute it together.
 *
 * With a controller of several ranks, which must be a vtkMPIController, all of them call Write with
 * the same settings and their own inputs that produce the same field. They share the work: each
 * rank requests groups as it becomes free, reads only their viewpoints from its own input, and
 * sends the coded groups to rank 0, which writes the file. The bytes are the same for any number of
 * ranks, and no other rank accesses a file. Rank 0 reports the progress and can abort. If one rank
 * fails, all fail. The lowest failing rank reports its error, and Write returns 0 on all.
 *
 * If a vtkCSLFSampler feeds the input, the finished file is compared with the sampler's scene, and
 * carries the result (Certificate). Rank 0 does it.
 *
 * During Write, GetProgressText() is the name of the phase, also of those of the filters that feed
 * the input, and GetProgress() the share of all work, of these filters, too. AbortExecuteOn() ends
 * each phase within about a second, also theirs, and Write returns 0 with an error.
 *
 * @sa
 * vtkCSLFDecoder vtkCSLFFieldCertifier vtkCSLFRateControl vtkCSLFSampler
 */
#ifndef vtkCSLFEncoder_h
#define vtkCSLFEncoder_h

#include "vtkAlgorithm.h"
#include "vtkCSLFModule.h"   // For export macro
#include "vtkSmartPointer.h" // For vtkSmartPointer

#include <memory>   // For std::unique_ptr
#include <optional> // For std::optional
#include <string>   // For std::string
#include <vector>   // For std::vector

class vtkCSLFRateControl;
class vtkImageData;
class vtkMultiProcessController;
class vtkPolyData;
class vtkUnsignedCharArray;

namespace cslf
{
class EncodeSession;
struct Certificate;
struct Description;
struct EncodeError;
struct EncodeJob;
struct EncodeSettings;
struct FilePart;
}

class VTKCSLF_EXPORT vtkCSLFEncoder : public vtkAlgorithm
{
public:
  static vtkCSLFEncoder* New();
  vtkTypeMacro(vtkCSLFEncoder, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Includes the modification time of the rate control.
   */
  vtkMTimeType GetMTime() override;

  ///@{
  /**
   * Set/get the file to write. Its extension, .mp4 or .mkv, selects the container. Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * Set/get the codec: "hevc", coded by x265; "av1", coded by SVT-AV1, or by libaom if SVT-AV1 does
   * not support the field (4:4:4, a resolution below 64); or "h264", coded by x264. If FFmpeg lacks
   * the encoder, the error lists the available ones. Default: hevc, the only codec with a lossless
   * mode.
   */
  vtkSetStringMacro(Codec);
  vtkGetStringMacro(Codec);
  ///@}

  /**
   * Whether this FFmpeg can encode with the given codec.
   */
  static bool CanEncode(const char* codec);

  ///@{
  /**
   * Set/get the rate factors, targets and key views. Null selects new ones with the default values.
   */
  virtual void SetRateControl(vtkCSLFRateControl* rateControl);
  vtkCSLFRateControl* GetRateControl();
  ///@}

  ///@{
  /**
   * Set/get the x265 preset, which trades time for size: ultrafast, superfast, veryfast, faster,
   * fast, medium, slow, slower, veryslow or placebo. x264 has the same presets; the encoders of AV1
   * use equivalent ones. slow uses the rate-distortion analysis of slower for colour. At equal
   * quality, colour is a fifth to a quarter smaller than with medium, and takes four times as long.
   * auto is ultrafast if the field comes from a vtkCSLFSampler of quality Preview, else slow.
   * Default: auto.
   */
  vtkSetStringMacro(Preset);
  vtkGetStringMacro(Preset);
  ///@}

  /**
   * The preset in use: the one that is set or, where that is auto, that of the quality of the
   * sampler which feeds the encoder. Updates the information of the input.
   */
  std::string GetUsedPreset();

  ///@{
  /**
   * Set/get the pixel format of colour: auto, yuv444p, yuv444p10le, yuv422p, yuv420p, yuv420p10le
   * or gbrp (HEVC only); for float colour auto, yuv444p10le or yuv444p12le. Formats other than
   * 4:4:4 lose much of saturated colours. Every player and hardware decoder supports yuv420p. 4:2:0
   * and 4:2:2 need an even resolution. Default: auto, which is yuv444p, but yuv420p10le for AV1,
   * because SVT-AV1 supports nothing more; other formats of AV1 use libaom, which is slow.
   */
  vtkSetStringMacro(PixelFormat);
  vtkGetStringMacro(PixelFormat);
  ///@}

  ///@{
  /**
   * Set/get the maximum number of frames of a closed group, from 1 to 16. A decoder decodes at most
   * this number of frames to get one viewpoint. Default: 16.
   */
  void SetGroupLength(int length);
  vtkGetMacro(GroupLength, int);
  ///@}

  ///@{
  /**
   * Set/get whether all channels are kept exactly. The rate factors and the pixel format are then
   * ignored: colour is coded as planar RGB, and depth as two tracks with its high and its low
   * bytes. Default: off.
   */
  vtkSetMacro(Lossless, bool);
  vtkGetMacro(Lossless, bool);
  vtkBooleanMacro(Lossless, bool);
  ///@}

  ///@{
  /**
   * The field's geometry, which is optional, as on output port 1 of vtkCSLFSampler: triangles in
   * world coordinates, within the cube. It becomes a part of the file, with positions of 12 to 16
   * bits along each axis of its bounds (at least 64 steps in a texel's width, up to N = 1024), and
   * its point data `Color` and `BackColor` if they have the same type, and `ExactColor`. By
   * default, it also tells depth (see DepthFromGeometry). In a pipeline, use SetInputConnection
   * with port 1.
   */
  void SetGeometryData(vtkPolyData* geometry);
  ///@}

  ///@{
  /**
   * Set/get whether depth, coverage and exact colours are left out of the file if its geometry
   * tells them: readers draw the triangles as each viewpoint sees them. Colours beside silhouettes
   * are changed to those of the triangles. Used if the surfaces that the geometry lacks or hides
   * take at most 5 % of the texels of the middle viewpoint of each face, and not if the file is
   * lossless. Colours of bytes are left out where the geometry's are exact (point data
   * `ExactColor`), if they differ from the field's by at most 8 of 255 (root mean square) there. If
   * all of them are exact, no other viewpoints are requested. Default: on.
   */
  vtkSetMacro(DepthFromGeometry, bool);
  vtkGetMacro(DepthFromGeometry, bool);
  vtkBooleanMacro(DepthFromGeometry, bool);
  ///@}

  ///@{
  /**
   * Set/get whether a field that comes from a vtkCSLFSampler is compared with its scene when the
   * file is finished, and the file carries the result in the field's description: a certificate,
   * see vtkCSLFFieldCertifier. It takes about a second and, of fields whose geometry does not show
   * everything, a decoding. Fields without a sampler, or whose description names another scene than
   * the sampler has, have none. Default: on.
   */
  vtkSetMacro(Certificate, bool);
  vtkGetMacro(Certificate, bool);
  vtkBooleanMacro(Certificate, bool);
  ///@}

  ///@{
  /**
   * Additional parts that files carry besides the light field, such as a mesh of the scene or a
   * table. A part consists of bytes and a media type such as "model/gltf-binary" or "text/csv". A
   * name distinguishes parts of the same type. Type and name may have at most 100 bytes of UTF-8,
   * and all parts together 12 MiB; otherwise, and for a second part of the same type and name,
   * AddPart returns false, with an error. So it does for a geometry, which is input port 1. The
   * bytes are copied. Parts survive remuxing by FFmpeg, and vtkCSLFDecoder returns them. Only the
   * parts of rank 0 are used. Default: no parts.
   */
  bool AddPart(const char* type, vtkUnsignedCharArray* bytes, const char* name = nullptr);
  int GetNumberOfParts() const;
  void RemoveAllParts();
  ///@}

  ///@{
  /**
   * Set/get whether to resume an interrupted run of the same file. If off, writing starts from the
   * beginning. Default: on.
   */
  vtkSetMacro(Restart, bool);
  vtkGetMacro(Restart, bool);
  vtkBooleanMacro(Restart, bool);
  ///@}

  ///@{
  /**
   * Set/get whether an earlier file of that name is replaced. If off, Write fails if there is one
   * at the start and, keeping the finished groups for a restart, if one has appeared by the end.
   * Default: on.
   */
  vtkSetMacro(Overwrite, bool);
  vtkGetMacro(Overwrite, bool);
  vtkBooleanMacro(Overwrite, bool);
  ///@}

  ///@{
  /**
   * Set/get the controller of the processes that write the file together, see above. Null means
   * that this process writes alone. Default: the global controller.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  ///@{
  /**
   * Set/get the light field without a pipeline.
   */
  void SetInputData(vtkImageData* input);
  vtkImageData* GetInput();
  ///@}

  /**
   * Writes the file, on all ranks of the controller together. Returns 1 on success. Otherwise it
   * returns 0, and the error code states the kind of error.
   */
  virtual int Write();

  /**
   * A record of all that the file's bytes depend on besides the field: the settings, the parts and
   * the versions of the libraries, as JSON text. Updates the information of the input. Used by
   * vtkCSLFSeriesWriter.
   */
  std::string MakeRecord();

  ///@{
  /**
   * The results of the last Write on rank 0, all 0 if it failed: the mean rate factor of colour
   * over all viewpoints, the size of the file in bytes, its ratio and its PSNR as defined by the
   * targets of vtkCSLFRateControl. For the PSNR, each group is decoded again. It is at most 100. It
   * is 0 for lossless files, float colour and fields that their geometry tells completely, for
   * which it is not measured.
   */
  vtkGetMacro(ActualCRF, double);
  vtkGetMacro(ActualSize, double);
  vtkGetMacro(ActualRatio, double);
  vtkGetMacro(ActualPSNR, double);
  ///@}

  ///@{
  /**
   * The step of key views of that file and, if it was chosen automatically, their PSNR as defined
   * by TargetNovelViewPSNR, otherwise 0.
   */
  vtkGetMacro(ActualKeyViewStep, int);
  vtkGetMacro(ActualNovelViewPSNR, double);
  ///@}

  ///@{
  /**
   * Whether readers of that file compute depth, and coverage if it is not full, from its geometry
   * (see DepthFromGeometry). In the viewpoints that were tried, the shares of the texels with a
   * surface, from 0 to 1, that the geometry lacks or hides, and whose colours readers compute from
   * it; 0 if none were.
   */
  vtkGetMacro(ActualDepthFromGeometry, bool);
  vtkGetMacro(ActualGeometryLoss, double);
  vtkGetMacro(ActualColorFromGeometry, double);
  ///@}

  ///@{
  /**
   * How many groups of viewpoints the file has, and how many of them an interrupted run had left.
   * Known on rank 0 from the first ProgressEvent of Write that follows the first viewpoint; 0
   * before.
   */
  vtkGetMacro(NumberOfGroups, int);
  vtkGetMacro(ResumedGroups, int);
  ///@}

  /**
   * Writes the file when the pipeline requests data.
   */
  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

protected:
  vtkCSLFEncoder();
  ~vtkCSLFEncoder() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkCSLFEncoder(const vtkCSLFEncoder&) = delete;
  void operator=(const vtkCSLFEncoder&) = delete;

  std::optional<cslf::FilePart> MakePart(vtkPolyData* geometry, const cslf::Description& field,
    const std::vector<cslf::FilePart>& others);

  class PartList;
  std::string FindPreset();
  std::optional<cslf::Certificate> Certify(const std::string& fileName);
  cslf::EncodeError FindError();
  cslf::EncodeSettings FindSettings();
  cslf::EncodeJob MakeJob();
  bool Report(const cslf::EncodeSession& session);
  bool CopyPart(const char* type, vtkUnsignedCharArray* bytes, const char* name);
  int WriteInput();
  bool UpdateInputs();
  void WriteRequested();

  cslf::EncodeSession* Session = nullptr; // while Write is at work
  vtkSmartPointer<vtkCSLFRateControl> RateControl;
  const std::unique_ptr<PartList> Parts;
  vtkMultiProcessController* Controller = nullptr;
  char* FileName = nullptr;
  char* Codec = nullptr;
  char* Preset = nullptr;
  char* PixelFormat = nullptr;
  int GroupLength;
  bool Lossless;
  bool DepthFromGeometry;
  bool Certificate;
  bool Restart;
  bool Overwrite = true;
  double ActualCRF = 0.0;
  double ActualSize = 0.0;
  double ActualRatio = 0.0;
  double ActualPSNR = 0.0;
  int ActualKeyViewStep = 1;
  double ActualNovelViewPSNR = 0.0;
  bool ActualDepthFromGeometry = false;
  double ActualGeometryLoss = 0.0;
  double ActualColorFromGeometry = 0.0;
  int NumberOfGroups = 0;
  int ResumedGroups = 0;
};

#endif
