// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFRepresentation
 * @brief   draws a light field in ParaView's render view
 *
 * The representation "Light Field" of image data, drawn by vtkCSLFMapper with all other objects in
 * the view. Bounds, and so the camera's reset and the axes, are those of the field's geometry or,
 * without geometry, of its cube, not those of the image data. Image data that is not a whole light
 * field is an error, and nothing is drawn.
 *
 * The geometry of the sampler or reader that made the field is found in the pipeline, for the
 * lookup GEOMETRY.
 *
 * Scalar bars show the colours that were baked, which stay when the colour map of the source
 * changes. A note in the view then says that the field is out of date, where the process that draws
 * also has the pipeline.
 *
 * If several ranks have each made a part of the field, rank 0 gathers all parts. Each rank has the
 * whole geometry, and rank 0 delivers its own. Only rank 0 or the client draws the field: ParaView
 * decides by its size.
 *
 * @sa vtkCSLFMapper
 */
#ifndef vtkCSLFRepresentation_h
#define vtkCSLFRepresentation_h

#include "vtkCSLFParaViewModule.h" // for export macro
#include "vtkNew.h"                // for vtkNew
#include "vtkPVDataRepresentation.h"
#include "vtkPolyData.h"     // for the geometry
#include "vtkSmartPointer.h" // for vtkSmartPointer
#include "vtkWeakPointer.h"  // for the renderer of legends

#include <vector> // for std::vector

class vtkActor;
class vtkCSLFMapper;
class vtkImageData;
class vtkOutlineSource;
class vtkRenderer;
class vtkScalarBarActor;
class vtkTextActor;

class VTKCSLFPARAVIEW_EXPORT vtkCSLFRepresentation : public vtkPVDataRepresentation
{
public:
  static vtkCSLFRepresentation* New();
  vtkTypeMacro(vtkCSLFRepresentation, vtkPVDataRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo) override;
  void Update() override;
  using Superclass::Update;
  void SetVisibility(bool visible) override;

  /**
   * An outline of the bounds, for code that asks for the drawn data and its position.
   */
  vtkDataObject* GetRenderedDataObject(int port) override;

  ///@{
  /**
   * Settings of the mapper and its tone mapping: see vtkCSLFMapper and vtkCSLFToneMapping.
   */
  void SetLookup(int lookup);
  void SetAutomaticFocalPoint(bool automatic);
  void SetFocalPoint(double x, double y, double z);
  void SetPixelSamples(int samples);
  void SetExposure(double exposure);
  void SetToneMapping(int curve);
  void SetAutoAdjustResolution(bool adjust);
  ///@}

  /**
   * Whether the view shows scalar bars of the baked colours, and the note that they are out of
   * date. Default: on.
   */
  void SetShowLegend(bool show);

  /**
   * The graphics memory that the samples may take, in MiB: the mapper's TextureMemoryLimit.
   */
  void SetTextureMemory(int mebibytes);

  ///@{
  /**
   * Settings of the actor: see vtkActor and vtkProperty.
   */
  void SetOpacity(double opacity);
  void SetOrientation(double x, double y, double z);
  void SetOrigin(double x, double y, double z);
  void SetPickable(int pickable);
  void SetPosition(double x, double y, double z);
  void SetScale(double x, double y, double z);
  ///@}

protected:
  vtkCSLFRepresentation();
  ~vtkCSLFRepresentation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

private:
  vtkCSLFRepresentation(const vtkCSLFRepresentation&) = delete;
  void operator=(const vtkCSLFRepresentation&) = delete;

  /// What the last update has made of this rank's part, the more important the greater.
  enum class PartState
  {
    Unchanged,
    Changed,
    Failed
  };

  void ConnectGeometry();
  void UpdateField();
  void UpdateOutline();
  void ReceivePieces(vtkInformation* info);
  void ShowPieces(
    vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo);
  void GetDrawnBounds(double bounds[6]);
  void ShowLegends(vtkImageData* field);

  vtkNew<vtkCSLFMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkCSLFMapper>
    BoundsMapper; // never draws: gives the field's cube before the field is sent
  vtkNew<vtkOutlineSource> Outline;
  vtkWeakPointer<vtkRenderer> LegendRenderer;
  std::vector<vtkSmartPointer<vtkScalarBarActor>> Legends;
  vtkSmartPointer<vtkImageData> LegendField; // whose legends these are
  vtkNew<vtkTextActor> Note;
  bool ShowLegend = true;
  PartState State = PartState::Unchanged;
  vtkSmartPointer<vtkImageData> Part;        // this rank's viewpoints; null if there are none
  vtkSmartPointer<vtkPolyData> PartGeometry; // null if there is none
  vtkSmartPointer<vtkImageData> Field;       // null if there is none, and on ranks above 0
  vtkNew<vtkImageData> NoField;              // empty
  vtkSmartPointer<vtkPolyData> Geometry;     // empty if there is none, and on ranks above 0
};

#endif
