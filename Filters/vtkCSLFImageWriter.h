// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCSLFImageWriter
 * @brief write a light field as a folder of cube maps
 *
 * vtkCSLFImageWriter writes a cube surface light field as in the paper (section 3.2): one cube map
 * per viewpoint, in files that any image program can open. The folder contains
 *
 * - `description.json`: the field's description, and under `slices` the first and last viewpoint
 * written;
 * - `000123.Color.png`, or `.exr` for float colours: the picture seen from viewpoint 123. The
 * number is the z index of its slice, (face M + j) M + i;
 * - `000123.Depth.png` (16-bit gray), or `.exr` for float depth: its depth; likewise for further
 * channels.
 *
 * Each image is a strip of six N x N faces in OpenGL's cube-map order (+X, -X, +Y, -Y, +Z, -Z),
 * with tc = -1 in the top row. The face that contains the viewpoint is fully transparent, with
 * depth 1.
 *
 * The pixels are exactly those of the field, so a folder that vtkCSLFImageReader reads equals what
 * was written. Colours are associated with (multiplied by) their alpha, but the convention of PNG
 * is unassociated alpha. A program that composites such a PNG therefore shows partly covered
 * texels, which lie along silhouettes, too dark; all others look right. Dividing by alpha would
 * lose the low bits permanently. EXR's convention is associated alpha.
 *
 * PNG images have checksums. EXR images have none, so they get an attribute `cslf:crc32`: the
 * CRC-32 of the bytes of their pixels in eight hexadecimal digits. If the attribute exists, it must
 * be correct, so remove it after editing such an image with a program that keeps attributes.
 *
 * The input is requested a few viewpoints at a time and may be larger than memory. The folder is
 * written inside a folder of its name with `.partial` appended, and renamed when it is complete. A
 * lock in that folder excludes other writers of the same folder. An earlier light field in a folder
 * of that name is replaced if the folder contains nothing else; any other non-empty folder is
 * refused. After the first viewpoints, the writer fails if the disk has less than half of the space
 * that the others would take if they are similar.
 *
 * @sa vtkCSLFImageReader
 */
#ifndef vtkCSLFImageWriter_h
#define vtkCSLFImageWriter_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkImageAlgorithm.h"

#include <string> // for WriteSlabs

class VTKCSLF_EXPORT vtkCSLFImageWriter : public vtkImageAlgorithm
{
public:
  static vtkCSLFImageWriter* New();
  vtkTypeMacro(vtkCSLFImageWriter, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The folder to write. Its parent folder must exist. Required.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /**
   * Reads the input and writes it. Returns 1 on success. On failure, or if aborted through
   * SetAbortExecute() from a progress observer, it returns 0, sets the error code and leaves the
   * folder unchanged.
   */
  int Write();

protected:
  vtkCSLFImageWriter();
  ~vtkCSLFImageWriter() override;

private:
  vtkCSLFImageWriter(const vtkCSLFImageWriter&) = delete;
  void operator=(const vtkCSLFImageWriter&) = delete;

  bool WriteSlabs(const std::string& folder, std::string& error);

  char* FileName = nullptr;
};

#endif
