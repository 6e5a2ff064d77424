// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCSLFImageWriter
 * @brief write a light field as a folder of cube maps
 *
 * vtkCSLFImageWriter writes a cube surface light field as the paper stores it (section 3.2): one
 * cube map per viewpoint, in files that any image program opens. The folder holds
 *
 * - `description.json`: the field's description, and under `slices` the first and last viewpoint
 *   written;
 * - `000123.Color.png`, or `.exr` where colours are floats: the picture seen from viewpoint 123,
 * the number being the z index of its slice, (face M + j) M + i;
 * - `000123.Depth.png` (16-bit gray), or `.exr` for float depth: its depth; and so on for further
 *   channels.
 *
 * Each image is a strip of six N x N faces in OpenGL's cube-map order (+X, -X, +Y, -Y, +Z, -Z), its
 * top row being tc = -1. The face that the viewpoint lies on is fully transparent, its depth 1.
 *
 * The pixels are the field's own, bit for bit, so a folder read by vtkCSLFImageReader equals what
 * was written. As colours are associated with their alpha (multiplied by it), and PNG's convention
 * is alpha unassociated, a program that composites such a PNG shows texels that are partly covered,
 * which lie along silhouettes, darker than they are; all others look right. Dividing by alpha, as
 * PNG wants it, would lose the low bits for good. EXR's convention is associated alpha, so nothing
 * has to be said there.
 *
 * PNG images have checksums. EXR images have none, so they get an attribute `cslf:crc32`: the
 * CRC-32 of their pixels' bytes in eight hexadecimal digits. Where it is there it must be right, so
 * whoever edits such an image with a program that keeps attributes has to remove it.
 *
 * The input is pulled a few viewpoints at a time and may be larger than memory. The folder is
 * written within a folder of its name with `.partial` appended, and renamed when it is whole. A
 * lock in there keeps other writers of the same folder out. An earlier light field in a folder of
 * that name is replaced, if the folder holds nothing else; any other folder that is not empty is
 * refused. The writer fails after the first viewpoints if the disk has less than half of what the
 * others take if they are like those.
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
   * The folder to write. The folder that is to hold it must exist.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /**
   * Pulls the input and writes it. Returns 1 on success. On failure, or when aborted through
   * SetAbortExecute() from a progress observer, returns 0, sets the error code and leaves the
   * folder as it was.
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
