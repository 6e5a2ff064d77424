// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCSLFFieldQuality
 * @brief compares two light fields: PSNR of every channel
 *
 * vtkCSLFFieldQuality compares the samples of two light fields of the same grid (input ports 0 and
 * 1), for example before and after coding, over the viewpoints that both provide. It reads them a
 * few viewpoints at a time, so neither has to fit in memory.
 *
 * There is one figure for the red, green and blue of `Color`, over all texels; one named `Coverage`
 * for its alpha; one for `Depth`, over the texels that both fields cover, because depth has no
 * meaning elsewhere; and one for each other channel that both fields have with the same type. The
 * peak is the largest value of integer types, and 1 for float.
 *
 * A viewer may show float `Color` at another exposure than the one it was sampled with. Such fields
 * therefore have further figures: `Color at 1/16`, `Color at 1/4`, `Color at 1`, `Color at 4` and
 * `Color at 16`, for red, green and blue as 8 bits over black at these factors of the exposure, as
 * in vtkCSLFFieldReference.
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
   * The upper limit of the PSNR in dB, which identical fields have; higher values are replaced by
   * it. Default: 100.
   */
  vtkSetMacro(MaximumPSNR, double);
  vtkGetMacro(MaximumPSNR, double);
  ///@}

  /**
   * Reads both inputs and compares them. Returns 1 on success and 0 on failure.
   */
  int Measure();

  ///@{
  /**
   * The figures of the last measurement: their number, their names, the PSNR in dB, and whether all
   * compared values were equal.
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
