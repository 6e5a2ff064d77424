// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFFieldReference
 * @brief   how close a light field's texels come to path-traced ones
 *
 * Traces texels of a light field anew, with as many paths as a converged reference takes, and
 * compares: the scene comes on input port 0 with the parameters of vtkCSLFPathTracer, the field, or
 * any range of its viewpoints, on port 1, in slabs, so it may be larger than memory. As the
 * reference is made of just the texels that are compared, fields of any size are measured in about
 * the same time. Give the scene, light, MaximumDepth, ShowEnvironment and Exposure that the field
 * was sampled with; a scene other than the one that the field's description remembers is reported
 * as a warning.
 *
 * The texels are chosen at random, one in each of so many ranges of equal length of all texels of
 * the field, so every viewpoint has its share. The reference is always path-traced without a cache,
 * whatever the Integrator; each texel with the paths that Samples says, rounded up to a multiple of
 * 32. They are traced in two halves that have no random numbers in common: the reference is their
 * mean, and what they differ by tells how noisy it is.
 *
 * The output is an image of one row with a pixel for each texel measured, for who wants to see more
 * than the figures. Its point data: `Reference` and `Field`, 3 unsigned chars each, the colours
 * that were compared; `Texel`, a vtkIdType, the texel's index among all points of the whole field.
 * The figures are valid after Update() has succeeded.
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
   * How many texels are measured: at least 1. Where the field has no more than that, each is
   * measured once. Default: 100000.
   */
  vtkSetClampMacro(Texels, int, 1, 100000000);
  vtkGetMacro(Texels, int);
  ///@}

  ///@{
  /**
   * The PSNR in dB that stands for all higher ones. Default: 60.
   */
  vtkSetMacro(MaximumPSNR, double);
  vtkGetMacro(MaximumPSNR, double);
  ///@}

  /**
   * The peak signal-to-noise ratio in dB of red, green and blue as 8 bits over black.
   */
  vtkGetMacro(PSNR, double);

  /**
   * The PSNR in dB that the reference's noise alone would leave of a perfect field, before rounding
   * to 8 bits; at most 100. The halves' difference has four times the variance of their mean's
   * error, so it is their PSNR plus 6.02 dB. A figure is to be trusted where this lies at least 10
   * dB above it.
   */
  vtkGetMacro(NoiseFloor, double);

  ///@{
  /**
   * A viewer may show a floating-point field at another exposure than the one that it was sampled
   * with. These are both figures at several exposures, as factors of Exposure: 1/16, 1/4, 1, 4 and
   * 16 for floating-point fields, 1 alone for fields of bytes. They are in the range where
   * vtkCSLFPathTracer controls noise. An index that is out of range returns 0.
   */
  int GetNumberOfViewExposures();
  double GetViewExposure(int index);
  double GetPSNR(int index);
  double GetNoiseFloor(int index);
  ///@}

  /**
   * The number of texels that were measured.
   */
  vtkGetMacro(NumberOfTexels, vtkIdType);

protected:
  vtkCSLFFieldReference();
  ~vtkCSLFFieldReference() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

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
