// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reads VTK's data sets of all kinds, of which the surface is shown.
 */
#ifndef cslfGridReader_h
#define cslfGridReader_h

#include <vtkDataObject.h>
#include <vtkSmartPointer.h>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cslf::tool
{
///@{
/// The polygonal data of an XML file, serial or parallel, or of a legacy file, and the surfaces of
/// its other data sets, with warnings that say so; many of them are blocks. Throws a Failure if the
/// file is damaged, announces more than it can hold, or is a light field. A time is for XML files
/// that have several, of which the first is the default.
vtkSmartPointer<vtkDataObject> ReadXMLGrid(
  const std::string& fileName, std::optional<double> time = std::nullopt);
vtkSmartPointer<vtkDataObject> ReadLegacyGrid(const std::string& fileName);
///@}

/// The times of an XML file that has several. Empty for others, also for damaged ones.
std::vector<double> FindXMLTimes(const std::string& fileName);

/// The files at each time of a collection (.pvd), or of a file series (.vtp.series), in the folder
/// where these are. Throws a Failure if it is neither.
using TimedFiles = std::map<double, std::vector<std::string>>;
TimedFiles FindCollected(const std::string& fileName);
TimedFiles FindSeries(const std::string& fileName);

/// Some of these files as blocks, each read by `read`.
vtkSmartPointer<vtkDataObject> ReadBlocks(const std::vector<std::string>& fileNames,
  const std::function<vtkSmartPointer<vtkDataObject>(const std::string&)>& read);
}

#endif
