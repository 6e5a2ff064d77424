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
 * Every group is checked against its checksums before it is decoded. Viewpoints of groups that are
 * damaged or cut off are left empty (coverage 0, depth 1) and reported in one warning; where
 * nothing asked for can be read, that is an error. The file may have been remuxed, for instance
 * with `ffmpeg -map 0 -c copy`. Documentation/FileFormat.md specifies it.
 *
 * @sa
 * vtkCSLFEncoder
 */
#ifndef vtkCSLFDecoder_h
#define vtkCSLFDecoder_h

#include "vtkCSLFModule.h" // For export macro
#include "vtkImageAlgorithm.h"

#include <memory> // For std::unique_ptr

class vtkIdTypeArray;

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

  /**
   * The extensions of the files that may hold light fields, and what to call them in a file dialog.
   */
  const char* GetFileExtensions() { return ".mp4 .mkv"; }
  const char* GetDescriptiveName() { return "Cube surface light field"; }

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
   * The viewpoints (z) found to be missing by the last update or by FindMissingViewpoints, in
   * ascending order.
   */
  vtkIdType GetNumberOfMissingViewpoints() const;
  vtkIdTypeArray* GetMissingViewpoints() const;
  ///@}

  /**
   * Checks the whole file by its checksums without decoding it. Returns the number of missing
   * viewpoints, or -1 with an error if the file is none that can be read.
   */
  vtkIdType FindMissingViewpoints();

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

  bool ReportProgress(double progress);
  void WarnOfMissing(vtkIdType asked);

  char* FileName = nullptr;
  const std::unique_ptr<Internals> Internal;
};

#endif
