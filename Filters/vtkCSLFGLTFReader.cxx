// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFGLTFReader.h"

#include "SceneImport/cslfGLTFBlocks.h"
#include "SceneImport/cslfGLTFExtensions.h"
#include "SceneImport/cslfImportedScene.h"

#include <vtkCommand.h>
#include <vtkErrorCode.h>
#include <vtkEventForwarderCommand.h>
#include <vtkGLTFDocumentLoader.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>

#include <vtksys/SystemTools.hxx>

#include <string>
#include <vector>

vtkStandardNewMacro(vtkCSLFGLTFReader);

namespace
{
/// Loads a file. What goes wrong is told by the loader's events.
bool Load(vtkGLTFDocumentLoader* loader, const std::string& fileName)
{
  std::vector<char> binary;
  const std::string extension =
    vtksys::SystemTools::LowerCase(vtksys::SystemTools::GetFilenameLastExtension(fileName));
  if (extension == ".glb" && !loader->LoadFileBuffer(fileName, binary))
  {
    return false;
  }
  if (!loader->LoadModelMetaDataFromFile(fileName) || !loader->LoadModelData(binary) ||
    !loader->BuildModelVTKGeometry())
  {
    return false;
  }
  loader->BuildGlobalTransforms();
  return true;
}
}

vtkCSLFGLTFReader::vtkCSLFGLTFReader()
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
  vtkNew<vtkGLTFDocumentLoader> loader;
  // One error is enough, and the loader warns of extensions that are read here.
  vtkNew<vtkEventForwarderCommand> silence;
  loader->AddObserver(vtkCommand::ErrorEvent, silence);
  loader->AddObserver(vtkCommand::WarningEvent, silence);
  if (!Load(loader, this->FileName))
  {
    vtkErrorMacro("\"" << this->FileName << "\" cannot be read as glTF.");
    this->SetErrorCode(vtkErrorCode::FileFormatError);
    return 0;
  }

  cslf::ImportedScene scene;
  cslf::BuildGLTFBlocks(
    *loader->GetInternalModel(), cslf::ReadGLTFExtensions(this->FileName, scene.Omitted), scene);
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  unsigned int index = 0;
  for (const cslf::ImportedBlock& block : scene.Blocks)
  {
    output->SetBlock(index++, block.Data);
  }
  if (!scene.Omitted.empty())
  {
    vtkWarningMacro(
      "Not represented of \"" << this->FileName << "\": " << scene.ListOmitted() << ".");
  }
  return 1;
}

void vtkCSLFGLTFReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
