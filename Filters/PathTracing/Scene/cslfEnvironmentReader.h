// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The environment in the field data of data objects: see vtkCSLFLight.
 */
#ifndef cslfEnvironmentReader_h
#define cslfEnvironmentReader_h

#include "PathTracing/Lights/cslfEnvironment.h"

class vtkDataObject;

namespace cslf
{
/// Whether a data object, which may be null, contains an environment.
bool HasEnvironment(vtkDataObject* data);

/// Reads it. False if its arrays do not fit each other or are not finite.
bool ReadEnvironment(vtkDataObject* data, Environment& environment);
}

#endif
