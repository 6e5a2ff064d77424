// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The viewpoints that are asked about a scene's surfaces.
 */
#ifndef cslfViewpointChoice_h
#define cslfViewpointChoice_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfLayout.h"

#include <vector>

namespace cslf
{
/// The slices of all viewpoints or, if there are many, of about `most` along each side of a face.
VTKCSLF_EXPORT std::vector<int> ChooseSlices(const Layout& grid, int most);
}

#endif
