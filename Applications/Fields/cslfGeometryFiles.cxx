// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryFiles.h"

#include "Console/cslfMessages.h"
#include "Files/cslfFileSystem.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "cslfFieldFiles.h"
#include "cslfOutputFiles.h"
#include "cslfSceneChecks.h"

#include "vtkCSLFDecoder.h"
#include "vtkCSLFGeometryFilter.h"

#include <vtkAlgorithmOutput.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <exception>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace cslf::tool
{
namespace
{
/// The description of the field that a geometry was written with; empty if unknown.
std::string GetFieldOf(vtkPolyData* geometry)
{
  auto* text =
    vtkStringArray::SafeDownCast(geometry->GetFieldData()->GetAbstractArray(GeometryFieldName));
  return text && text->GetNumberOfValues() == 1 ? text->GetValue(0) : std::string();
}

/// The reader of the geometry beside a field, which it has read. Throws a Failure if the file is
/// damaged or belongs to another field.
vtkSmartPointer<vtkAlgorithm> ReadBeside(const std::string& fileName, const Description& field)
{
  const SeparateMessages separate;
  CheckVTKXML(fileName);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(fileName.c_str());
  NameFileInErrors(reader, fileName);
  reader->Update();
  ThrowOnError();
  if (GetFieldOf(reader->GetOutput()) != field.ToText())
  {
    throw Failure(fileName + " belongs to another light field.");
  }
  const std::string fault = DescribeGeometryError(reader->GetOutput(), field.Box);
  if (!fault.empty())
  {
    throw Failure("Cannot use " + fileName + ": " + fault + ".");
  }
  return reader.Get();
}
}

vtkAlgorithmOutput* FieldFile::GetGeometry() const
{
  return this->GeometryReader
    ? this->GeometryReader->GetOutputPort(this->GeometryReader->GetNumberOfOutputPorts() - 1)
    : nullptr;
}

vtkPolyData* FieldFile::ReadGeometry() const
{
  vtkAlgorithmOutput* port = this->GetGeometry();
  if (!port)
  {
    return nullptr;
  }
  port->GetProducer()->Update(port->GetIndex());
  return vtkPolyData::SafeDownCast(port->GetProducer()->GetOutputDataObject(port->GetIndex()));
}

bool FieldFile::HasUsefulGeometry() const
{
  vtkPolyData* geometry = this->ReadGeometry();
  return geometry && IsUsefulGeometry(geometry);
}

std::string GetGeometryName(const std::string& fieldName)
{
  return ToName(ToPath(fieldName).replace_extension(".geometry.vtp"));
}

void OpenGeometry(FieldFile& file)
{
  if (auto* decoder = vtkCSLFDecoder::SafeDownCast(file.Reader))
  {
    file.GeometryReader = decoder->HasGeometry() ? decoder : nullptr;
    return;
  }
  const std::string fileName = GetGeometryName(file.FileName);
  std::error_code failure;
  if (file.Format != FieldFormat::ImageData || !std::filesystem::exists(ToPath(fileName), failure))
  {
    return;
  }
  try
  {
    file.GeometryReader = ReadBeside(fileName, file.Field);
  }
  catch (const Failure& fault)
  {
    // Not all messages of VTK name the file.
    const std::string reason = fault.what();
    file.GeometryMismatch = reason.find(ToName(ToPath(fileName).filename())) == std::string::npos
      ? "Cannot read " + fileName + ": " + reason
      : reason;
  }
  catch (const std::exception&)
  {
    file.GeometryMismatch = "Cannot read " + fileName + ": it is damaged or too large.";
  }
  if (!file.GeometryMismatch.empty())
  {
    AddWarning("The geometry was ignored: " + file.GeometryMismatch);
  }
}

void MakeGeometry(int triangles, FieldFile& file)
{
  if (file.GeometryReader || triangles == 0)
  {
    return;
  }
  if (!file.Field.FindChannel(KnownChannel::Depth))
  {
    throw Failure(file.FileName + " has no depth, which --geometry-triangles needs.");
  }
  const auto filter = vtkSmartPointer<vtkCSLFGeometryFilter>::New();
  filter->SetInputConnection(file.Reader->GetOutputPort());
  filter->SetGeometryTriangles(triangles);
  file.GeometryReader = filter;
}

void WarnOfLoss(const FieldFile& file)
{
  auto* filter = vtkCSLFGeometryFilter::SafeDownCast(file.GeometryReader);
  const double loss = filter ? GetGeometryLoss(filter->GetGeometry()).value_or(0.0) : 0.0;
  // The filter itself warns of more.
  if (loss > MaximumLossIfComplete && loss <= MaximumUsefulLoss)
  {
    std::ostringstream percent;
    percent << std::setprecision(2) << 100.0 * loss;
    AddWarning("The geometry lacks " + percent.str() +
      " % of the surfaces. The lookup depth may be sharper; see cslf evaluate.");
  }
}

void WriteGeometry(
  vtkAlgorithmOutput* connection, vtkAlgorithmOutput* geometry, const std::string& fieldName)
{
  vtkAlgorithm* producer = geometry->GetProducer();
  producer->Update(geometry->GetIndex());
  ThrowOnError();
  vtkNew<vtkPolyData> written;
  written->ShallowCopy(producer->GetOutputDataObject(geometry->GetIndex()));
  if (written->GetNumberOfCells() == 0)
  {
    return;
  }
  auto* image = vtkImageData::SafeDownCast(
    connection->GetProducer()->GetOutputDataObject(connection->GetIndex()));
  std::string error;
  const auto field = Description::ReadFrom(image, error);
  vtkNew<vtkStringArray> text;
  text->SetName(GeometryFieldName);
  text->InsertNextValue(field ? field->ToText() : "");
  // Shallow copies share their field data.
  vtkNew<vtkFieldData> numbers;
  numbers->ShallowCopy(written->GetFieldData());
  numbers->AddArray(text);
  written->SetFieldData(numbers);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->EncodeAppendedDataOff();
  writer->SetInputData(written);
  const std::string name = GetGeometryName(fieldName);
  OutputFile file(name);
  WriteTemporary(writer.Get(), file);
  // Whoever may not read the field may not read its surfaces either.
  std::error_code failure;
  if (!std::filesystem::exists(ToPath(name), failure))
  {
    std::filesystem::permissions(ToPath(file.GetTemporaryName()),
      std::filesystem::status(ToPath(fieldName), failure).permissions(), failure);
  }
  file.Publish();
}
}
