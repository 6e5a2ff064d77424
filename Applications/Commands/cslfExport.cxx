// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf export: the triangles of a scene, or the surfaces of a light field with their light, in one
// file, for other programs.
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Fields/cslfFieldFiles.h"
#include "Fields/cslfOutputFiles.h"
#include "Files/cslfFileSystem.h"
#include "Options/cslfCameraOptions.h"
#include "Pictures/cslfFieldColors.h"
#include "Pictures/cslfPictures.h"
#include "Scenes/cslfSceneFiles.h"
#include "cslfCommands.h"

#include "Pipeline/cslfTriangleList.h"
#include "vtkCSLFGLTFExporter.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFPageExporter.h"

#include <vtkAppendPolyData.h>
#include <vtkCamera.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkOBJWriter.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

namespace cslf::tool
{
namespace
{
struct Options
{
  std::vector<std::string> Inputs;
  std::string Output;
  FieldColorOptions Colors;
  CameraOptions Camera;
  std::string Title;
  bool IsCompact = false;

  /// What only fields have.
  std::vector<const CLI::Option*> OfFields;
};

constexpr const char* PageFormat = ".html";
constexpr const char* GLTFFormat = ".glb";

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

Result ExportScene(const Options& options)
{
  for (const CLI::Option* option : options.OfFields)
  {
    if (option->count() > 0)
    {
      throw Failure(option->get_name() + " is for light fields (.html, .glb).");
    }
  }
  RequireWritable(options.Output);
  SceneOptions inputs;
  for (auto input = options.Inputs.rbegin(); input != options.Inputs.rend(); ++input)
  {
    inputs.AddFirst(*input);
  }
  const Scene scene = inputs.Read();
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

/// Whether pages can be given a picture.
bool HasDisplay()
try
{
  const SeparateMessages messages;
  RequireDisplay();
  return true;
}
catch (const Failure& failure)
{
  AddWarning(std::string("The page has no first picture: ") + failure.what());
  return false;
}

vtkSmartPointer<vtkExporter> MakeExporter(const Options& options, const std::string& format)
{
  if (format == GLTFFormat)
  {
    auto exporter = vtkSmartPointer<vtkCSLFGLTFExporter>::New();
    exporter->SetFileName(options.Output.c_str());
    exporter->SetTitle(options.Title.c_str());
    exporter->SetCompact(options.IsCompact);
    return exporter;
  }
  if (options.IsCompact)
  {
    throw Failure("--compact is for glTF (.glb).");
  }
  auto exporter = vtkSmartPointer<vtkCSLFPageExporter>::New();
  exporter->SetFileName(options.Output.c_str());
  exporter->SetTitle(options.Title.c_str());
  exporter->SetPoster(HasDisplay());
  return exporter;
}

Result ExportField(const Options& options, const std::string& format)
{
  const std::string& input = options.Inputs.front();
  if (options.Inputs.size() > 1)
  {
    throw Failure("One light field is exported at a time.");
  }
  if (IsSceneName(input) && LowerExtension(input) != ".vti")
  {
    throw Failure(input +
      " is a scene, and light fields, which cslf sample makes, are exported as " + format + ".");
  }
  RequireOther(input, options.Output);
  RequireWritable(options.Output);
  const FieldFile file = OpenField(input);
  ReadToDraw(file);
  const FieldColors colors =
    options.Colors.IsEmpty() ? FieldColors() : FieldColors(options.Colors, file);
  const vtkSmartPointer<vtkExporter> exporter = MakeExporter(options, format);
  FieldRenderer renderer(file, options.Camera.GetWidth(), options.Camera.GetHeight());
  renderer.SetBackground(options.Camera.GetBackground().data());
  renderer.SetColors(colors);
  renderer.Export(options.Camera.MakeCamera(file.Field.Box), exporter);
  Result result;
  const std::uintmax_t bytes = CountBytes(options.Output);
  result.JSON = { { "output", options.Output }, { "bytes", bytes } };
  result.Text = options.Output + ": " + std::to_string(bytes) + " bytes\n";
  return result;
}

Result Run(const Options& options)
{
  const std::string extension = LowerExtension(options.Output);
  if (extension == ".obj")
  {
    return ExportScene(options);
  }
  if (extension != PageFormat && extension != GLTFFormat)
  {
    throw Failure("Scenes are exported as .obj, light fields as .html or .glb.");
  }
  return ExportField(options, extension);
}
}

void AddExport(CLI::App& app, Command& chosen)
{
  CLI::App* command = app.add_subcommand("export",
    "Write the surfaces of a light field as a page for browsers or as glTF, or the triangles of a "
    "scene, for other programs");
  command->footer(MakeFooter(
    { "cslf export field.mp4 -o page.html", "cslf export flow.mp4 -o flow.glb --color-map viridis",
      "cslf export dragon.ply -o dragon.obj" },
    "Pages and glTF have all surfaces with their light, and pages load nothing else. Light that "
    "changes with the direction of view, such as reflections, is left out, with a warning.\n\n"
    "Of scenes, materials, lights, points and lines are left out. Normals and texture "
    "coordinates are written if all parts of the scene have them."));
  const auto options = std::make_shared<Options>();
  command
    ->add_option("input", options->Inputs,
      "a light field (.mp4, .mkv, or another one with geometry), for .html and .glb; files of a "
      "scene, or the name of a built-in one, for .obj")
    ->type_name(ScenePlaceholder)
    ->required();
  command->add_option("-o,--output", options->Output, "the output: .html, .glb or .obj")
    ->type_name(FilePlaceholder)
    ->required();
  const auto common = command->get_options();
  command
    ->add_option("--title", options->Title,
      "the page's title, or the name of the root node of glTF (default: the file's name)")
    ->type_name("TEXT");
  command->add_flag("--compact", options->IsCompact,
    "compress glTF three to five times, by an extension that three.js and model-viewer know, and "
    "VTK "
    "and f3d do not");
  options->Colors.AddColorsTo(*command);
  options->Camera.AddTo(*command);
  const auto all = command->get_options();
  std::copy_if(all.begin(), all.end(), std::back_inserter(options->OfFields),
    [&](const CLI::Option* option)
    { return std::find(common.begin(), common.end(), option) == common.end(); });
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
