// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Files that contain one JSON text.
 */
#ifndef cslfJSONFile_h
#define cslfJSONFile_h

#include "cslfJSON.h"
#include "vtkCSLFModule.h" // for export macro

#include <string>

namespace cslf
{
/// Parses a file like ParseJSON, which limits length and depth. Returns a discarded value on
/// failure; `error` then gives the reason in a few words.
VTKCSLF_EXPORT nlohmann::json ReadJSON(const std::string& fileName, std::string* error = nullptr);
}

#endif
