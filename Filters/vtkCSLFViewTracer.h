// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFViewTracer
 * @brief   path-trace the picture of a camera
 *
 * The output is the reference against which views of a light field are measured: the scene on input
 * port 0, traced with the parameters of vtkCSLFPathTracer and stored by the same rule as the texels
 * of a light field. It is image data of the given size, with row 0 at the bottom, and one
 * point-data array, `Color`: 4 unsigned chars (sRGB-encoded mean of the samples that hit a surface,
 * times alpha) or 4 floats (linear radiance times exposure, associated alpha: exactly the mean over
 * all samples). Each pixel is averaged over its area. The field-data array `Sampling` is one
 * string: the parameters and a hash of the scene as JSON, as in a light field's description.
 *
 * Rays start at the camera or, for parallel projection, on the plane through it, regardless of the
 * clipping range.
 *
 * @sa vtkCSLFSampler
 */
#ifndef vtkCSLFViewTracer_h
#define vtkCSLFViewTracer_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkCSLFPathTracer.h"
#include "vtkSmartPointer.h" // for vtkSmartPointer

class vtkCamera;

class VTKCSLF_EXPORT vtkCSLFViewTracer : public vtkCSLFPathTracer
{
public:
  static vtkCSLFViewTracer* New();
  vtkTypeMacro(vtkCSLFViewTracer, vtkCSLFPathTracer);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The name of the field-data array that describes how the picture was traced.
   */
  static const char* SAMPLING_NAME() { return "Sampling"; }

  /**
   * Includes the modification time of the camera.
   */
  vtkMTimeType GetMTime() override;

  ///@{
  /**
   * The camera, with perspective or parallel projection. Required.
   */
  virtual void SetCamera(vtkCamera* camera);
  vtkCamera* GetCamera();
  ///@}

  ///@{
  /**
   * Width and height of the picture in pixels, each at least 1. Default: 512, 512.
   */
  vtkSetVector2Macro(Size, int);
  vtkGetVector2Macro(Size, int);
  ///@}

  ///@{
  /**
   * The type of `Color`: VTK_UNSIGNED_CHAR or VTK_FLOAT. Default: VTK_UNSIGNED_CHAR.
   */
  vtkSetMacro(ColorType, int);
  vtkGetMacro(ColorType, int);
  /** sRGB-encoded bytes, for display as they are. */
  void SetColorTypeToUnsignedChar() { this->SetColorType(VTK_UNSIGNED_CHAR); }
  /** Linear radiance, whose exposure can be changed when it is displayed. */
  void SetColorTypeToFloat() { this->SetColorType(VTK_FLOAT); }
  ///@}

protected:
  vtkCSLFViewTracer();
  ~vtkCSLFViewTracer() override;

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCSLFViewTracer(const vtkCSLFViewTracer&) = delete;
  void operator=(const vtkCSLFViewTracer&) = delete;

  bool CheckParameters();

  vtkSmartPointer<vtkCamera> Camera;
  int Size[2] = { 512, 512 };
  int ColorType = VTK_UNSIGNED_CHAR;
};

#endif
