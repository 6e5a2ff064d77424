// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Defines nlohmann::json.
 */
#ifndef cslfJSON_h
#define cslfJSON_h

#include "cslfJSONForward.h"

#ifdef vtk_nlohmannjson_h
#include VTK_NLOHMANN_JSON(json.hpp)
#else
#include <nlohmann/json.hpp>
#endif

#endif
