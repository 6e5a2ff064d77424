// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFCornellBoxSource
 * @brief   the Cornell box, with materials
 *
 * The box whose measures the Cornell University Program of Computer Graphics published, each axis
 * scaled so that the room is [-1,1]^3. It is open towards +Z; red is at -X, green at +X, the lamp
 * in the ceiling at +Y. The walls are planes, where those measured were a little askew, and the
 * lamp hangs a thousandth of the room's edge below the ceiling, which closes around it.
 *
 * The output is a vtkMultiBlockDataSet of named blocks of quadrilaterals: Floor, Ceiling, BackWall,
 * LeftWall, RightWall, ShortBlock, TallBlock, Lamp. Their materials (see vtkCSLFMaterial) are
 * diffuse with the customary linear reflectances, white (0.73, 0.73, 0.73), red (0.65, 0.05, 0.05),
 * green (0.12, 0.45, 0.15), and the lamp emits the radiance (17, 12, 4).
 *
 * The room is meant to be lit by its lamp alone: set the environment of the filter that traces it
 * to none (vtkCSLFEnvironment::SetModeToNone). Its outside is then black.
 *
 * @sa vtkCSLFSampler vtkCSLFMaterial
 */
#ifndef vtkCSLFCornellBoxSource_h
#define vtkCSLFCornellBoxSource_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkMultiBlockDataSetAlgorithm.h"

class VTKCSLF_EXPORT vtkCSLFCornellBoxSource : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkCSLFCornellBoxSource* New();
  vtkTypeMacro(vtkCSLFCornellBoxSource, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkCSLFCornellBoxSource();
  ~vtkCSLFCornellBoxSource() override = default;

  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCSLFCornellBoxSource(const vtkCSLFCornellBoxSource&) = delete;
  void operator=(const vtkCSLFCornellBoxSource&) = delete;
};

#endif
