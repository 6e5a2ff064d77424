// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Finds the geometry that belongs to a light field in a pipeline.
 */
#ifndef cslfGeometryPort_h
#define cslfGeometryPort_h

class vtkAlgorithmOutput;

namespace cslf
{
/**
 * The output port with the geometry of the field that `field` delivers, or null if there is none.
 * It is the second port of the sampler or reader that made the field, also if the field has been
 * resampled since, because surfaces stay where they are. `field` may be null.
 */
vtkAlgorithmOutput* FindGeometryPort(vtkAlgorithmOutput* field);
}

#endif
