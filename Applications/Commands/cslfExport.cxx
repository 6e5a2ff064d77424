// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf export: the triangles of a scene in one file, for other programs.
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Fields/cslfFieldFiles.h"
#include "Fields/cslfOutputFiles.h"
#include "Files/cslfFileSystem.h"
#include "Scenes/cslfSceneFiles.h"
#include "cslfCommands.h"

#include "Pipeline/cslfTriangleList.h"
#include "vtkCSLFInstances.h"

#include <vtkAppendPolyData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkOBJWriter.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

namespace fs = std::filesystem;

namespace cslf::tool
{
namespace
{
struct Options
{
  SceneOptions Scene;
  std::string Output;
};

/// Adds the triangles of polygonal data, at each of its instances if it has any.
void AddTriangles(vtkPolyData* polyData, vtkAppendPolyData* append)
{
  const Triangulation cut = TriangulatePolygons(polyData);
  const vtkIdType lost = cut.CountOmitted();
  if (lost > 0)
  {
    AddWarning(std::to_string(lost) +
      " polygon(s) were left out, because they have no area, would take too long to fill, or have "
      "coordinates that are not finite.");
  }
  vtkDataArray* matrices = polyData->GetFieldData()->GetArray(vtkCSLFInstances::InstanceMatrix());
  if (!matrices || matrices->GetNumberOfComponents() != 16)
  {
    append->AddInputData(cut.Triangles);
    return;
  }
  for (vtkIdType instance = 0; instance < matrices->GetNumberOfTuples(); ++instance)
  {
    vtkNew<vtkTransform> transform;
    transform->SetMatrix(matrices->GetTuple(instance));
    vtkNew<vtkTransformPolyDataFilter> place;
    place->SetInputData(cut.Triangles);
    place->SetTransform(transform);
    place->Update();
    append->AddInputData(place->GetOutput());
  }
}

vtkSmartPointer<vtkPolyData> MakeTriangles(const Scene& scene)
{
  vtkNew<vtkAppendPolyData> append;
  scene.ForEachPolyData([&](vtkPolyData* polyData) { AddTriangles(polyData, append); });
  append->Update();
  ThrowOnError();
  if (append->GetOutput()->GetNumberOfPolys() == 0)
  {
    throw Failure("The scene has no triangles.");
  }
  return append->GetOutput();
}

/// The lines of faces in an OBJ file, which are at its end.
vtkIdType CountFaces(const std::string& fileName)
{
  std::ifstream stream(ToPath(fileName));
  vtkIdType faces = 0;
  // A truncated file has no end of line.
  for (std::string line; std::getline(stream, line) && !stream.eof();)
  {
    faces += line.rfind("f ", 0) == 0 ? 1 : 0;
  }
  return faces;
}

Result Run(const Options& options)
{
  if (ToPath(options.Output).extension() != ".obj")
  {
    throw Failure("Scenes are exported as .obj.");
  }
  RequireWritable(options.Output);
  const Scene scene = options.Scene.Read();
  const auto triangles = MakeTriangles(scene);
  vtkNew<vtkOBJWriter> writer;
  writer->SetInputData(triangles);
  OutputFile file(options.Output);
  const vtkIdType count = triangles->GetNumberOfPolys();
  WriteTemporary(writer.Get(), file,
    [count](const std::string& fileName) { return CountFaces(fileName) == count; });
  file.Publish();
  Result result;
  result.JSON = { { "output", options.Output }, { "triangles", triangles->GetNumberOfPolys() },
    { "points", triangles->GetNumberOfPoints() } };
  result.Text =
    options.Output + ": " + std::to_string(triangles->GetNumberOfPolys()) + " triangles\n";
  return result;
}
}

void AddExport(CLI::App& app, Command& chosen)
{
  CLI::App* command =
    app.add_subcommand("export", "Write the triangles of a scene to a file for other programs");
  command->footer(MakeFooter({ "cslf export dragon.ply -o dragon.obj" },
    "Materials, lights, points and lines are left out. Normals and texture "
    "coordinates are written if all parts of the scene have them."));
  const auto options = std::make_shared<Options>();
  options->Scene.AddInputsTo(*command);
  command->add_option("-o,--output", options->Output, "the output: .obj")
    ->type_name(FilePlaceholder)
    ->required();
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
