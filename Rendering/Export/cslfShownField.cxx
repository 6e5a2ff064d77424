// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfShownField.h"

#include "Files/cslfAtomicFile.h"
#include "Files/cslfFileSystem.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfGuard.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFToneMapping.h"

#include <vtkActor.h>
#include <vtkExporter.h>
#include <vtkMath.h>
#include <vtkPropCollection.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace cslf
{
namespace
{
bool HasExtent(vtkProp* prop)
{
  const double* bounds = prop->GetBounds();
  return bounds && vtkMath::AreBoundsInitialized(bounds) != 0;
}

/// Finds the field's actor, and counts what else the renderer shows in three dimensions, without
/// those that no camera is reset to, such as axes.
int FindActor(vtkRenderer* renderer, ShownField& field)
{
  int others = 0;
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator next;
  props->InitTraversal(next);
  while (vtkProp* prop = props->GetNextProp(next))
  {
    auto* actor = vtkActor::SafeDownCast(prop);
    auto* mapper = actor ? vtkCSLFMapper::SafeDownCast(actor->GetMapper()) : nullptr;
    if (!prop->GetVisibility())
    {
      continue;
    }
    if (mapper && !field.Mapper)
    {
      field.Renderer = renderer;
      field.Actor = actor;
      field.Mapper = mapper;
    }
    else if (prop->IsA("vtkProp3D") && prop->GetUseBounds() && HasExtent(prop))
    {
      ++others;
    }
  }
  return others;
}

std::size_t CountInexact(const std::vector<glm::vec4>& colors)
{
  return static_cast<std::size_t>(std::count_if(
    colors.begin(), colors.end(), [](const glm::vec4& color) { return color.w < 1.0f; }));
}

/// What depends on viewpoints, in percent of all points and sides.
int MeasureInexact(const GeometryMesh& mesh)
{
  const std::size_t count = mesh.Colors.size() + mesh.BackColors.size();
  const std::size_t inexact =
    mesh.HasExactColors ? CountInexact(mesh.Colors) + CountInexact(mesh.BackColors) : count;
  return static_cast<int>(
    std::ceil(100.0 * double(inexact) / double(std::max<std::size_t>(count, 1))));
}

void ListOmissions(ShownField& field, int others)
{
  const GeometryMesh& mesh = *field.Shown.Mesh;
  std::vector<std::string>& omissions = field.Omissions;
  const int inexact = MeasureInexact(mesh);
  if (inexact > 0)
  {
    omissions.push_back("Light that changes with the direction of view, such as reflections, and "
                        "colours finer than the triangles are left out: about " +
      std::to_string(inexact) + " % of the surfaces have their mean colour.");
  }
  if (IsOpaqueGeometry(field.Shown.Geometry))
  {
    omissions.emplace_back("Translucent surfaces are left out.");
  }
  else if (!mesh.IsComplete)
  {
    omissions.emplace_back("Surfaces that the geometry lacks are left out.");
  }
  if (field.Shown.Field.MayShowEnvironment())
  {
    omissions.emplace_back("The environment behind the surfaces is left out.");
  }
  if (field.Renderer->GetGradientBackground() || field.Renderer->GetTexturedBackground())
  {
    omissions.emplace_back("The background's gradient or picture is left out.");
  }
  vtkCSLFToneMapping* tone = field.Mapper->GetToneMapping();
  if (tone->GetExposure() != 1.0 || tone->GetCurve() != vtkCSLFToneMapping::Clamp)
  {
    omissions.emplace_back("Exposure and tone mapping are left out.");
  }
  if (field.Mapper->GetNumberOfClippingPlanes() > 0)
  {
    omissions.emplace_back("Clipping planes are left out.");
  }
  if (field.Actor->GetProperty()->GetOpacity() < 1.0)
  {
    omissions.emplace_back("The actor's opacity is left out.");
  }
  if (others > 0)
  {
    omissions.push_back(std::to_string(others) + " other object(s) of the window are left out.");
  }
}

// Throws std::runtime_error.
ShownField FindShownField(vtkRenderWindow* window, vtkRenderer* renderer)
{
  ShownField field;
  int others = 0;
  vtkRendererCollection* renderers = window->GetRenderers();
  vtkCollectionSimpleIterator next;
  renderers->InitTraversal(next);
  while (vtkRenderer* each = renderers->GetNextRenderer(next))
  {
    if (!field.Mapper && (!renderer || renderer == each))
    {
      others = FindActor(each, field);
    }
  }
  if (!field.Mapper)
  {
    throw std::runtime_error("the window shows no light field");
  }
  if (!field.Mapper->FindShownGeometry(field.Actor, field.Shown))
  {
    throw std::runtime_error("the light field has no geometry, which fields have whose surfaces "
                             "alone show them");
  }
  if (!field.Shown.Mesh->HasColors)
  {
    throw std::runtime_error("the surfaces of the light field's geometry have no colours");
  }
  ListOmissions(field, others);
  return field;
}

// Returns a warning, which is mostly empty. Throws std::runtime_error.
std::string WriteComplete(const std::string& fileName, const std::vector<std::string>& parts)
{
  AtomicFile file(fileName);
  std::string error;
  std::string warning;
  bool isWritten = file.Open(error);
  if (isWritten)
  {
    std::ofstream stream(ToPath(file.GetTemporaryName()), std::ios::binary);
    for (const std::string& part : parts)
    {
      stream.write(part.data(), static_cast<std::streamsize>(part.size()));
    }
    stream.close();
    isWritten = stream.good() && file.Publish(warning, error);
  }
  if (!isWritten)
  {
    error.erase(error.find_last_not_of('.') + 1);
    throw std::runtime_error("Cannot write " + fileName + (error.empty() ? "" : ": " + error) +
      DescribeShortage(fileName));
  }
  return warning;
}
}

void ExportField(
  vtkExporter* exporter, const char* fileName, const char* title, const PartMaker& make)
{
  if (!fileName || !*fileName)
  {
    vtkErrorWithObjectMacro(exporter, "A file name must be set.");
    return;
  }
  GuardMethod(exporter, "Nothing was exported",
    [&]
    {
      ShownField field = FindShownField(exporter->GetRenderWindow(), exporter->GetActiveRenderer());
      const std::string name = title && *title ? title : ToName(ToPath(fileName).stem());
      const std::string warning = WriteComplete(fileName, make(field, name));
      for (const std::string& omission : field.Omissions)
      {
        vtkWarningWithObjectMacro(exporter, << omission);
      }
      if (!warning.empty())
      {
        vtkWarningWithObjectMacro(exporter, << warning);
      }
      return true;
    });
}
}
