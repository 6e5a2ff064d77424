// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The builds of the libraries in use.
 */
#ifndef cslfLibraries_h
#define cslfLibraries_h

#include <map>
#include <string>
#include <vector>

namespace cslf
{
/// The file names of this library and of loaded libraries whose names begin with the given texts,
/// each with the linker's build ID. Versions alone do not change when a distribution patches a
/// library or a developer rebuilds it. Empty if files are not ELF; callers add the versions that
/// libraries report.
std::map<std::string, std::string> FindLibraries(const std::vector<std::string>& names);
}

#endif
