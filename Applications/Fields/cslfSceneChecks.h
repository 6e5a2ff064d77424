// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Checks files before VTK's readers, which trust the numbers in them, read them.
 */
#ifndef cslfSceneChecks_h
#define cslfSceneChecks_h

#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>

#include <string>

namespace cslf::tool
{
/// Throws a Failure if an XML file of VTK, or a file that it refers to, declares more data than the
/// file can hold.
void CheckVTKXML(const std::string& fileName);

/// The root of an XML file; null if the file is not XML. Throws a Failure if elements are nested
/// too deeply.
vtkSmartPointer<vtkXMLDataElement> ReadVTKXML(const std::string& fileName);
}

#endif
