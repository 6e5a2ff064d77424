// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFVolume
 * @brief   volumes that travel with the data, as field data
 *
 * The path tracing filters show a leaf of a composite data set that is a vtkImageData or a
 * vtkRectilinearGrid as a volume if its field data has the array `CSLF:VolumeColors`. Its active
 * scalars of points, or else of cells, select colours and opacities. This class provides the names
 * of the arrays and sets them; each has one tuple of one component unless it is said otherwise:
 *
 * - `CSLF:VolumeColors`, 4 components: at least 2 tuples, evenly spaced over the range: a displayed
 *   colour (sRGB) and the opacity over the unit distance, all in [0,1];
 * - `CSLF:VolumeRange`, 2: the scalars of the first and the last colour;
 * - `CSLF:VolumeComponent`, optional: which component of the scalars; default: the first one;
 * - `CSLF:VolumeUnitDistance`, optional: above 0, in the coordinates of the data set; default: 1;
 * - `CSLF:VolumeInterpolation`, optional: 0 for the nearest scalar, 1 (default) for a linear one;
 * - `CSLF:VolumeMatrix`, 16, optional: from the grid's coordinates to the world, row by row;
 * - `CSLF:VolumePlanes`, 4, optional: a plane in each tuple, world; the volume is where
 *   a x + b y + c z + d is not negative;
 * - `CSLF:VolumeShade`, optional: 0 (default) shows the colours themselves, without light; 1
 *   scatters light;
 * - `CSLF:VolumeAnisotropy`, optional: of light that is scattered, above -1 (backwards) and below 1
 *   (forwards); 0 (default) is all around.
 *
 * A scattering medium lets less than 1e-13 of the light pass a distance of nodes at most, however
 * opaque it is.
 *
 * Without light, a volume emits its displayed colours and hides what is behind it, as volume
 * mappers show it without shading. Points that are hidden by ghost arrays, and values that are not
 * numbers, are empty. Volumes may overlap: their opacities then multiply.
 *
 * @sa vtkCSLFMaterial vtkCSLFLight vtkCSLFSceneImporter
 */
#ifndef vtkCSLFVolume_h
#define vtkCSLFVolume_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkObject.h"

class vtkDataSet;
class vtkMatrix4x4;
class vtkVolumeProperty;

class VTKCSLF_EXPORT vtkCSLFVolume : public vtkObject
{
public:
  static vtkCSLFVolume* New();
  vtkTypeMacro(vtkCSLFVolume, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The names of the arrays.
   */
  static const char* ColorsName() { return "CSLF:VolumeColors"; }
  static const char* RangeName() { return "CSLF:VolumeRange"; }
  static const char* ComponentName() { return "CSLF:VolumeComponent"; }
  static const char* UnitDistanceName() { return "CSLF:VolumeUnitDistance"; }
  static const char* InterpolationName() { return "CSLF:VolumeInterpolation"; }
  static const char* MatrixName() { return "CSLF:VolumeMatrix"; }
  static const char* PlanesName() { return "CSLF:VolumePlanes"; }
  static const char* ShadeName() { return "CSLF:VolumeShade"; }
  static const char* AnisotropyName() { return "CSLF:VolumeAnisotropy"; }
  ///@}

  /**
   * Makes a data set a volume with the look of a property: the functions of colour and opacity of a
   * component over the range of its scalars (active scalars of points, or else of cells), the
   * weight of the component, the unit distance, the interpolation and the shading. Returns false,
   * without changes, if the data set has no such scalars or none of them is finite.
   */
  static bool SetFromProperty(vtkDataSet* data, vtkVolumeProperty* property, int component = 0);

  /**
   * Sets the matrix from the coordinates of the data set to the world. None is set by default.
   */
  static void SetMatrix(vtkDataSet* data, vtkMatrix4x4* matrix);

  /**
   * Cuts away what is on the side of a plane, in the world, that its normal points away from.
   */
  static void AddPlane(vtkDataSet* data, const double origin[3], const double normal[3]);

  ///@{
  /**
   * Whether the volume scatters light, and its anisotropy, above -1 and below 1.
   */
  static void SetShade(vtkDataSet* data, bool shade);
  static void SetAnisotropy(vtkDataSet* data, double anisotropy);
  ///@}

protected:
  vtkCSLFVolume() = default;
  ~vtkCSLFVolume() override = default;

private:
  vtkCSLFVolume(const vtkCSLFVolume&) = delete;
  void operator=(const vtkCSLFVolume&) = delete;
};

#endif
