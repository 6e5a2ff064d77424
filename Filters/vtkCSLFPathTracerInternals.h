// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Private data of vtkCSLFPathTracer.
 */
#ifndef vtkCSLFPathTracerInternals_h
#define vtkCSLFPathTracerInternals_h

#include "Certificate/cslfCertifier.h"
#include "PathTracing/RadianceCache/cslfRadianceCache.h"
#include "PathTracing/Scene/cslfSceneBuilder.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFPathTracer.h"
#include "vtkCSLFRadianceCacheOptions.h"
#include "vtkCSLFSceneImporter.h"

#include <vtkScalarsToColors.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <string>

struct vtkCSLFPathTracer::vtkInternals
{
  explicit vtkInternals(vtkCSLFPathTracer& tracer)
    : Offered{ [&tracer] { return tracer.GetSceneHash(); },
      [&tracer](auto&&... arguments) { return tracer.TracePixels(arguments...); } }
  {
  }

  vtkSmartPointer<vtkCSLFSceneImporter> Importer; // if there is a renderer
  vtkSmartPointer<vtkScalarsToColors> LookupTable;
  vtkSmartPointer<vtkCSLFEnvironment> Environment = vtkSmartPointer<vtkCSLFEnvironment>::New();
  vtkSmartPointer<vtkCSLFRadianceCacheOptions> CacheOptions =
    vtkSmartPointer<vtkCSLFRadianceCacheOptions>::New();
  cslf::BuiltScene Scene;
  std::string SceneKey; // what the scene was built from; empty if there is none
  std::unique_ptr<cslf::RadianceCache> Cache;
  std::string CacheKey;      // what the cache was built for; empty if there is none
  bool IsProbe = false;      // the cache is only roughly right
  cslf::TracedScene Offered; // calls the tracer
  bool IsToldOf = true;      // whether what the user should know of the cache has been told
};

#endif
