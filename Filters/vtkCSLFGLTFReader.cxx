// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFGLTFReader.h"

#include "Pipeline/cslfGuard.h"

#include "GLTF/cslfGLTFDocument.h"
#include "GLTF/cslfGLTFPrimitives.h"
#include "Options/cslfOptionTable.h"
#include "SceneImport/cslfActorImporter.h"
#include "cslfJoin.h"
#include "vtkCSLFMaterial.h"

#include <glm/ext/quaternion_double.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace cslf
{
namespace
{
// Converts a glTF file to polygonal data with materials.

/// A node that is yet to be visited.
struct PendingNode
{
  std::size_t Index;
  glm::dmat4 ParentToWorld;
};

/// The transform of a node: a matrix by columns, or a translation, rotation and scale.
glm::dmat4 ReadTransform(const GLTFValue& node)
{
  const GLTFValue matrix = node["matrix"];
  glm::dmat4 transform(1.0);
  if (matrix.IsPresent())
  {
    const auto numbers = matrix.GetNumbers<16>({});
    for (int i = 0; i < 16; ++i)
    {
      transform[i / 4][i % 4] = numbers[i];
    }
    if (numbers[3] != 0.0 || numbers[7] != 0.0 || numbers[11] != 0.0 || numbers[15] != 1.0)
    {
      matrix.Fail("is not an affine transform");
    }
    return transform;
  }
  const auto offset = node["translation"].GetNumbers<3>({ 0.0, 0.0, 0.0 });
  const auto turn = node["rotation"].GetNumbers<4>({ 0.0, 0.0, 0.0, 1.0 });
  const auto scale = node["scale"].GetNumbers<3>({ 1.0, 1.0, 1.0 });
  const glm::dquat quaternion(turn[3], turn[0], turn[1], turn[2]);
  if (glm::length(quaternion) > 0.0)
  {
    transform = glm::mat4_cast(glm::normalize(quaternion));
  }
  for (int i = 0; i < 3; ++i)
  {
    transform[i] *= scale[i];
    transform[3][i] = offset[i];
  }
  return transform;
}

class Builder
{
public:
  Builder(GLTFDocument& document, GLTFErrors& errors)
    : Document(document)
    , Errors(errors)
    , Primitives(document, errors)
  {
  }

  std::vector<vtkSmartPointer<vtkPolyData>> Build()
  {
    this->NameExtensions();
    this->AddPending(this->FindRoots(), glm::dmat4(1.0));
    while (!this->Pending.empty())
    {
      const PendingNode node = this->Pending.back();
      this->Pending.pop_back();
      this->Errors.Attempt([&] { this->AddNode(node); });
    }
    return std::move(this->Blocks);
  }

private:
  /// Names the extensions that a file uses and that are not supported.
  void NameExtensions()
  {
    static const std::set<std::string> known = { "KHR_materials_ior", "KHR_materials_transmission",
      "KHR_materials_emissive_strength", "KHR_materials_volume", "KHR_materials_unlit",
      "KHR_lights_punctual", "KHR_texture_transform", "KHR_mesh_quantization", "EXT_texture_webp" };
    this->Errors.Attempt(
      [&]
      {
        const GLTFValue root = this->Document.GetRoot();
        const GLTFValue lights = root["extensions"]["KHR_lights_punctual"]["lights"];
        this->Errors.Omit(lights.GetCount() > 0, "lights");
        const GLTFValue used = root["extensionsUsed"];
        for (std::size_t i = 0; i < used.GetCount(); ++i)
        {
          const std::string name = used.At(i).GetText("");
          this->Errors.Omit(known.count(name) == 0, name.c_str());
        }
      });
  }

  /// The nodes of the default scene, or of the first one if none is named. If there are no scenes,
  /// all nodes that are not children.
  std::vector<std::size_t> FindRoots()
  {
    const GLTFValue scenes = this->Document.GetRoot()["scenes"];
    std::size_t scene = 0;
    this->Errors.Attempt([&] { scene = this->Document.GetRoot()["scene"].GetIndex(0); });
    std::vector<std::size_t> roots;
    this->Errors.Attempt(
      [&] {
        roots = scenes.GetCount() > 0 ? ReadList(scenes.At(scene)["nodes"]) : this->FindOrphans();
      });
    return roots;
  }

  static std::vector<std::size_t> ReadList(const GLTFValue& list)
  {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < list.GetCount(); ++i)
    {
      indices.push_back(list.At(i).GetIndex(0));
    }
    return indices;
  }

  std::vector<std::size_t> FindOrphans()
  {
    const GLTFValue nodes = this->Document.GetRoot()["nodes"];
    std::set<std::size_t> children;
    for (std::size_t i = 0; i < nodes.GetCount(); ++i)
    {
      const std::vector<std::size_t> list = ReadList(nodes.At(i)["children"]);
      children.insert(list.begin(), list.end());
    }
    std::vector<std::size_t> orphans;
    for (std::size_t i = 0; i < nodes.GetCount(); ++i)
    {
      if (children.count(i) == 0)
      {
        orphans.push_back(i);
      }
    }
    return orphans;
  }

  /// Nodes are visited in their order, children after their parent.
  void AddPending(const std::vector<std::size_t>& nodes, const glm::dmat4& parentToWorld)
  {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node)
    {
      this->Pending.push_back({ *node, parentToWorld });
    }
  }

  void AddNode(const PendingNode& pending)
  {
    const GLTFValue node = this->Document.GetElement("nodes", pending.Index);
    if (!this->Visited.insert(pending.Index).second)
    {
      node.Fail("has more than one parent, or is its own ancestor");
    }
    const glm::dmat4 toWorld = pending.ParentToWorld * ReadTransform(node);
    this->AddPending(ReadList(node["children"]), toWorld);
    if (const std::optional<std::size_t> mesh = node["mesh"].GetIndex())
    {
      this->Errors.Omit(node["skin"].IsPresent(), "skins, which are shown at rest");
      this->AddMesh(*mesh, toWorld);
    }
  }

  void AddMesh(std::size_t mesh, const glm::dmat4& toWorld)
  {
    vtkNew<vtkMatrix4x4> matrix;
    for (int i = 0; i < 16; ++i)
    {
      matrix->SetElement(i % 4, i / 4, toWorld[i / 4][i % 4]);
    }
    for (const vtkSmartPointer<vtkPolyData>& primitive : this->Primitives.Get(mesh))
    {
      this->Document.CountElements(primitive->GetNumberOfPoints() + primitive->GetNumberOfCells());
      auto block = vtkSmartPointer<vtkPolyData>::New();
      block->ShallowCopy(ExtractSurface(primitive, matrix));
      this->Blocks.push_back(block);
    }
  }

  GLTFDocument& Document;
  GLTFErrors& Errors;
  GLTFPrimitives Primitives;
  std::vector<PendingNode> Pending;
  std::set<std::size_t> Visited;
  std::vector<vtkSmartPointer<vtkPolyData>> Blocks;
};

/// The primitives of the nodes of the document's default scene, in world coordinates. Collects what
/// is invalid or not supported in the file.
std::vector<vtkSmartPointer<vtkPolyData>> MakeGLTFBlocks(GLTFDocument& document, GLTFErrors& errors)
{
  return Builder(document, errors).Build();
}
}
}

vtkStandardNewMacro(vtkCSLFGLTFReader);
cslfSetOptionMacro(vtkCSLFGLTFReader, PointRadius, PointRadius);
cslfGuardedRequestMacro(vtkCSLFGLTFReader);

vtkCSLFGLTFReader::vtkCSLFGLTFReader()
  : PointRadius(cslf::options::PointRadius.Default)
{
  this->SetNumberOfInputPorts(0);
}

vtkCSLFGLTFReader::~vtkCSLFGLTFReader()
{
  this->SetFileName(nullptr);
}

int vtkCSLFGLTFReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!this->FileName)
  {
    vtkErrorMacro("FileName is not set.");
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    return 0;
  }
  cslf::GLTFErrors errors;
  std::vector<vtkSmartPointer<vtkPolyData>> blocks;
  std::string error;
  cslf::Guard(
    [&]
    {
      cslf::GLTFDocument document(this->FileName);
      blocks = cslf::MakeGLTFBlocks(document, errors);
      error = blocks.empty() ? errors.ListErrors() : "";
      return true;
    },
    error);
  if (!error.empty())
  {
    vtkErrorMacro(
      "\"" << this->FileName << "\" cannot be read as glTF: " << cslf::MakePrintable(error) << ".");
    this->SetErrorCode(vtkErrorCode::FileFormatError);
    return 0;
  }

  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    if (this->PointRadius > 0.0 && blocks[i]->GetNumberOfVerts() > 0)
    {
      vtkCSLFMaterial::SetPointRadius(blocks[i], this->PointRadius);
    }
    output->SetBlock(static_cast<unsigned int>(i), blocks[i]);
  }
  const std::string left = errors.ListErrors();
  if (!left.empty())
  {
    vtkWarningMacro("Invalid parts of \""
      << this->FileName << "\" were left out: " << cslf::MakePrintable(left) << ".");
  }
  const std::string omitted = cslf::Join(errors.Omitted);
  if (!omitted.empty())
  {
    vtkWarningMacro("Unsupported features of \""
      << this->FileName << "\" were ignored: " << cslf::MakePrintable(omitted) << ".");
  }
  return 1;
}

void vtkCSLFGLTFReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "PointRadius: " << this->PointRadius << "\n";
}
