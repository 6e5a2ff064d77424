// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The minimum for a project that finds CSLF: a field that is sampled, and a mapper that shows it.
#include <vtkCSLFCornellBoxSource.h>
#include <vtkCSLFEnvironment.h>
#include <vtkCSLFMapper.h>
#include <vtkCSLFSampler.h>

#include <vtkNew.h>

#include <cstdlib>

int main()
{
  vtkNew<vtkCSLFCornellBoxSource> box;
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputConnection(box->GetOutputPort());
  sampler->GetEnvironment()->SetModeToNone();
  sampler->SetViewpoints(2);
  sampler->SetResolution(16);
  sampler->SetSamples(1);
  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputConnection(sampler->GetOutputPort());
  const double* bounds = mapper->GetBounds();
  return bounds[0] < bounds[1] ? EXIT_SUCCESS : EXIT_FAILURE;
}
