// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFEnvironment
 * @brief   light that reaches a scene from infinitely far away
 *
 * The environment of a path tracer. It is ignored if the field data of an input, or the renderer,
 * has its own environment, see vtkCSLFLight. Several path tracers may share one environment.
 *
 * @sa vtkCSLFPathTracer
 */
#ifndef vtkCSLFEnvironment_h
#define vtkCSLFEnvironment_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkObject.h"

class VTKCSLF_EXPORT vtkCSLFEnvironment : public vtkObject
{
public:
  static vtkCSLFEnvironment* New();
  vtkTypeMacro(vtkCSLFEnvironment, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The kinds of environment.
   */
  enum Modes
  {
    NoEnvironment = 0,   ///< no light
    ConstantEnvironment, ///< Color from all directions
    GradientEnvironment, ///< from BottomColor to Color, along Up
    ImageEnvironment     ///< the lat-long image FileName
  };

  ///@{
  /**
   * The kind of environment. Default: constant. With the default colour, it is white.
   */
  void SetMode(int mode);
  vtkGetMacro(Mode, int);
  /** No light comes from far away. */
  void SetModeToNone() { this->SetMode(NoEnvironment); }
  /** The same Color comes from all directions. */
  void SetModeToConstant() { this->SetMode(ConstantEnvironment); }
  /** BottomColor changes to Color along Up. */
  void SetModeToGradient() { this->SetMode(GradientEnvironment); }
  /** The light is that of the lat-long image FileName. */
  void SetModeToImage() { this->SetMode(ImageEnvironment); }
  ///@}

  ///@{
  /**
   * The colour of a constant environment, and of a gradient at its top: sRGB, in [0,1]. Default:
   * white.
   */
  vtkSetVector3Macro(Color, double);
  vtkGetVector3Macro(Color, double);
  ///@}

  ///@{
  /**
   * The colour of a gradient at its bottom: sRGB, in [0,1]. Between bottom and top, radiance is
   * linear in the height of the direction's unit vector. Default: 0.2, 0.2, 0.2.
   */
  vtkSetVector3Macro(BottomColor, double);
  vtkGetVector3Macro(BottomColor, double);
  ///@}

  ///@{
  /**
   * The factor of the environment's linear radiance. At least 0. Default: 1.
   */
  void SetIntensity(double intensity);
  vtkGetMacro(Intensity, double);
  ///@}

  ///@{
  /**
   * The file of a lat-long image, in any format that OpenImageIO reads. Floating-point formats hold
   * linear radiance and others sRGB, unless the file says otherwise. The image is oriented like the
   * environment texture of a vtkRenderer: its middle is the direction +X, and +Z is a quarter of
   * its width further to the right. Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * The direction of the top of a gradient or an image, of any length but 0. For an image, +X is
   * made perpendicular to it. Default: 0, 1, 0.
   */
  vtkSetVector3Macro(Up, double);
  vtkGetVector3Macro(Up, double);
  ///@}

  ///@{
  /**
   * Whether rays that miss the scene show the environment, with alpha 1, or nothing, with alpha 0.
   * Default: off.
   */
  vtkSetMacro(Show, bool);
  vtkGetMacro(Show, bool);
  vtkBooleanMacro(Show, bool);
  ///@}

  /**
   * Takes the values of another environment. Null is ignored.
   */
  void DeepCopy(vtkCSLFEnvironment* source);

protected:
  vtkCSLFEnvironment();
  ~vtkCSLFEnvironment() override;

private:
  vtkCSLFEnvironment(const vtkCSLFEnvironment&) = delete;
  void operator=(const vtkCSLFEnvironment&) = delete;

  int Mode;
  double Color[3];
  double BottomColor[3];
  double Intensity;
  char* FileName = nullptr;
  double Up[3];
  bool Show;
};

#endif
