// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFInstances
 * @brief   instances of polygonal data, as field data
 *
 * If the field data of polygonal data has instances, the data is shown at each of their places, and
 * not at its own. The path tracer keeps one copy of its geometry. Any VTK pipeline passes instances
 * on. This class provides the names of the arrays; each has one tuple per instance:
 *
 * - `CSLF:InstanceMatrix`: 16 components, from the data's coordinates to the world, as in
 * vtkMatrix4x4: row by row, with the last row 0, 0, 0, 1.
 * - `CSLF:InstanceColor`: 3 or 4 components, unsigned char, optional. The base colour, sRGB, and
 * the opacity, which multiplies that of the material.
 * - `CSLF:InstanceEmission`: 3 components, optional. The emission, linear radiance, which replaces
 * that of the material.
 * - `CSLF:InstanceScalar`: 1 component, optional. The scalar to which a map gave the colour; the
 * map is in the field data `CSLF:ColorMaps` and `CSLF:ColorMapColors`. Fields keep it, so that they
 * can be shown in other colours.
 *
 * Instances that are flat are invisible.
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
   * The names of the arrays.
   */
  static const char* InstanceMatrix() { return "CSLF:InstanceMatrix"; }
  static const char* InstanceColor() { return "CSLF:InstanceColor"; }
  static const char* InstanceScalar() { return "CSLF:InstanceScalar"; }
  static const char* InstanceEmission() { return "CSLF:InstanceEmission"; }
  ///@}

  /**
   * Adds an instance without its own colour. Either all instances of a block have colours, or none.
   */
  static void AddInstance(vtkDataObject* data, vtkMatrix4x4* matrix);

  /**
   * Adds an instance with a colour: red, green, blue and opacity in [0,1], sRGB.
   */
  static void AddInstance(vtkDataObject* data, vtkMatrix4x4* matrix, const double color[4]);

  /**
   * Adds an instance with a colour and an emission: linear radiance, not negative. Either all
   * instances of a block have emissions, or none.
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
