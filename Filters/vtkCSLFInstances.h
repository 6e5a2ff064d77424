// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFInstances
 * @brief   places of polygonal data, as field data
 *
 * Polygonal data whose field data has instances is shown at each of their places, and not where it
 * lies; the path tracer keeps one copy of its geometry. Any VTK pipeline carries them along. This
 * class knows the arrays' names; each has one tuple an instance:
 *
 * - `CSLF:InstanceMatrix`: 16 components, from the data's coordinates to the world, as vtkMatrix4x4
 * has it: row by row, the last 0, 0, 0, 1.
 * - `CSLF:InstanceColor`: 3 or 4 components, unsigned char, optional. The base colour, sRGB, and
 * the opacity, which multiplies that of the material.
 * - `CSLF:InstanceEmission`: 3 components, optional. The emission, linear radiance, in place of
 * that of the material.
 *
 * Instances that are flat show nothing.
 *
 * @sa vtkCSLFMaterial vtkCSLFSceneImporter
 */
#ifndef vtkCSLFInstances_h
#define vtkCSLFInstances_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkObject.h"

class vtkDataObject;
class vtkMatrix4x4;

class VTKCSLF_EXPORT vtkCSLFInstances : public vtkObject
{
public:
  static vtkCSLFInstances* New();
  vtkTypeMacro(vtkCSLFInstances, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The arrays' names.
   */
  static const char* InstanceMatrix() { return "CSLF:InstanceMatrix"; }
  static const char* InstanceColor() { return "CSLF:InstanceColor"; }
  static const char* InstanceEmission() { return "CSLF:InstanceEmission"; }
  ///@}

  /**
   * Adds an instance without a colour of its own. All instances of a block have colours, or none.
   */
  static void AddInstance(vtkDataObject* data, vtkMatrix4x4* matrix);

  /**
   * Adds an instance of a colour: red, green, blue and opacity in [0,1], sRGB.
   */
  static void AddInstance(vtkDataObject* data, vtkMatrix4x4* matrix, const double color[4]);

  /**
   * Adds an instance of a colour that emits a radiance: linear, not negative. All instances of a
   * block have emissions, or none.
   */
  static void AddInstance(
    vtkDataObject* data, vtkMatrix4x4* matrix, const double color[4], const double emission[3]);

  /**
   * Removes all instances from the field data.
   */
  static void RemoveInstances(vtkDataObject* data);

protected:
  vtkCSLFInstances() = default;
  ~vtkCSLFInstances() override = default;

private:
  vtkCSLFInstances(const vtkCSLFInstances&) = delete;
  void operator=(const vtkCSLFInstances&) = delete;
};

#endif
