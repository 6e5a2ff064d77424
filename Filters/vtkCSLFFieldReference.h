// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFFieldReference
 * @brief   measures texels of a light field against path-traced texels
 *
 * This filter traces some texels of a light field again, with the number of paths of a converged
 * reference, and compares them. The scene is on input port 0, with the parameters of
 * vtkCSLFPathTracer. The field, or any range of its viewpoints, is on port 1. It is read in slabs,
 * so it may be larger than memory. Only the compared texels are traced, so the time hardly depends
 * on the size of the field. Set the scene, light, MaximumDepth, Environment and Exposure as for
 * the sampling of the field. If the scene differs from the one recorded in the field's description,
 * a warning is given.
 *
 * The texels are chosen at random, one in each of equal ranges of all texels of the field, so every
 * viewpoint is represented. The reference is always path-traced without a cache, regardless of the
 * Integrator, with Samples paths for each texel, rounded up to a multiple of 32. The paths are
 * traced in two halves without common random numbers. The reference is the mean of the halves, and
 * their difference measures its noise.
 *
 * The output is an image of one row with one pixel for each measured texel. Its point data:
 * `Reference` and `Field`, 3 unsigned chars each, the compared colours; `Texel`, a vtkIdType, the
 * index of the texel among all points of the whole field. The figures are valid after Update() has
 * succeeded.
 *
 * @sa vtkCSLFFieldQuality vtkCSLFImageQuality
 */
#ifndef vtkCSLFFieldReference_h
#define vtkCSLFFieldReference_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkCSLFPathTracer.h"

#include <vector> // for std::vector

class VTKCSLF_EXPORT vtkCSLFFieldReference : public vtkCSLFPathTracer
{
public:
  static vtkCSLFFieldReference* New();
  vtkTypeMacro(vtkCSLFFieldReference, vtkCSLFPathTracer);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The number of texels to measure, at least 1. If the field has no more than that, each texel is
   * measured once. Default: 100000.
   */
  void SetTexels(int texels);
  vtkGetMacro(Texels, int);
  ///@}

  ///@{
  /**
   * The upper limit of the PSNR in dB; higher values are replaced by it. Default: 60.
   */
  vtkSetMacro(MaximumPSNR, double);
  vtkGetMacro(MaximumPSNR, double);
  ///@}

  /**
   * The peak signal-to-noise ratio in dB of red, green and blue as 8 bits over black.
   */
  vtkGetMacro(PSNR, double);

  /**
   * The PSNR in dB that a perfect field would have because of the noise of the reference, before
   * rounding to 8 bits; at most 100. The difference of the halves has four times the variance of
   * their mean's error, so this is their PSNR plus 6.02 dB. A PSNR is reliable if the noise floor
   * is at least 10 dB above it.
   */
  vtkGetMacro(NoiseFloor, double);

  ///@{
  /**
   * Both figures at several exposures, as factors of Exposure: 1/16, 1/4, 1, 4 and 16 for
   * floating-point fields, because a viewer may show these at another exposure; only 1 for byte
   * fields. This is the range in which vtkCSLFPathTracer controls noise. An index that is out of
   * range returns 0.
   */
  int GetNumberOfViewExposures();
  double GetViewExposure(int index);
  double GetPSNR(int index);
  double GetNoiseFloor(int index);
  ///@}

  /**
   * The number of measured texels.
   */
  vtkGetMacro(NumberOfTexels, vtkIdType);

protected:
  vtkCSLFFieldReference();
  ~vtkCSLFFieldReference() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCSLFFieldReference(const vtkCSLFFieldReference&) = delete;
  void operator=(const vtkCSLFFieldReference&) = delete;

  class Measurement;

  /// The figures at one exposure.
  struct Figures
  {
    double ViewExposure;
    double PSNR;
    double NoiseFloor;
  };

  int Texels = 100000;
  double MaximumPSNR = 60.0;
  double PSNR = 0.0;
  double NoiseFloor = 0.0;
  vtkIdType NumberOfTexels = 0;
  std::vector<Figures> AllFigures;
};

#endif
