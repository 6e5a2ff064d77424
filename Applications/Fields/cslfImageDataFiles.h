// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Writes light fields as image data, .vti.
 */
#ifndef cslfImageDataFiles_h
#define cslfImageDataFiles_h

#include <string>

class vtkAlgorithmOutput;

namespace cslf::tool
{
/// Writes a field, which appears as a whole. What is sampled is written slab by slab, so that it
/// need not fit into memory. Throws a Failure, also if the disk lacks room. `label`: what the
/// progress says.
void WriteImageData(
  vtkAlgorithmOutput* connection, const std::string& fileName, const std::string& label);
}

#endif
