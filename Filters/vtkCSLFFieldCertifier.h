// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFFieldCertifier
 * @brief   measures how well a light field shows its scene, as its certificate says
 *
 * vtkCSLFEncoder measures a light field when its file is finished, and the file carries the result
 * in its description: a certificate. This filter measures a field again. The scene is on input port
 * 0, with the parameters of vtkCSLFPathTracer, the whole field on port 1, and its geometry, if it
 * has one, on port 2: the output ports of vtkCSLFDecoder. Set scene, light, MaximumDepth,
 * Environment and Exposure as for the sampling of the field. If the scene's hash differs from that
 * in the field's description, Measure fails.
 *
 * Rays, each a pixel of a camera of its own outside the cube, are traced without a cache,
 * regardless of the Integrator, and compared with what vtkCSLFMapper draws there with its default
 * settings. That is computed without a window, from all viewpoints or, of fields of more than 1
 * GiB, from those around each ray. Balls that the mapper draws as spheres count as their triangles,
 * which is up to 2 dB worse. Differences are those of red, green and blue, encoded as sRGB
 * over black, as fractions of white. The paths of a ray are traced in two halves without common
 * random numbers, whose noise does not bias the result.
 *
 * The result depends on the field, the scene and the parameters only, not on the number of threads.
 *
 * @sa vtkCSLFEncoder vtkCSLFFieldReference
 */
#ifndef vtkCSLFFieldCertifier_h
#define vtkCSLFFieldCertifier_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkCSLFPathTracer.h"

#include <memory> // for std::unique_ptr
#include <string> // for std::string

namespace cslf
{
struct Certificate;
}

class VTKCSLF_EXPORT vtkCSLFFieldCertifier : public vtkCSLFPathTracer
{
public:
  static vtkCSLFFieldCertifier* New();
  vtkTypeMacro(vtkCSLFFieldCertifier, vtkCSLFPathTracer);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The number of rays. Range: 2 to 10000000. Default: that of the certificates of files.
   */
  void SetRays(int rays);
  vtkGetMacro(Rays, int);
  ///@}

  ///@{
  /**
   * The number of paths of each ray, rounded up to a multiple of 64. Range: 1 to 1048576. Default:
   * that of the certificates of files.
   */
  void SetRaySamples(int samples);
  vtkGetMacro(RaySamples, int);
  ///@}

  /**
   * Reads the inputs and measures. Other seeds choose other rays. Returns 1 on success and 0 on
   * failure.
   */
  int Measure();

  ///@{
  /**
   * The results of the last Measure, 0 if it failed. The mean is what the field shows minus what
   * the scene shows. The mean square is that of the difference. It may be negative if the noise of
   * the paths is larger. Both have standard errors. RMS and PSNR, in dB and at most 60, are those
   * of the mean square or, if this is larger, of its standard error. The share of the rays that
   * show or see a surface is from 0 to 1.
   */
  double GetMeanDifference();
  double GetMeanDifferenceError();
  double GetMeanSquare();
  double GetMeanSquareError();
  double GetRMS();
  double GetPSNR();
  double GetSeenShare();
  ///@}

  /**
   * The certificate of the last Measure as a JSON object, in the form of the file's. Empty if it
   * failed.
   */
  std::string GetCertificate();

protected:
  vtkCSLFFieldCertifier();
  ~vtkCSLFFieldCertifier() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCSLFFieldCertifier(const vtkCSLFFieldCertifier&) = delete;
  void operator=(const vtkCSLFFieldCertifier&) = delete;

  std::string FindOtherScene();

  int Rays;
  int RaySamples;
  const std::unique_ptr<cslf::Certificate> Result;
};

#endif
