// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFFieldWriter
 * @brief   vtkCSLFEncoder for ParaView's pipelines, on any number of ranks
 *
 * The field is made as a whole before it is coded, as ParaView makes all data, and has to fit in
 * memory: pulled slab by slab through ParaView's pipeline, its input would be made again for each.
 * With several ranks, each makes its piece of the field, together, and rank 0 gathers and writes
 * it. The frames of the file are the same for any number of ranks.
 *
 * @sa vtkCSLFEncoder
 */
#ifndef vtkCSLFFieldWriter_h
#define vtkCSLFFieldWriter_h

#include "vtkCSLFEncoder.h"
#include "vtkCSLFParaViewModule.h" // for export macro

class VTKCSLFPARAVIEW_EXPORT vtkCSLFFieldWriter : public vtkCSLFEncoder
{
public:
  static vtkCSLFFieldWriter* New();
  vtkTypeMacro(vtkCSLFFieldWriter, vtkCSLFEncoder);

  /**
   * Writes the file: all ranks call it. Returns 1 on success; otherwise 0 on all ranks, and the
   * error code tells the kind of error.
   */
  int Write() override;

protected:
  vtkCSLFFieldWriter() = default;
  ~vtkCSLFFieldWriter() override = default;

private:
  vtkCSLFFieldWriter(const vtkCSLFFieldWriter&) = delete;
  void operator=(const vtkCSLFFieldWriter&) = delete;

  int WriteAlone(vtkImageData* field);
};

#endif
