// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which builds of the libraries are at work.
 */
#ifndef cslfLibraries_h
#define cslfLibraries_h

#include <map>
#include <string>
#include <vector>

namespace cslf
{
/// The file names of this library and of the loaded ones whose names begin so, each with its build
/// ID, by which linkers tell builds apart: versions do not change where a distribution mends a
/// library or a developer builds anew. Empty where files are not ELF; the callers add the versions
/// that libraries tell of themselves.
std::map<std::string, std::string> FindLibraries(const std::vector<std::string>& names);
}

#endif
