// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFDecoder
 * @brief   reads a cube surface light field from the video that vtkCSLFEncoder wrote
 *
 * The output is the field's image data, with `Color` as 4 unsigned chars, or as 4 floats if the
 * coded field had these, `Depth` as unsigned short if the file has it, and the field's description
 * in field data. The pipeline's information pass reads only the header of the container. If the
 * update extent requests a range of viewpoints (z slices), only the closed groups of frames that
 * contain them are read, and are decoded in parallel with vtkSMPTools. Along x and y, the output is
 * always whole.
 *
 * GetViewpoint returns single viewpoints in any order and decodes no more than necessary. Prefetch
 * decodes viewpoints in the background before they are needed. Decoded viewpoints are kept in a
 * cache of limited size, CacheSize, which the pipeline uses as well: if a range ends within a
 * group, the rest of the group is kept for the next range. A viewer that draws immediately and
 * refines later can use the decoder like this:
 *
 * @code
 *   decoder->Prefetch(needed);             // whenever the camera moves: the most urgent first
 *   if (decoder->IsViewpointReady(z))      // for each frame
 *     decoder->GetViewpoint(z, image);     // takes almost no time
 * @endcode
 *
 * Only one thread at a time may call these methods, as usual in VTK. No event is invoked from
 * another thread.
 *
 * The file stays open until another one is opened. If another file gets its name meanwhile, as
 * those of vtkCSLFEncoder do by renaming, the decoder still reads the one that it has opened; call
 * Modified to open the new one. If the file itself is overwritten or cut off, its viewpoints are
 * missing, and the message says that the file was changed while it was open.
 *
 * A process may fork at any time, as Python's multiprocessing does, except while another of its
 * threads is in one of these methods. Prefetching does not matter: fork waits until no viewpoint is
 * being decoded in the background, which takes no longer than decoding a group of frames. Both
 * processes may continue to use the decoder.
 *
 * Every group is checked by its checksums before memory is allocated for it and before it is
 * decoded. Viewpoints of damaged or truncated groups are left empty (coverage 0, depth 1). The
 * first request for one of them gives a single warning that lists the missing viewpoints of the
 * whole file, so a field that is read in parts is reported like one that is read at once. In the
 * following cases there is an error instead, and no output: AllowMissing is off, nothing in the
 * file can be read, or fewer than 1 in 64 viewpoints of a large range can be read. The file may
 * have been remuxed, for instance with `ffmpeg -map 0 -c copy`. Documentation/FileFormat.md
 * specifies it.
 *
 * @sa
 * vtkCSLFEncoder vtkCSLFSeriesReader
 */
#ifndef vtkCSLFDecoder_h
#define vtkCSLFDecoder_h

#include "vtkCSLFModule.h" // For export macro
#include "vtkImageAlgorithm.h"

#include <functional> // For std::function
#include <memory>     // For std::shared_ptr
#include <string>     // For std::string

namespace cslf
{
class FieldStore;
}

class vtkIdTypeArray;
class vtkImageData;
class vtkPolyData;
class vtkUnsignedCharArray;

class VTKCSLF_EXPORT vtkCSLFDecoder : public vtkImageAlgorithm
{
public:
  static vtkCSLFDecoder* New();
  vtkTypeMacro(vtkCSLFDecoder, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set/get the file to read. Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /**
   * Whether a file is a coded light field: 3 if it is, 0 if not. Reports no error.
   */
  int CanReadFile(VTK_FILEPATH const char* fileName);

  ///@{
  /**
   * The file extensions of coded light fields, and their description in file dialogs.
   */
  const char* GetFileExtensions() { return ".mp4 .mkv"; }
  const char* GetDescriptiveName() { return "Cube surface light field"; }
  ///@}

  ///@{
  /**
   * Information from the file, available after UpdateInformation: the field's description (JSON
   * text), the codec ("hevc", "av1" or "h264") and the pixel format of colour (for example
   * "yuv444p"). Empty before, and if the file could not be read.
   */
  const char* GetDescription() const;
  const char* GetCodecName() const;
  const char* GetPixelFormat() const;
  ///@}

  ///@{
  /**
   * The tracks of the file, available after UpdateInformation: their number, with colour first,
   * their contents ("color", "coverage", "depth", "depth-high" or "depth-low"), and the bytes of
   * their coded frames, for which the whole file is read. Null and 0 outside the range.
   */
  int GetNumberOfTracks() const;
  const char* GetTrackName(int track) const;
  vtkTypeInt64 GetTrackBytes(int track);
  ///@}

  /**
   * Whether the file has the field's geometry (see vtkCSLFEncoder::SetGeometryData), after
   * UpdateInformation. Output port 1 delivers it; otherwise, that port's output is empty.
   */
  bool HasGeometry() const;

  /**
   * The geometry, on output port 1. It is filled after Update(), which also reads the whole field,
   * or Update(1), which reads the geometry alone. Requests for a part of the field do not read it.
   */
  vtkPolyData* GetGeometry();

  ///@{
  /**
   * The additional parts of the file (see vtkCSLFEncoder::AddPart), available after
   * UpdateInformation: their number, and the type, name and bytes of each. The name may be empty.
   * Damaged parts are left out with a warning. Null outside the range. The array of a part remains
   * the same while the file is open, and nobody changes it later.
   */
  int GetNumberOfParts() const;
  const char* GetPartType(int part) const;
  const char* GetPartName(int part) const;
  vtkUnsignedCharArray* GetPart(int part);
  ///@}

  ///@{
  /**
   * The missing viewpoints (z) found by the last update or by FindMissingViewpoints, in ascending
   * order. Later updates make new arrays, so this one does not change.
   */
  vtkIdType GetNumberOfMissingViewpoints() const;
  vtkIdTypeArray* GetMissingViewpoints() const;
  ///@}

  /**
   * Whether the file is the preview of a light field that is still being written, or whose writing
   * was interrupted, see vtkCSLFEncoder. Such a file is intact but does not contain all viewpoints
   * yet. Available after UpdateInformation.
   */
  bool IsUnfinished() const;

  /**
   * Fills `viewpoints` with those that an unfinished file does not contain yet, in ascending order.
   * Empty if the file is complete or cannot be read.
   */
  void GetUnwrittenViewpoints(vtkIdTypeArray* viewpoints);

  ///@{
  /**
   * Whether viewpoints that are missing from a damaged or unfinished file are left empty, with a
   * warning, and listed in the array `MissingViewpoints` of the output's field data. If off,
   * requesting one of them is an error with the code vtkErrorCode::PrematureEndOfFileError.
   * Default: on.
   */
  vtkSetMacro(AllowMissing, bool);
  vtkGetMacro(AllowMissing, bool);
  vtkBooleanMacro(AllowMissing, bool);
  ///@}

  /**
   * Checks the whole file by its checksums without decoding it. Returns the number of missing
   * viewpoints, or -1: with an error if the file cannot be read, without an error if the check was
   * aborted.
   */
  vtkIdType FindMissingViewpoints();

  ///@{
  /**
   * The maximum number of bytes of decoded viewpoints to keep for GetViewpoint, Prefetch and ranges
   * that contain the same groups. A viewpoint takes 20 N^2 bytes, or 30 N^2 with depth, at a
   * resolution of N. The most recently used viewpoints are kept. With 0 none are kept, and Prefetch
   * does nothing. Viewpoints being decoded are not counted: in the background, that is up to a
   * group of 16 for each thread. Setting this does not invalidate the output. Default: 512 MiB.
   */
  void SetCacheSize(vtkTypeInt64 bytes);
  vtkGetMacro(CacheSize, vtkTypeInt64);
  ///@}

  /**
   * Fills `image` with one viewpoint: slice z of the output, with its absolute extent, arrays and
   * description. The viewpoint comes from the cache, or else is decoded now, together with the
   * frames of its group that it depends on, with the tracks in parallel. The arrays are shared with
   * the cache: copy them before changing them. Returns false, with an error and an empty `image`,
   * if the file cannot be read, has no such viewpoint, or is damaged or unfinished there.
   */
  bool GetViewpoint(vtkIdType z, vtkImageData* image);

  /**
   * Decodes viewpoints in the background, in the given order as far as they are in different
   * groups. This replaces requests of an earlier call that are not yet begun; null or an empty
   * array ends prefetching. If CacheSize cannot hold all viewpoints, only the first ones are
   * decoded. Numbers outside of the range of viewpoints are ignored. Returns immediately.
   */
  void Prefetch(vtkIdTypeArray* viewpoints);

  /**
   * Whether GetViewpoint(z) does not need to decode anything, because the viewpoint is in the cache
   * or known to be missing.
   */
  bool IsViewpointReady(vtkIdType z);

  /**
   * Whether a viewpoint cannot be read because the file is damaged or unfinished there. That is an
   * error only if AllowMissing is off, once for the whole file. Decodes the viewpoint unless it is
   * in the cache. Returns true, with an error, if the file cannot be read or has no such viewpoint.
   */
  bool IsViewpointDamaged(vtkIdType z);

  /**
   * Waits until all requests of Prefetch are decoded.
   */
  void WaitForPrefetch();

  /**
   * Fills `viewpoints` with all viewpoints in file order, beginning with the coarsest grid. To read
   * all viewpoints in several steps, request them in this order, so that each group is decoded only
   * once. Empty if the file cannot be read.
   */
  void GetViewpointsInFileOrder(vtkIdTypeArray* viewpoints);

protected:
  vtkCSLFDecoder();
  ~vtkCSLFDecoder() override;

  /**
   * The file to open, in RequestInformation, for what is requested of output port 0. Empty if there
   * is none.
   */
  virtual std::string ChooseFile(vtkInformation* vtkNotUsed(request))
  {
    return this->FileName ? this->FileName : "";
  }

  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCSLFDecoder(const vtkCSLFDecoder&) = delete;
  void operator=(const vtkCSLFDecoder&) = delete;

  class Internals;

  bool Guard(const std::function<bool()>& work);
  bool Fail(unsigned long code, const std::string& problem);
  bool OpenFile();
  bool CheckRange(int first, int last);
  int ReadField(vtkInformationVector* outputVector);
  void ReadGeometry(vtkPolyData* output);
  void ReadRange(int first, int last, vtkImageData* output);
  bool ReportDamage();
  bool ReportFileDamage(const std::function<bool(double)>& progress);
  void RequireDamageAllowed();
  void WarnOfHeader();
  bool UpdateReader();
  bool RequireViewpoint(vtkIdType z);
  std::shared_ptr<cslf::FieldStore> GetStore();

  char* FileName = nullptr;
  vtkTypeInt64 CacheSize = 512 << 20;
  bool AllowMissing;
  const std::unique_ptr<Internals> Internal;
};

#endif
