// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The program of the user guide's C++ example: a viewer of box.mp4.
#include <vtkCSLFDecoder.h>
#include <vtkCSLFMapper.h>
#include <vtkCSLFToneMapping.h>

#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <chrono>
#include <cstdlib>

@BLOCK_2@

int main()
{
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName("box.mp4");
  vtkNew<vtkIdTypeArray> needed;
  vtkNew<vtkImageData> image;
  const vtkIdType z = 0;
  needed->InsertNextValue(z);
  {
@BLOCK_1@
  }
  decoder->WaitForPrefetch();
  if (!decoder->IsViewpointReady(z))
  {
    return EXIT_FAILURE;
  }

  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputConnection(decoder->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->GetActiveCamera()->SetPosition(0.7, 0.5, 4.6);
  vtkNew<vtkRenderWindow> window;
  window->AddRenderer(renderer);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
@BLOCK_4@
  window->Render();
@BLOCK_3@
  const auto start = std::chrono::steady_clock::now();
  while (!mapper->IsComplete() && std::chrono::steady_clock::now() - start < std::chrono::minutes(10))
  {
    interactor->ProcessEvents();
  }
  return mapper->IsComplete() ? EXIT_SUCCESS : EXIT_FAILURE;
}
