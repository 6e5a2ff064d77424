// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFBoxSampler
 * @brief   vtkCSLFSampler with its cube in the terms of ParaView's interactive box
 *
 * The cube that is not automatic is set by its lowest corner and its lengths, in place of
 * CubeCenter and CubeEdges.
 *
 * @sa vtkCSLFSampler
 */
#ifndef vtkCSLFBoxSampler_h
#define vtkCSLFBoxSampler_h

#include "vtkCSLFParaViewModule.h" // for export macro
#include "vtkCSLFSampler.h"

class VTKCSLFPARAVIEW_EXPORT vtkCSLFBoxSampler : public vtkCSLFSampler
{
public:
  static vtkCSLFBoxSampler* New();
  vtkTypeMacro(vtkCSLFBoxSampler, vtkCSLFSampler);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The corner of the lowest coordinates, in world coordinates. Default: -1, -1, -1.
   */
  void SetCubePosition(double x, double y, double z);

  /**
   * The lengths of the edges, in world coordinates: above 0. Default: 2, 2, 2.
   */
  void SetCubeLengths(double x, double y, double z);

protected:
  vtkCSLFBoxSampler() = default;
  ~vtkCSLFBoxSampler() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkCSLFBoxSampler(const vtkCSLFBoxSampler&) = delete;
  void operator=(const vtkCSLFBoxSampler&) = delete;

  void UpdateCube();

  double CubePosition[3] = { -1.0, -1.0, -1.0 };
  double CubeLengths[3] = { 2.0, 2.0, 2.0 };
};

#endif
