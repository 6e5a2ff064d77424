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
#include <string>

namespace cslf::tool
{
///@{
/// The polygonal data of an XML file, serial or parallel, or of a legacy file, and the surfaces of
/// its other data sets, with warnings that say so; many of them are blocks. Throws a Failure if the
/// file is damaged, announces more than it can hold, or is a light field.
vtkSmartPointer<vtkDataObject> ReadXMLGrid(const std::string& fileName);
vtkSmartPointer<vtkDataObject> ReadLegacyGrid(const std::string& fileName);
///@}

/// The files of the first time step of a collection (.pvd), each read by `read`. A warning says if
/// there are more steps.
vtkSmartPointer<vtkDataObject> ReadCollection(const std::string& fileName,
  const std::function<vtkSmartPointer<vtkDataObject>(const std::string&)>& read);
}

#endif
