// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Declares nlohmann::json. Some versions of VTK before 9.5 bring a copy of it under the same name in
 * vtkAbstractArray.h; then that copy is used, because two of them cannot be included.
 */
#ifndef cslfJSONForward_h
#define cslfJSONForward_h

#include <vtkAbstractArray.h>

#ifdef vtk_nlohmannjson_h
#include VTK_NLOHMANN_JSON(json_fwd.hpp)
#else
#include <nlohmann/json_fwd.hpp>
#endif

#endif
