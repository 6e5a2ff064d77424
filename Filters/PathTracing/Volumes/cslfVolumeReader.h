// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Converts VTK's grids with the arrays of vtkCSLFVolume to volumes.
 */
#ifndef cslfVolumeReader_h
#define cslfVolumeReader_h

#include "cslfVolume.h"

#include <optional>
#include <string>

class vtkDataObject;

namespace cslf
{
/// Whether a data object is shown as a volume.
bool IsVolume(vtkDataObject* data);

/// Reads such a data object. Without a result, `problem` says in a few words why.
std::optional<VolumeData> ReadVolume(vtkDataObject* data, std::string& problem);
}

#endif
