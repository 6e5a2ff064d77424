// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFRateControl
 * @brief   size and quality of the videos that vtkCSLFEncoder writes
 *
 * The quality is set by constant rate factors, or a target chooses them: a size, a ratio or a PSNR.
 * Key views reduce the size further, because only some of the viewpoints are coded. Several
 * encoders may share one object. See Documentation/Compression.md.
 *
 * @sa vtkCSLFEncoder
 */
#ifndef vtkCSLFRateControl_h
#define vtkCSLFRateControl_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkObject.h"

class VTKCSLF_EXPORT vtkCSLFRateControl : public vtkObject
{
public:
  static vtkCSLFRateControl* New();
  vtkTypeMacro(vtkCSLFRateControl, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set/get the constant rate factor of colour, from 0 (best) to 51 (smallest). An increase by
   * about 6 halves the size. The scale is that of x265, which is also that of x264. For AV1, the
   * integer on its own scale with about the same quality is used. Default: 22.
   */
  void SetCRF(double factor);
  vtkGetMacro(CRF, double);
  ///@}

  ///@{
  /**
   * Set/get the constant rate factor of coverage, from 0 to 51. If a target determines the rate
   * factor of colour, and it is above 22, that of coverage is increased by the difference. Default:
   * 24, with which novel views lose less than 0.3 dB, see Documentation/Compression.md.
   */
  void SetCoverageCRF(double factor);
  vtkGetMacro(CoverageCRF, double);
  ///@}

  ///@{
  /**
   * Set/get the constant rate factor of depth, from 0 to 51. With a target, it is increased like
   * that of coverage. Depth is coded by a curve that is finer near the entry face. Default: 8,
   * because lookups with depth correction need accurate depth.
   */
  void SetDepthCRF(double factor);
  vtkGetMacro(DepthCRF, double);
  ///@}

  ///@{
  /**
   * Set/get the target ratio of the raw colours, 3 bytes per texel, to the file with all tracks and
   * the container. The rate factors are chosen accordingly; the ratio is met within 3 %. 0 means no
   * such target. Only one of the three targets may be set, and none together with the encoder's
   * Lossless. Fewer bytes will do if these are of the best quality. If a target cannot be met
   * otherwise, an error states what can. Range: 0 to 1e9. Default: 0.
   */
  void SetTargetRatio(double ratio);
  vtkGetMacro(TargetRatio, double);
  ///@}

  ///@{
  /**
   * Set/get the target size of the file in bytes, which is met within 3 %, see TargetRatio. Range:
   * 0 to 1e18. Default: 0, no such target.
   */
  void SetTargetSize(double bytes);
  vtkGetMacro(TargetSize, double);
  ///@}

  ///@{
  /**
   * Set/get the target PSNR, in dB, of decoded colours against those of the input: red, green and
   * blue of 8 bits over black, with one mean square error over all texels. It is met within 0.3 dB,
   * see also TargetRatio. Range: 0 to 100. Default: 0, no such target.
   */
  void SetTargetPSNR(double psnr);
  vtkGetMacro(TargetPSNR, double);
  ///@}

  ///@{
  /**
   * Set/get the step of key views: of this number of viewpoints along each side of a face, one is
   * kept. The viewpoints on the edges are always kept, and between them as few as leave no larger
   * gap, evenly spread. The step is at most the number of viewpoints minus 1. AutomaticKeyViews
   * selects the largest step that reaches TargetNovelViewPSNR. Range: 0, which is
   * AutomaticKeyViews, to 4096. Default: 1, which keeps all viewpoints.
   */
  enum
  {
    AutomaticKeyViews = 0
  };
  void SetKeyViewStep(int step);
  vtkGetMacro(KeyViewStep, int);
  /** The largest step whose novel views reach TargetNovelViewPSNR. */
  void SetKeyViewStepToAutomatic() { this->SetKeyViewStep(AutomaticKeyViews); }
  ///@}

  ///@{
  /**
   * Set/get the target PSNR, in dB, of omitted viewpoints, reconstructed from the key views before
   * coding by the depth lookup (without depth, with the focus at the cube's centre), or on the
   * geometry that the file gets. It is measured for red, green and blue of 8 bits over black, on
   * the cube's face where it is lowest; for floats, at the exposure from 1/16 to 16 times the baked
   * one at which it is lowest. A seeded sample of viewpoints and texels is used. If no key views
   * reach the target, an error states the best PSNR. Used only with AutomaticKeyViews. Range: 0 to
   * 100. Default: 35.
   */
  void SetTargetNovelViewPSNR(double psnr);
  vtkGetMacro(TargetNovelViewPSNR, double);
  ///@}

  /**
   * Takes the values of another rate control. Null is ignored.
   */
  void DeepCopy(vtkCSLFRateControl* source);

protected:
  vtkCSLFRateControl();
  ~vtkCSLFRateControl() override = default;

private:
  vtkCSLFRateControl(const vtkCSLFRateControl&) = delete;
  void operator=(const vtkCSLFRateControl&) = delete;

  double CRF;
  double CoverageCRF;
  double DepthCRF;
  double TargetRatio;
  double TargetSize;
  double TargetPSNR;
  int KeyViewStep;
  double TargetNovelViewPSNR;
};

#endif
