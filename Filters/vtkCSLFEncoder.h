// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFEncoder
 * @brief   writes a cube surface light field as a video, MP4 or Matroska
 *
 * vtkCSLFEncoder codes the image data of a light field: each viewpoint (z slice) becomes one frame
 * of three tracks, colour, coverage and depth, coded through FFmpeg's libavcodec as HEVC (paper,
 * section 3.4), AV1 or H.264. The coverage track is left out where coverage is full everywhere, the
 * depth track where the field has none. Any player built on FFmpeg shows the file; vtkCSLFDecoder
 * reads it back.
 *
 * The input is pulled in z slabs through the pipeline's update extents, so the whole field never
 * has to fit in memory: a slab has at most 32 viewpoints for each thread of vtkSMPTools, fewer
 * where they would exceed 512 MiB. The input's whole extent must be the whole field; a part that
 * was extracted along z is refused. Needed are `Color` as 4 unsigned chars or 4 floats and, if
 * present, `Depth` as unsigned short; further channels of the field are left out with a warning.
 * Video needs a resolution of at least 16 texels.
 *
 * Float colour, linear radiance times exposure, is coded with 12 bits (H.264: 10) through the
 * perceptual quantiser of SMPTE ST 2084, and comes back as floats, so exposure can still be changed
 * when it is looked at. Radiance 1 stands for 203 cd/m^2 (ITU-R BT.2408); what is negative or above
 * 49.26, the curve's end at 10000 cd/m^2, is clipped, with a warning. Alpha keeps 8 bits. Float
 * colour cannot be lossless.
 *
 * Instead of a rate factor, the file's size, its ratio to the raw colours, or the quality of its
 * colours may be asked for: TargetSize, TargetRatio, TargetPSNR. A sample of the viewpoints is then
 * coded on trial first, which may ask the input for them twice. With KeyViewStep, only a part of
 * the viewpoints, evenly spread, is asked for and coded: the file is a field of fewer viewpoints
 * (paper, section 3.3). Documentation/Compression.md tells how all this works.
 *
 * Viewpoints are coded in closed groups of at most GroupLength, first those of the coarsest nested
 * grid. Groups and tracks are coded side by side with vtkSMPTools, and the file has the same bytes
 * for any number of threads. While it grows, its parts lie in a folder named like the file with
 * `.partial` appended; the file itself appears whole, by renaming, and replaces an older one only
 * then, when its bytes are on the disk. Documentation/FileFormat.md specifies the file.
 *
 * A process that is killed, aborted or fails, on a full disk for instance, leaves that folder if it
 * has finished groups. The next one that writes the same field with the same settings and builds of
 * the libraries to the same file goes on from there: it asks its input for none of the viewpoints
 * whose groups are whole, but for the first one, and ends with the same bytes. What belongs to
 * another field or other settings is discarded, with a warning. To tell that, the field's
 * description and first viewpoint are compared, so an input must change one of them where it
 * changes any viewpoint; vtkCSLFSampler does, since it describes the scene by a hash. Two processes
 * cannot write one file at once: the second one fails.
 *
 * Where the input is fed by a path tracer that caches radiance, the finished cache lies in that
 * folder, too, and need not be made again by the next process. Several ranks make it together.
 *
 * With a controller of several ranks, which must be a vtkMPIController, all of them call Write
 * with the same settings and an input of their own that gives the same field. They share the work:
 * each asks for groups as it becomes free, pulls just their viewpoints from its own input, and
 * sends what it has coded to rank 0, which writes the file. The bytes are the same for any number
 * of ranks, and no other rank touches a file. Rank 0 reports the progress, and can abort. Where one
 * rank fails, all fail; the lowest of them reports its error, and Write returns 0 on all.
 *
 * @sa
 * vtkCSLFDecoder vtkCSLFSampler
 */
#ifndef vtkCSLFEncoder_h
#define vtkCSLFEncoder_h

#include "vtkAlgorithm.h"
#include "vtkCSLFModule.h" // For export macro

#include <memory> // For std::unique_ptr

class vtkImageData;
class vtkMultiProcessController;
class vtkUnsignedCharArray;

namespace cslf
{
class EncodeSession;
struct EncodeFault;
struct EncodeJob;
}

class VTKCSLF_EXPORT vtkCSLFEncoder : public vtkAlgorithm
{
public:
  static vtkCSLFEncoder* New();
  vtkTypeMacro(vtkCSLFEncoder, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set/get the file to write. Its extension, .mp4 or .mkv, chooses the container.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * Set/get the codec: "hevc", coded by x265; "av1", by SVT-AV1, or by libaom where that cannot
   * (4:4:4, a resolution below 64); or "h264", by x264. An FFmpeg that lacks them is an error that
   * lists what it has. Default hevc, the only one that can be lossless.
   */
  vtkSetStringMacro(Codec);
  vtkGetStringMacro(Codec);
  ///@}

  /**
   * Whether this FFmpeg can encode with a codec of that name.
   */
  static bool CanEncode(const char* codec);

  ///@{
  /**
   * Set/get the constant rate factor of colour, from 0 (best) to 51 (smallest). About 6 more halve
   * the size. The scale is x265's; x264 has the same, and for AV1 the whole number on its own scale
   * is taken that gives about the same quality. Default 22.
   */
  vtkSetClampMacro(CRF, double, 0.0, 51.0);
  vtkGetMacro(CRF, double);
  ///@}

  ///@{
  /**
   * Set/get how many times smaller than the raw colours, 3 bytes a texel, the file shall be: all
   * tracks and the container count. The rate factors follow; it is met within 3 %. 0 for no such
   * target. Only one of the three targets may be set, and none together with Lossless; where one is
   * out of reach, an error tells what is within. Default 0.
   */
  vtkSetClampMacro(TargetRatio, double, 0.0, 1e9);
  vtkGetMacro(TargetRatio, double);
  ///@}

  ///@{
  /**
   * Set/get how many bytes the file shall have, likewise. Default 0: no such target.
   */
  vtkSetClampMacro(TargetSize, double, 0.0, 1e18);
  vtkGetMacro(TargetSize, double);
  ///@}

  ///@{
  /**
   * Set/get the PSNR, in dB, that decoded colours shall have against those of the input: red, green
   * and blue of 8 bits over black, one mean square error over all texels. It is met within 0.3 dB,
   * otherwise like TargetRatio. Default 0: no such target.
   */
  vtkSetClampMacro(TargetPSNR, double, 0.0, 100.0);
  vtkGetMacro(TargetPSNR, double);
  ///@}

  ///@{
  /**
   * Set/get the constant rate factor of coverage, from 0 to 51. Where a target chooses colour's,
   * and that is above 22, coverage's rises by as much as colour's is above 22. Default 24: novel
   * views lose less than 0.3 dB by it, see Documentation/Compression.md.
   */
  vtkSetClampMacro(CoverageCRF, double, 0.0, 51.0);
  vtkGetMacro(CoverageCRF, double);
  ///@}

  ///@{
  /**
   * Set/get the constant rate factor of depth, from 0 to 51. Where a target chooses colour's, it
   * rises like coverage's. Default 8: lookups that correct by depth need it exact. It is
   * coded by a curve that is finer near the entry face.
   */
  vtkSetClampMacro(DepthCRF, double, 0.0, 51.0);
  vtkGetMacro(DepthCRF, double);
  ///@}

  ///@{
  /**
   * Set/get x265's preset, which trades time for size: ultrafast, superfast, veryfast, faster,
   * fast, medium, slow, slower, veryslow or placebo. x264 has the same, and those of AV1's encoders
   * are taken that are alike. Default slow, for colour with the rate-distortion analysis of slower:
   * at equal quality, colour is a fifth to a quarter smaller than with medium, and takes four
   * times the time.
   */
  vtkSetStringMacro(Preset);
  vtkGetStringMacro(Preset);
  ///@}

  ///@{
  /**
   * Set/get the pixel format of colour: auto, yuv444p, yuv444p10le, yuv422p, yuv420p, yuv420p10le
   * or gbrp (HEVC only); for float colour auto, yuv444p10le or yuv444p12le. Formats other than
   * 4:4:4 lose much of saturated colours; yuv420p is what every player and hardware decoder knows.
   * 4:2:0 and 4:2:2 need an even resolution. Default auto: yuv444p, but for AV1 yuv420p10le, which
   * is all that SVT-AV1 has; for others it takes libaom, which is slow.
   */
  vtkSetStringMacro(PixelFormat);
  vtkGetStringMacro(PixelFormat);
  ///@}

  ///@{
  /**
   * Set/get the most frames of a closed group, from 1 to 16: what a decoder has to decode at most
   * for one viewpoint. Default 16.
   */
  vtkSetClampMacro(GroupLength, int, 1, 16);
  vtkGetMacro(GroupLength, int);
  ///@}

  ///@{
  /**
   * Set/get whether all channels are kept bit for bit. The rate factors and the pixel format are
   * then ignored: colour is coded as planar RGB and depth as two tracks, its high and its low
   * bytes. Default off.
   */
  vtkSetMacro(Lossless, bool);
  vtkGetMacro(Lossless, bool);
  vtkBooleanMacro(Lossless, bool);
  ///@}

  ///@{
  /**
   * Set/get of how many viewpoints along each side of a face one is kept as a key view: those on
   * the edges, and between them as few as leave no gap of more than that many, evenly spread. It is
   * at most the number of viewpoints less 1. AutomaticKeyViews stands for the largest step that
   * reaches TargetNovelViewPSNR. Default 1: all are kept.
   */
  enum
  {
    AutomaticKeyViews = 0
  };
  vtkSetClampMacro(KeyViewStep, int, AutomaticKeyViews, VTK_INT_MAX);
  vtkGetMacro(KeyViewStep, int);
  void SetKeyViewStepToAutomatic() { this->SetKeyViewStep(AutomaticKeyViews); }
  ///@}

  ///@{
  /**
   * Set/get the PSNR, in dB, that viewpoints which are left out shall have when they are looked up
   * from the key views with depth (without depth, with the focus at the cube's centre), before
   * coding; red, green and blue of 8 bits over black, of floats at the exposure from 1/16 to 16
   * times the baked one where it is lowest. It is measured on a seeded sample of viewpoints and
   * texels. Where no key views reach it, an error tells what the best have. Only
   * for AutomaticKeyViews. Default 35.
   */
  vtkSetClampMacro(TargetNovelViewPSNR, double, 0.0, 100.0);
  vtkGetMacro(TargetNovelViewPSNR, double);
  ///@}

  ///@{
  /**
   * What files carry besides the light field, such as a mesh of the scene or a table: bytes, and a
   * media type such as "model/gltf-binary" or "text/csv" that tells what they are. A name tells
   * parts of one type apart. Type and name have at most 100 bytes of UTF-8, all parts together 12
   * MiB; otherwise AddPart returns false, with an error. The bytes are copied. Parts survive where
   * FFmpeg remuxes a file, and vtkCSLFDecoder gives them back. Only those of rank 0 count. Default:
   * no parts.
   */
  bool AddPart(const char* type, vtkUnsignedCharArray* bytes, const char* name = nullptr);
  int GetNumberOfParts() const;
  void RemoveAllParts();
  ///@}

  ///@{
  /**
   * Set/get whether to go on from what an interrupted run left of the same file. If off, all
   * begins anew. Default on.
   */
  vtkSetMacro(Restart, bool);
  vtkGetMacro(Restart, bool);
  vtkBooleanMacro(Restart, bool);
  ///@}

  ///@{
  /**
   * Set/get what connects the processes that write the file together; see above. Null for writing
   * alone. Default: the global controller.
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
   * Writes the file, on all ranks of the controller together. Returns 1 on success; otherwise 0,
   * and the error code tells the kind of error.
   */
  virtual int Write();

  ///@{
  /**
   * What the last Write made, on rank 0, all 0 if it failed: the mean rate factor of colour over
   * all viewpoints, the bytes of the file, its ratio in the sense of TargetRatio, and its PSNR in
   * the sense of TargetPSNR, for which each group is decoded again. The PSNR is at most 100, and 0
   * for lossless files and float colour, of which it is not measured.
   */
  vtkGetMacro(ActualCRF, double);
  vtkGetMacro(ActualSize, double);
  vtkGetMacro(ActualRatio, double);
  vtkGetMacro(ActualPSNR, double);
  ///@}

  ///@{
  /**
   * The step of key views of that file, and, where it was chosen, their PSNR in the sense of
   * TargetNovelViewPSNR, otherwise 0.
   */
  vtkGetMacro(ActualKeyViewStep, int);
  vtkGetMacro(ActualNovelViewPSNR, double);
  ///@}

  /**
   * Writes the file where the pipeline asks for data.
   */
  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

protected:
  vtkCSLFEncoder();
  ~vtkCSLFEncoder() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkCSLFEncoder(const vtkCSLFEncoder&) = delete;
  void operator=(const vtkCSLFEncoder&) = delete;

  class CacheKeeping;
  class PartList;
  cslf::EncodeFault FindFault();
  cslf::EncodeJob MakeJob();
  bool Report(const cslf::EncodeSession& session);

  cslf::EncodeSession* Session = nullptr; // while Write is at work
  const std::unique_ptr<PartList> Parts;
  vtkMultiProcessController* Controller = nullptr;
  char* FileName = nullptr;
  char* Codec = nullptr;
  double CRF = 22.0;
  double TargetRatio = 0.0;
  double TargetSize = 0.0;
  double TargetPSNR = 0.0;
  double CoverageCRF = 24.0;
  double DepthCRF = 8.0;
  char* Preset = nullptr;
  char* PixelFormat = nullptr;
  int GroupLength = 16;
  bool Lossless = false;
  int KeyViewStep = 1;
  double TargetNovelViewPSNR = 35.0;
  bool Restart = true;
  double ActualCRF = 0.0;
  double ActualSize = 0.0;
  double ActualRatio = 0.0;
  double ActualPSNR = 0.0;
  int ActualKeyViewStep = 1;
  double ActualNovelViewPSNR = 0.0;
};

#endif
