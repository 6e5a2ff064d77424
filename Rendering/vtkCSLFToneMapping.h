// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFToneMapping
 * @brief   exposure and curve by which vtkCSLFMapper displays radiance
 *
 * Several mappers may share one object.
 *
 * @sa vtkCSLFMapper
 */
#ifndef vtkCSLFToneMapping_h
#define vtkCSLFToneMapping_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkObject.h"

class VTKCSLF_EXPORT vtkCSLFToneMapping : public vtkObject
{
public:
  static vtkCSLFToneMapping* New();
  vtkTypeMacro(vtkCSLFToneMapping, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The mappings of radiance to the range of a display, as in vtkToneMappingPass.
   */
  enum Curves
  {
    Clamp = 0, ///< values above white are displayed as white
    Reinhard,  ///< divided by 1 plus the luminance (Rec. 709), which preserves hues
    ACES       ///< a film-like curve: the fit of the ACES transforms by K. Narkowicz (2015)
  };

  ///@{
  /**
   * The factor of the displayed radiance, in addition to the exposure that the field was sampled
   * with. It acts on linear values, also if the field holds sRGB-encoded ones, but cannot restore
   * values that were clamped: sample as `float` to choose the exposure at view time. At least 0.
   * Default: 1.
   */
  void SetExposure(double exposure);
  vtkGetMacro(Exposure, double);
  ///@}

  ///@{
  /**
   * The mapping of radiance times exposure before it is sRGB-encoded. With Clamp, the field looks
   * like its path-traced reference. Default: Clamp.
   */
  void SetCurve(int curve);
  vtkGetMacro(Curve, int);
  /** Values above white are displayed as white. */
  void SetCurveToClamp() { this->SetCurve(Clamp); }
  /** Divides by 1 plus the luminance, which preserves hues. */
  void SetCurveToReinhard() { this->SetCurve(Reinhard); }
  /** A film-like curve. */
  void SetCurveToACES() { this->SetCurve(ACES); }
  const char* GetCurveAsString();
  ///@}

  /**
   * Whether colours are displayed unchanged.
   */
  bool IsIdentity() const { return this->Exposure == 1.0 && this->Curve == Clamp; }

  /**
   * Maps linear radiance to linear display values, which are not clamped yet.
   */
  void MapTone(const double radiance[3], double display[3]) const;

  /**
   * Takes the values of another tone mapping. Null is ignored.
   */
  void DeepCopy(vtkCSLFToneMapping* source);

protected:
  vtkCSLFToneMapping();
  ~vtkCSLFToneMapping() override = default;

private:
  vtkCSLFToneMapping(const vtkCSLFToneMapping&) = delete;
  void operator=(const vtkCSLFToneMapping&) = delete;

  double Exposure;
  int Curve;
};

#endif
