// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFFieldWriter
 * @brief   vtkCSLFEncoder for ParaView's pipelines, on any number of ranks
 *
 * The whole field is made before it is coded, like all data in ParaView, and must fit in memory: if
 * it were pulled slab by slab, ParaView's pipeline would make its input again for each slab. With
 * several ranks, each makes its piece of the field, and rank 0 gathers and writes it. The frames of
 * the file are the same for any number of ranks. The geometry of the sampler or reader that made
 * the field is written with it.
 *
 * @sa vtkCSLFEncoder
 */
#ifndef vtkCSLFFieldWriter_h
#define vtkCSLFFieldWriter_h

#include "vtkCSLFEncoder.h"
#include "vtkCSLFParaViewModule.h" // for export macro
#include "vtkCSLFRateControl.h"

class VTKCSLFPARAVIEW_EXPORT vtkCSLFFieldWriter : public vtkCSLFEncoder
{
public:
  static vtkCSLFFieldWriter* New();
  vtkTypeMacro(vtkCSLFFieldWriter, vtkCSLFEncoder);

  /**
   * Writes the file: all ranks call it. Returns 1 on success; otherwise 0 on all ranks, and the
   * error code gives the kind of error.
   */
  int Write() override;

  ///@{
  /**
   * Set the rate factors and targets, see vtkCSLFRateControl. ParaView's properties need setters of
   * the writer.
   */
  void SetCRF(double factor) { this->GetRateControl()->SetCRF(factor); }
  void SetCoverageCRF(double factor) { this->GetRateControl()->SetCoverageCRF(factor); }
  void SetDepthCRF(double factor) { this->GetRateControl()->SetDepthCRF(factor); }
  void SetTargetRatio(double ratio) { this->GetRateControl()->SetTargetRatio(ratio); }
  void SetTargetSize(double bytes) { this->GetRateControl()->SetTargetSize(bytes); }
  void SetTargetPSNR(double psnr) { this->GetRateControl()->SetTargetPSNR(psnr); }
  ///@}

protected:
  vtkCSLFFieldWriter() = default;
  ~vtkCSLFFieldWriter() override = default;

private:
  vtkCSLFFieldWriter(const vtkCSLFFieldWriter&) = delete;
  void operator=(const vtkCSLFFieldWriter&) = delete;

  vtkPolyData* UpdateGeometry();
  int WriteAlone(vtkImageData* field, vtkPolyData* geometry);
};

#endif
