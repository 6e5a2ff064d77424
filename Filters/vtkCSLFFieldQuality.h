// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCSLFFieldQuality
 * @brief how close one light field comes to another: PSNR of every channel
 *
 * vtkCSLFFieldQuality compares the samples of two light fields of the same grid (input ports 0 and
 * 1), such as one before and one after coding, over the viewpoints that both offer. It pulls them a
 * few viewpoints at a time, so neither has to fit in memory.
 *
 * It yields one figure for the red, green and blue of `Color`, all texels counted; one named
 * `Coverage` for its alpha; one for `Depth`, of the texels that both fields cover, as depth means
 * nothing elsewhere; and one for each further channel that both fields have in the same type. The
 * peak is the largest value of whole numbers, and 1 for float.
 *
 * A viewer may show `Color` of floats at another exposure than the one that it was sampled with. So
 * such fields have further figures: `Color at 1/16`, `Color at 1/4`, `Color at 1`, `Color at 4` and
 * `Color at 16`, of red, green and blue as 8 bits over black at so many times the exposure, as
 * vtkCSLFFieldReference has them.
 *
 * @sa vtkCSLFImageQuality
 */
#ifndef vtkCSLFFieldQuality_h
#define vtkCSLFFieldQuality_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkImageAlgorithm.h"

#include <memory> // for std::unique_ptr

class VTKCSLF_EXPORT vtkCSLFFieldQuality : public vtkImageAlgorithm
{
public:
  static vtkCSLFFieldQuality* New();
  vtkTypeMacro(vtkCSLFFieldQuality, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The PSNR in dB that stands for all higher ones, as of identical fields. Default 100.
   */
  vtkSetMacro(MaximumPSNR, double);
  vtkGetMacro(MaximumPSNR, double);
  ///@}

  /**
   * Pulls both inputs and compares them. Returns 1 on success and 0 on failure.
   */
  int Measure();

  ///@{
  /**
   * The figures of the last measurement: how many there are, their names, the PSNR in dB, and
   * whether all values compared were equal.
   */
  int GetNumberOfFigures();
  const char* GetFigureName(int index);
  double GetPSNR(int index);
  bool GetIsEqual(int index);
  ///@}

protected:
  vtkCSLFFieldQuality();
  ~vtkCSLFFieldQuality() override;

private:
  vtkCSLFFieldQuality(const vtkCSLFFieldQuality&) = delete;
  void operator=(const vtkCSLFFieldQuality&) = delete;

  struct Internal;
  std::unique_ptr<Internal> Internals;
  double MaximumPSNR = 100.0;
};

#endif
