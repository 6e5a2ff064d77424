// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Code shared by the examples: sizes from the command line, actors, and saving a picture.
#ifndef Example_h
#define Example_h

#include <vtkCSLFMapper.h>
#include <vtkCSLFSampler.h>

#include <vtkActor.h>
#include <vtkAlgorithm.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>
#include <vtkWindowToImageFilter.h>

#include <cstdlib>

namespace example
{
/// Takes M, N and samples from the command line.
inline void SetSizes(
  vtkCSLFSampler* sampler, int argc, char* argv[], int viewpoints = 9, int resolution = 128)
{
  sampler->SetViewpoints(argc > 1 ? std::atoi(argv[1]) : viewpoints);
  sampler->SetResolution(argc > 2 ? std::atoi(argv[2]) : resolution);
  sampler->SetSamples(argc > 3 ? std::atoi(argv[3]) : 16);
}

/// An actor of the light field from a filter, source or reader.
inline vtkSmartPointer<vtkActor> MakeFieldActor(vtkAlgorithm* algorithm)
{
  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputConnection(algorithm->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

/// An ordinary actor of polygonal data.
inline vtkSmartPointer<vtkActor> MakeActor(vtkAlgorithm* algorithm)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(algorithm->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

/// Draws a window and writes its picture as PNG. Returns the exit code of a program.
inline int SavePicture(vtkRenderWindow* window, const char* fileName)
{
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(fileName);
  writer->Write();
  return writer->GetErrorCode() == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
}

#endif
