// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFFieldWriter
 * @brief   vtkCSLFEncoder for ParaView's pipelines, on any number of ranks
 *
 * With one rank it is the encoder. With several, ParaView's pipeline has each rank make its piece
 * of the field, together; rank 0 then gathers the whole field, which must fit in its memory, and
 * writes it alone. The bytes of the file are the same.
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
  int Write();

protected:
  vtkCSLFFieldWriter() = default;
  ~vtkCSLFFieldWriter() override = default;

private:
  vtkCSLFFieldWriter(const vtkCSLFFieldWriter&) = delete;
  void operator=(const vtkCSLFFieldWriter&) = delete;

  int WriteAlone(vtkImageData* field);
};

#endif
