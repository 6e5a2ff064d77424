// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFGLTFReader.h"

#include "Pipeline/cslfGuard.h"

#include "GLTF/cslfGLTFBlocks.h"
#include "GLTF/cslfGLTFDocument.h"
#include "GLTF/cslfGLTFProblems.h"
#include "Options/cslfOptionTable.h"
#include "cslfJoin.h"
#include "cslfPrintable.h"
#include "vtkCSLFMaterial.h"

#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <string>
#include <vector>

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
  cslf::GLTFProblems problems;
  std::vector<vtkSmartPointer<vtkPolyData>> blocks;
  std::string error;
  cslf::Guard(
    [&]
    {
      cslf::GLTFDocument document(this->FileName);
      blocks = cslf::MakeGLTFBlocks(document, problems);
      error = blocks.empty() ? problems.ListErrors() : "";
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
  const std::string errors = problems.ListErrors();
  if (!errors.empty())
  {
    vtkWarningMacro("Invalid parts of \""
      << this->FileName << "\" were left out: " << cslf::MakePrintable(errors) << ".");
  }
  const std::string omitted = cslf::Join(problems.Omitted);
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
