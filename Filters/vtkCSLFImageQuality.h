// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCSLFImageQuality
 * @brief compares two pictures: PSNR and SSIM
 *
 * vtkCSLFImageQuality compares two pictures of equal size (input ports 0 and 1; one slice of
 * unsigned char with 1 to 4 components), over all their pixels or over those inside a stencil (port
 * 2, optional), such as the pixels whose ray meets a light field's cube.
 *
 * - **PSNR** is computed from the mean square error over the pixels and the colour components, with
 * a peak of 255. It is at most MaximumPSNR (for identical pictures it would be infinite).
 * - **SSIM** is the structural similarity of Wang, Bovik, Sheikh and Simoncelli, "Image quality
 * assessment: from error visibility to structural similarity" (IEEE Transactions on Image
 * Processing 13(4), 2004), of the luma 0.299 R + 0.587 G + 0.114 B, in a Gaussian window of 11 x 11
 * pixels with a standard deviation of 1.5, with K1 = 0.01 and K2 = 0.03. It is the mean over the
 * pixels whose window lies inside the picture. If there are none, windows are cut off at the
 * picture's border.
 *
 * Alpha is ignored. Colours that are associated with their alpha, such as those of
 * vtkCSLFViewTracer and of light fields, are thereby composited over black.
 *
 * The output is the SSIM of each pixel's window, in double precision. The two figures are valid
 * after Update() has succeeded.
 */
#ifndef vtkCSLFImageQuality_h
#define vtkCSLFImageQuality_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkImageAlgorithm.h"

class vtkImageStencilData;

class VTKCSLF_EXPORT vtkCSLFImageQuality : public vtkImageAlgorithm
{
public:
  static vtkCSLFImageQuality* New();
  vtkTypeMacro(vtkCSLFImageQuality, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The pixels to measure. Default: none, which measures all pixels.
   */
  void SetStencilData(vtkImageStencilData* stencil);
  void SetStencilConnection(vtkAlgorithmOutput* connection);
  ///@}

  ///@{
  /**
   * The upper limit of the PSNR in dB; higher values are replaced by it. Default: 60.
   */
  vtkSetMacro(MaximumPSNR, double);
  vtkGetMacro(MaximumPSNR, double);
  ///@}

  /**
   * The peak signal-to-noise ratio in dB.
   */
  vtkGetMacro(PSNR, double);

  /**
   * The mean structural similarity, at most 1.
   */
  vtkGetMacro(SSIM, double);

  /**
   * The number of measured pixels.
   */
  vtkGetMacro(NumberOfPixels, vtkIdType);

protected:
  vtkCSLFImageQuality();
  ~vtkCSLFImageQuality() override = default;

  int FillInputPortInformation(int port, vtkInformation* information) override;
  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCSLFImageQuality(const vtkCSLFImageQuality&) = delete;
  void operator=(const vtkCSLFImageQuality&) = delete;

  double MaximumPSNR = 60.0;
  double PSNR = 0.0;
  double SSIM = 0.0;
  vtkIdType NumberOfPixels = 0;
};

#endif
