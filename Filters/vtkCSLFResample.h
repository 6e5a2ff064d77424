// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFResample
 * @brief   makes a coarser light field from a light field
 *
 * vtkCSLFResample derives the levels of a multi-resolution representation from a sampled field
 * (paper, section 3.2): N/2, N/4 ... texels by averaging, and nested grids of viewpoints, the "key
 * views" of the paper's section 3.3, by omitting nodes. Apart from rounding and noise, the output
 * equals a field that was sampled with these numbers of viewpoints and texels. It is a light field
 * like any other and can be drawn, coded and written.
 *
 * - Colours are averaged as linear light, weighted by coverage. Alpha is the mean coverage.
 * - Depth is the smallest depth of the covered texels, so that no foreground is lost.
 * - Other channels are averaged over the covered texels.
 * - The node list and the resolution in the description are updated; `resampled` in its `sampling`
 * holds the divisor and the stride, or for several passes their products.
 *
 * The divisor must divide the resolution N, and the stride must divide M - 1, so that the nodes on
 * the edges, which neighbouring faces share, are kept. Other values are refused.
 *
 * Any z range of the output can be requested. The input is then requested a few viewpoints at a
 * time, without rows of viewpoints that are not needed. Apart from the output, the filter needs at
 * most 64 MiB, or two slices of the input. If a part of a field was extracted along z, its texels
 * can be reduced, but not its viewpoints.
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
   * The number of texels along each side that are combined into one. At least 1. Default: 1, no
   * change.
   */
  void SetResolutionDivisor(int divisor);
  vtkGetMacro(ResolutionDivisor, int);
  ///@}

  ///@{
  /**
   * The stride of viewpoints along each side of a face: every n-th is kept, beginning with the
   * first. At least 1. Default: 1, all of them.
   */
  void SetViewpointStride(int stride);
  vtkGetMacro(ViewpointStride, int);
  ///@}

protected:
  vtkCSLFResample();
  ~vtkCSLFResample() override = default;

  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCSLFResample(const vtkCSLFResample&) = delete;
  void operator=(const vtkCSLFResample&) = delete;

  class Pass;

  /// What is to be made of the input. Nothing after an error.
  std::optional<cslf::Nesting> MakeNesting(vtkInformationVector** inputVector);

  int ResolutionDivisor;
  int ViewpointStride;
};

#endif
