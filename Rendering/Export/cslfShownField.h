// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The light field that a window shows, for exporters of its surfaces.
 */
#ifndef cslfShownField_h
#define cslfShownField_h

#include "cslfGeometryMesh.h"
#include "cslfShownMaps.h"

#include <vtkSmartPointer.h>

#include <functional>
#include <string>
#include <vector>

class vtkActor;
class vtkCSLFMapper;
class vtkExporter;
class vtkRenderer;

namespace cslf
{
struct ShownField
{
  vtkSmartPointer<vtkRenderer> Renderer;
  vtkSmartPointer<vtkActor> Actor;
  vtkCSLFMapper* Mapper = nullptr;
  ShownGeometry Shown;

  /// What the surfaces alone do not show, in sentences.
  std::vector<std::string> Omissions;
};

/// Makes the parts of a file, one after the other, of a field, whose omissions it may add to, and
/// of a title. May throw std::exception.
using PartMaker = std::function<std::vector<std::string>(ShownField&, const std::string&)>;

/// Writes what the exporter's window shows of the first visible actor with a vtkCSLFMapper in its
/// active renderer or, without one, in any. The file appears complete or not at all. If there is no
/// title, it is the file's name without its extension. The exporter reports errors, and warns of
/// what is left out.
void ExportField(
  vtkExporter* exporter, const char* fileName, const char* title, const PartMaker& make);
}

#endif
