// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFResample
 * @brief   makes a coarser light field from a light field
 *
 * vtkCSLFResample makes the fields of a multi-resolution representation from one that was sampled
 * (paper, section 3.2): N/2, N/4 ... texels by averaging, and nested grids of viewpoints, which are
 * the "key views" of the paper's section 3.3, by leaving nodes out. The output equals, but for
 * rounding and noise, a field sampled at its own numbers of viewpoints and texels; it is a light
 * field like any other, to be drawn, coded and written.
 *
 * - Colours are averaged as light: linear, with the coverage as weight. Alpha is the mean coverage.
 * - Depth is the smallest of the covered texels, so that nothing is lost behind what it hides.
 * - Other channels are averaged over the covered texels.
 * - The description's node list and resolution are rewritten; `resampled` in its `sampling` tells
 *   the divisor and the stride, of several passes their products.
 *
 * The divisor must divide the resolution N, and the stride must divide M - 1, so that the nodes on
 * the edges, which neighbouring faces share, are kept. What does not divide is refused.
 *
 * Any z range of the output can be asked for. The input is pulled for it a few viewpoints at a
 * time, leaving out rows of viewpoints that are not needed, so besides what is asked for it takes
 * no more memory than 64 MiB, or two slices of the input. A part of a field that was extracted
 * along z can be made coarser in its texels, but not in its viewpoints.
 *
 * @sa
 * vtkCSLFSampler vtkCSLFDecoder
 */
#ifndef vtkCSLFResample_h
#define vtkCSLFResample_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkImageAlgorithm.h"

#include <optional> // for std::optional

namespace cslf
{
class Nesting;
}

class VTKCSLF_EXPORT vtkCSLFResample : public vtkImageAlgorithm
{
public:
  static vtkCSLFResample* New();
  vtkTypeMacro(vtkCSLFResample, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How many texels along each side become one. At least 1. Default: 1, as they are.
   */
  vtkSetClampMacro(ResolutionDivisor, int, 1, VTK_INT_MAX);
  vtkGetMacro(ResolutionDivisor, int);
  ///@}

  ///@{
  /**
   * Every which viewpoint along each side of a face is kept, beginning with the first. At least 1.
   * Default: 1, all of them.
   */
  vtkSetClampMacro(ViewpointStride, int, 1, VTK_INT_MAX);
  vtkGetMacro(ViewpointStride, int);
  ///@}

protected:
  vtkCSLFResample() = default;
  ~vtkCSLFResample() override = default;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkCSLFResample(const vtkCSLFResample&) = delete;
  void operator=(const vtkCSLFResample&) = delete;

  class Pass;

  /// What is to be made of the input. Nothing after an error.
  std::optional<cslf::Nesting> MakeNesting(vtkInformationVector** inputVector);

  int ResolutionDivisor = 1;
  int ViewpointStride = 1;
};

#endif
