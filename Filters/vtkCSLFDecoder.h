// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFDecoder
 * @brief   reads a cube surface light field from the video that vtkCSLFEncoder wrote
 *
 * The output is the field's image data, with `Color` as 4 unsigned chars, or 4 floats where the
 * field that was coded had these, `Depth` as unsigned short if the file has it, and the field's
 * description in field data. The pipeline's information pass reads the container's header only. A
 * range of viewpoints (z slices) asked for through the update extent is decoded without the rest:
 * only the closed groups of frames that it touches are read, and decoded side by side with
 * vtkSMPTools. Along x and y the output is always whole.
 *
 * Single viewpoints, in any order, are had from GetViewpoint, which decodes no more than it takes
 * to get at one, and Prefetch has viewpoints decoded in the background before they are needed. What
 * was decoded is kept within a budget of memory, CacheSize, which the pipeline uses, too: if a
 * range ends within a group, the rest of the group is kept for the range that may come next. A
 * viewer that wants to draw at once and sharpen later goes like this:
 *
 * @code
 *   decoder->Prefetch(needed);             // whenever the camera moves: the most urgent first
 *   if (decoder->IsViewpointReady(z))      // for each frame
 *     decoder->GetViewpoint(z, image);     // costs next to nothing
 * @endcode
 *
 * One thread at a time may call these methods, as usual. No event is invoked from another thread.
 *
 * Every group is checked against its checksums before memory is taken for it and before it is
 * decoded. Viewpoints of groups that are damaged or cut off are left empty (coverage 0, depth 1).
 * The first time that any of them is asked for, one warning tells which of the whole file are
 * missing, so that a field that is pulled in parts is as well reported as one that is pulled at
 * once. It is an error instead, and there is no output, with AllowMissing off, where nothing of the
 * file can be read, or where fewer than one in 64 viewpoints of a large range can be. The file may
 * have been remuxed, for instance with `ffmpeg -map 0 -c copy`. Documentation/FileFormat.md
 * specifies it.
 *
 * @sa
 * vtkCSLFEncoder
 */
#ifndef vtkCSLFDecoder_h
#define vtkCSLFDecoder_h

#include "vtkCSLFModule.h" // For export macro
#include "vtkImageAlgorithm.h"

#include <functional> // For std::function
#include <memory>     // For std::unique_ptr
#include <string>     // For std::string

class vtkIdTypeArray;
class vtkImageData;
class vtkUnsignedCharArray;

class VTKCSLF_EXPORT vtkCSLFDecoder : public vtkImageAlgorithm
{
public:
  static vtkCSLFDecoder* New();
  vtkTypeMacro(vtkCSLFDecoder, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set/get the file to read.
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
   * The extensions of the files that may hold light fields, and what to call them in a file dialog.
   */
  const char* GetFileExtensions() { return ".mp4 .mkv"; }
  const char* GetDescriptiveName() { return "Cube surface light field"; }
  ///@}

  ///@{
  /**
   * What the file says of itself, once UpdateInformation has run: the field's description (JSON
   * text), the codec ("hevc", "av1" or "h264") and the pixel format of colour ("yuv444p"). Empty
   * before, or where the file could not be read.
   */
  const char* GetDescription() const;
  const char* GetCodecName() const;
  const char* GetPixelFormat() const;
  ///@}

  ///@{
  /**
   * The tracks of the file, once UpdateInformation has run: how many there are, colour first, what
   * each holds ("color", "coverage", "depth", "depth-high" or "depth-low"), and the bytes of its
   * coded frames, which is found by reading the whole file. Null and 0 outside the range.
   */
  int GetNumberOfTracks() const;
  const char* GetTrackName(int track) const;
  vtkTypeInt64 GetTrackBytes(int track);
  ///@}

  ///@{
  /**
   * What the file carries besides the light field (see vtkCSLFEncoder::AddPart), once
   * UpdateInformation has run: how many parts there are, what each is, its name, which may be
   * empty, and its bytes. Parts that are damaged are left out, with a warning. Null outside the
   * range.
   */
  int GetNumberOfParts() const;
  const char* GetPartType(int part) const;
  const char* GetPartName(int part) const;
  vtkUnsignedCharArray* GetPart(int part);
  ///@}

  ///@{
  /**
   * The viewpoints (z) found to be missing by the last update or by FindMissingViewpoints, in
   * ascending order.
   */
  vtkIdType GetNumberOfMissingViewpoints() const;
  vtkIdTypeArray* GetMissingViewpoints() const;
  ///@}

  ///@{
  /**
   * Whether viewpoints that are missing from a damaged file are left empty, with a warning. If not,
   * asking for any of them is an error, whose code is vtkErrorCode::PrematureEndOfFileError.
   * Default: true.
   */
  vtkSetMacro(AllowMissing, bool);
  vtkGetMacro(AllowMissing, bool);
  vtkBooleanMacro(AllowMissing, bool);
  ///@}

  /**
   * Checks the whole file by its checksums without decoding it. Returns the number of missing
   * viewpoints, or -1 with an error if the file is none that can be read, or
   * without one if it was aborted.
   */
  vtkIdType FindMissingViewpoints();

  ///@{
  /**
   * How many bytes of decoded viewpoints are kept at most for GetViewpoint, Prefetch and ranges
   * that touch the same groups. A viewpoint takes 20 N^2 bytes, 30 N^2 with depth, at a resolution
   * of N. Those that were used last stay. 0 keeps none, and Prefetch does nothing. What is being
   * decoded is not counted: in the background that is up to a group of 16 for each thread. Setting
   * this makes no output outdated. Default: 512 MiB.
   */
  void SetCacheSize(vtkTypeInt64 bytes);
  vtkGetMacro(CacheSize, vtkTypeInt64);
  ///@}

  /**
   * Makes `image` one viewpoint: the slice z of the output, with its absolute extent, arrays and
   * description. It comes from what is kept, or else is decoded now, with its group's frames that
   * it depends on, the tracks side by side. The arrays are shared with what is kept: copy them
   * before changing anything. False, with an error, if the file cannot be read, has no such
   * viewpoint, or is damaged there; then `image` is empty.
   */
  bool GetViewpoint(vtkIdType z, vtkImageData* image);

  /**
   * Has viewpoints decoded in the background, the first ones first as far as they lie in different
   * groups. This replaces what an earlier call asked for and is not yet begun; null or an empty
   * array ends prefetching. Of more viewpoints than CacheSize holds only the first ones are
   * decoded. Numbers that are no viewpoints are ignored. Returns at once.
   */
  void Prefetch(vtkIdTypeArray* viewpoints);

  /**
   * Whether GetViewpoint(z) need not decode anything, since the viewpoint is kept (or known to be
   * missing).
   */
  bool IsViewpointReady(vtkIdType z);

  /**
   * Whether a viewpoint cannot be had since the file is damaged there. Reports no error of that
   * unless AllowMissing is off, and then one for the whole file. Decodes the viewpoint unless it is
   * kept. True, with an error, if the file cannot be read or has no such viewpoint.
   */
  bool IsViewpointDamaged(vtkIdType z);

  /**
   * Waits until all that Prefetch was asked for is decoded.
   */
  void WaitForPrefetch();

  /**
   * All viewpoints in the order in which they lie in the file, the coarsest grid of viewpoints
   * first. Whoever needs all of them, but not at once, has each group decoded only once by asking
   * in this order. Empty if the file cannot be read.
   */
  void GetViewpointsInFileOrder(vtkIdTypeArray* viewpoints);

protected:
  vtkCSLFDecoder();
  ~vtkCSLFDecoder() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkCSLFDecoder(const vtkCSLFDecoder&) = delete;
  void operator=(const vtkCSLFDecoder&) = delete;

  class Internals;

  bool Guard(const std::function<bool()>& work);
  bool Fail(unsigned long code, const std::string& problem);
  bool OpenFile();
  bool CheckRange(int first, int last);
  void ReadRange(int first, int last, vtkImageData* output);
  bool ReportProgress(double progress);
  bool ReportDamage();
  bool ReportFileDamage();
  void WarnOfHeader();
  bool UpdateReader();
  bool RequireViewpoint(vtkIdType z);

  char* FileName = nullptr;
  vtkTypeInt64 CacheSize = 512 << 20;
  bool AllowMissing = true;
  const std::unique_ptr<Internals> Internal;
};

#endif
