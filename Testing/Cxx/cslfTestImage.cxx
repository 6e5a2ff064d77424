// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTestImage.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkTesting.h>
#include <vtkWindowToImageFilter.h>

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>

namespace cslf
{
namespace testing
{
bool MatchesBaseline(
  int argc, char* argv[], vtkRenderWindow* window, double leastPSNR, double mostDifferent)
{
  vtkNew<vtkTesting> testing;
  testing->AddArguments(argc, argv);
  window->Render();
  if (testing->IsInteractiveModeSpecified())
  {
    vtkNew<vtkRenderWindowInteractor> interactor;
    interactor->SetRenderWindow(window);
    interactor->Start();
    return true;
  }

  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(window);
  grabber->ReadFrontBufferOff();
  grabber->ShouldRerenderOff();
  grabber->Update();
  vtkDataArray* seen = grabber->GetOutput()->GetPointData()->GetScalars();

  const std::string baseline = testing->GetValidImageFileName();
  bool matches = false;
  if (vtksys::SystemTools::FileExists(baseline, true))
  {
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(baseline.c_str());
    reader->Update();
    vtkDataArray* expected = reader->GetOutput()->GetPointData()->GetScalars();
    if (expected && expected->GetNumberOfTuples() == seen->GetNumberOfTuples())
    {
      double sum = 0.0;
      vtkIdType different = 0;
      for (vtkIdType pixel = 0; pixel < seen->GetNumberOfTuples(); ++pixel)
      {
        double most = 0.0;
        for (int c = 0; c < 3; ++c)
        {
          const double d = seen->GetComponent(pixel, c) - expected->GetComponent(pixel, c);
          sum += d * d;
          most = std::max(most, std::abs(d));
        }
        different += most > 16.0;
      }
      const double count = static_cast<double>(seen->GetNumberOfTuples());
      const double psnr = 10.0 * std::log10(255.0 * 255.0 * 3.0 * count / std::max(sum, 1.0));
      std::cout << "against " << baseline << ": " << psnr << " dB, " << different
                << " pixels differ\n";
      matches = psnr >= leastPSNR && different <= mostDifferent * count;
    }
  }
  else
  {
    std::cout << "there is no baseline " << baseline << "\n";
  }
  if (!matches)
  {
    const std::string picture = std::string(testing->GetTempDirectory()) + "/" +
      vtksys::SystemTools::GetFilenameName(baseline);
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(grabber->GetOutputPort());
    writer->SetFileName(picture.c_str());
    writer->Write();
    std::cout << "the picture is in " << picture << "\n";
  }
  return matches;
}
}
}
