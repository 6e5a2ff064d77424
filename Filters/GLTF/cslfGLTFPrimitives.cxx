// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGLTFPrimitives.h"

#include "cslfColor.h"
#include "cslfGLTFDocument.h"

#include <vtkCellArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace cslf
{
namespace
{
// Reads the numbers of a glTF file's accessors.

/// Tuples of numbers.
struct GLTFNumbers
{
  int Components = 1;
  std::vector<double> Values;

  std::size_t GetCount() const { return this->Values.size() / this->Components; }
};

/// How integers are converted.
enum class GLTFIntegers
{
  AsDeclared, ///< divided by the largest integer of their type if the accessor is normalized
  Normalized  ///< always divided by it
};

// Component types are OpenGL's numbers: glTF 2.0, section 3.6.2.2.
enum ComponentType
{
  Byte = 5120,
  UnsignedByte = 5121,
  Short = 5122,
  UnsignedShort = 5123,
  UnsignedInt = 5125,
  Float = 5126
};

std::size_t GetSize(const GLTFValue& type)
{
  switch (type.GetIndex(0))
  {
    case Byte:
    case UnsignedByte:
      return 1;
    case Short:
    case UnsignedShort:
      return 2;
    case UnsignedInt:
    case Float:
      return 4;
    default:
      type.Fail("is not a component type");
  }
}

int GetComponents(const GLTFValue& type)
{
  const std::string name = type.GetText("");
  if (name == "SCALAR")
  {
    return 1;
  }
  if (name == "VEC2" || name == "VEC3" || name == "VEC4")
  {
    return name[3] - '0';
  }
  type.Fail("is not SCALAR, VEC2, VEC3 or VEC4");
}

/// The number in little-endian bytes.
double ReadComponent(const unsigned char* bytes, std::size_t type)
{
  const auto at = [bytes](int i) { return static_cast<std::uint32_t>(bytes[i]); };
  switch (type)
  {
    case Byte:
      return static_cast<std::int8_t>(at(0));
    case UnsignedByte:
      return at(0);
    case Short:
      return static_cast<std::int16_t>(at(0) | at(1) << 8);
    case UnsignedShort:
      return at(0) | at(1) << 8;
    default:
      break;
  }
  const std::uint32_t bits = at(0) | at(1) << 8 | at(2) << 16 | at(3) << 24;
  if (type == UnsignedInt)
  {
    return bits;
  }
  float number;
  std::memcpy(&number, &bits, sizeof(number));
  return number;
}

/// The integer that stands for 1: glTF 2.0, section 3.6.2.2.
double GetUnit(std::size_t type)
{
  switch (type)
  {
    case Byte:
      return std::numeric_limits<std::int8_t>::max();
    case UnsignedByte:
      return std::numeric_limits<std::uint8_t>::max();
    case Short:
      return std::numeric_limits<std::int16_t>::max();
    case UnsignedShort:
      return std::numeric_limits<std::uint16_t>::max();
    default:
      return 1.0;
  }
}

/// Reads tuples of numbers from a buffer view, all of which must lie within it.
std::vector<double> ReadView(GLTFDocument& document, const GLTFValue& owner,
  const GLTFValue& componentType, std::size_t count, int components)
{
  const std::optional<std::size_t> index = owner["bufferView"].GetIndex();
  if (!index)
  {
    owner.Fail("has no bufferView");
  }
  const GLTFBytes view = document.GetBufferView(*index);
  const std::size_t offset = owner["byteOffset"].GetIndex(0);
  const std::size_t type = componentType.GetIndex(0);
  const std::size_t size = GetSize(componentType);
  const std::size_t tuple = size * components;
  const std::size_t stride = view.Stride > 0 ? view.Stride : tuple;
  if (stride < tuple)
  {
    owner.Fail("has elements that are larger than its byteStride");
  }
  // Written so that it cannot overflow.
  if (count > 0 &&
    (offset > view.Size || tuple > view.Size - offset ||
      count - 1 > (view.Size - offset - tuple) / stride))
  {
    owner.Fail("exceeds its bufferView");
  }
  std::vector<double> values;
  values.reserve(count * components);
  for (std::size_t i = 0; i < count; ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      values.push_back(ReadComponent(view.Data + offset + i * stride + c * size, type));
    }
  }
  return values;
}

/// Replaces the elements that a sparse accessor lists.
void ReplaceSparse(GLTFDocument& document, const GLTFValue& accessor, GLTFNumbers& numbers)
{
  const GLTFValue sparse = accessor["sparse"];
  if (!sparse.IsPresent())
  {
    return;
  }
  const std::size_t count = sparse["count"].GetIndex(0);
  const GLTFValue indices = sparse["indices"];
  const std::vector<double> places =
    ReadView(document, indices, indices["componentType"], count, 1);
  const std::vector<double> values =
    ReadView(document, sparse["values"], accessor["componentType"], count, numbers.Components);
  for (std::size_t i = 0; i < count; ++i)
  {
    if (!(places[i] >= 0.0) || places[i] >= static_cast<double>(numbers.GetCount()))
    {
      sparse.Fail("has indices of missing elements");
    }
    std::copy_n(values.begin() + i * numbers.Components, numbers.Components,
      numbers.Values.begin() + static_cast<std::size_t>(places[i]) * numbers.Components);
  }
}

/// Reads an accessor of scalars or vectors, which may be sparse. Throws a GLTFError if bytes are
/// missing.
GLTFNumbers ReadAccessor(
  GLTFDocument& document, std::size_t index, GLTFIntegers integers = GLTFIntegers::AsDeclared)
{
  const GLTFValue accessor = document.GetElement("accessors", index);
  const std::size_t count = accessor["count"].GetIndex(0);
  const GLTFValue componentType = accessor["componentType"];
  GLTFNumbers numbers;
  numbers.Components = GetComponents(accessor["type"]);
  if (accessor["bufferView"].IsPresent())
  {
    numbers.Values = ReadView(document, accessor, componentType, count, numbers.Components);
    document.CountElements(count);
  }
  else
  {
    document.CountZeros(count);
    numbers.Values.assign(count * numbers.Components, 0.0);
  }
  ReplaceSparse(document, accessor, numbers);
  if (integers == GLTFIntegers::Normalized || accessor["normalized"].GetBool(false))
  {
    const double unit = GetUnit(componentType.GetIndex(0));
    for (double& value : numbers.Values)
    {
      value = unit == 1.0 ? value : std::max(value / unit, -1.0);
    }
  }
  return numbers;
}

/// Reads an accessor of indices, which are unsigned integers.
std::vector<std::uint32_t> ReadIndices(GLTFDocument& document, std::size_t index)
{
  const GLTFValue accessor = document.GetElement("accessors", index);
  const std::size_t type = accessor["componentType"].GetIndex(0);
  if (type != UnsignedByte && type != UnsignedShort && type != UnsignedInt)
  {
    accessor.Fail("has indices that are not unsigned integers");
  }
  const GLTFNumbers numbers = ReadAccessor(document, index);
  if (numbers.Components != 1)
  {
    accessor.Fail("has indices that are not scalars");
  }
  std::vector<std::uint32_t> indices;
  indices.reserve(numbers.Values.size());
  for (double value : numbers.Values)
  {
    indices.push_back(static_cast<std::uint32_t>(value));
  }
  return indices;
}

// The topology of a primitive's indices: glTF 2.0, section 5.24.
enum Mode
{
  Points,
  Lines,
  LineLoop,
  LineStrip,
  Triangles,
  TriangleStrip,
  TriangleFan
};

using Indices = std::vector<std::uint32_t>;

/// Makes cells of indices, without those that have indices of missing vertices.
class CellMaker
{
public:
  CellMaker(const Indices& indices, vtkIdType vertices)
    : Source(indices)
    , Vertices(vertices)
  {
  }

  void Make(std::size_t mode, vtkPolyData* data)
  {
    switch (mode)
    {
      case Points:
        this->Step(1, 1);
        data->SetVerts(this->Cells);
        break;
      case Lines:
        this->Step(2, 2);
        data->SetLines(this->Cells);
        break;
      case LineLoop:
      case LineStrip:
        this->Step(2, 1);
        this->CloseLoop(mode == LineLoop);
        data->SetLines(this->Cells);
        break;
      default:
        this->MakeTriangles(mode);
        data->SetPolys(this->Cells);
    }
  }

  vtkIdType GetNumberOfCells() const { return this->Cells->GetNumberOfCells(); }
  vtkIdType GetNumberOfBroken() const { return this->Broken; }

private:
  void Step(std::size_t size, std::size_t step)
  {
    for (std::size_t i = 0; i + size <= this->Source.size(); i += step)
    {
      this->Add({ i, i + 1, i + 2 }, size);
    }
  }

  void CloseLoop(bool isLoop)
  {
    if (isLoop && this->Source.size() > 2)
    {
      this->Add({ this->Source.size() - 1, 0, 0 }, 2);
    }
  }

  void MakeTriangles(std::size_t mode)
  {
    if (mode == Triangles)
    {
      this->Step(3, 3);
      return;
    }
    for (std::size_t i = 0; i + 3 <= this->Source.size(); ++i)
    {
      if (mode == TriangleFan)
      {
        this->Add({ i + 1, i + 2, 0 }, 3);
      }
      else
      {
        // The orientation of every other triangle of a strip is reversed.
        this->Add({ i, i + 1 + i % 2, i + 2 - i % 2 }, 3);
      }
    }
  }

  void Add(const std::array<std::size_t, 3>& places, std::size_t size)
  {
    vtkIdType ids[3];
    for (std::size_t i = 0; i < size; ++i)
    {
      ids[i] = this->Source[places[i]];
      if (ids[i] >= this->Vertices)
      {
        ++this->Broken;
        return;
      }
    }
    this->Cells->InsertNextCell(static_cast<vtkIdType>(size), ids);
  }

  const Indices& Source;
  vtkIdType Vertices;
  vtkNew<vtkCellArray> Cells;
  vtkIdType Broken = 0;
};

/// The positions as floats, as in most files, or converted from integers.
vtkSmartPointer<vtkPoints> ToPoints(const GLTFNumbers& positions)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToFloat();
  points->SetNumberOfPoints(static_cast<vtkIdType>(positions.GetCount()));
  for (std::size_t i = 0; i < positions.GetCount(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), &positions.Values[3 * i]);
  }
  return points;
}

vtkSmartPointer<vtkFloatArray> MakeArray(const char* name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

/// Reads an attribute that must have one value per vertex.
GLTFNumbers ReadAttribute(GLTFDocument& document, const GLTFValue& attribute, std::size_t accessor,
  vtkIdType vertices, GLTFIntegers integers)
{
  GLTFNumbers numbers = ReadAccessor(document, accessor, integers);
  if (static_cast<vtkIdType>(numbers.GetCount()) != vertices)
  {
    attribute.Fail("has " + std::to_string(numbers.GetCount()) + " elements for " +
      std::to_string(vertices) + " positions");
  }
  return numbers;
}
}

GLTFPrimitives::GLTFPrimitives(GLTFDocument& document, GLTFErrors& errors)
  : Document(document)
  , Errors(errors)
  , Materials(document, errors)
{
}

const std::vector<vtkSmartPointer<vtkPolyData>>& GLTFPrimitives::Get(std::size_t mesh)
{
  const auto found = this->Known.find(mesh);
  if (found != this->Known.end())
  {
    return found->second;
  }
  std::vector<vtkSmartPointer<vtkPolyData>>& primitives = this->Known[mesh];
  const GLTFValue source = this->Document.GetElement("meshes", mesh)["primitives"];
  for (std::size_t i = 0; i < source.GetCount(); ++i)
  {
    this->Errors.Attempt(
      [&]
      {
        if (const vtkSmartPointer<vtkPolyData> data = this->Read(source.At(i)))
        {
          primitives.push_back(data);
        }
      });
  }
  return primitives;
}

vtkSmartPointer<vtkPolyData> GLTFPrimitives::Read(const GLTFValue& primitive)
{
  this->Errors.Omit(primitive["targets"].GetCount() > 0, "morph targets, which are shown at rest");
  const GLTFValue attributes = primitive["attributes"];
  const std::optional<std::size_t> position = attributes["POSITION"].GetIndex();
  if (!position)
  {
    primitive.Fail("has no positions");
  }
  const GLTFNumbers positions = ReadAccessor(this->Document, *position);
  if (positions.Components != 3 || positions.GetCount() > std::numeric_limits<int>::max())
  {
    attributes["POSITION"].Fail("is not a list of 3D points");
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(ToPoints(positions));
  Indices indices(positions.GetCount());
  std::iota(indices.begin(), indices.end(), 0u);
  if (const std::optional<std::size_t> accessor = primitive["indices"].GetIndex())
  {
    indices = ReadIndices(this->Document, *accessor);
  }
  const std::size_t mode = primitive["mode"].GetIndex(Triangles);
  if (mode > TriangleFan)
  {
    primitive["mode"].Fail("is unknown");
  }
  CellMaker maker(indices, data->GetNumberOfPoints());
  maker.Make(mode, data);
  if (maker.GetNumberOfBroken() > 0)
  {
    this->Errors.Add(primitive.GetPath() + " has " + std::to_string(maker.GetNumberOfBroken()) +
      " cell(s) with indices of missing vertices");
  }
  if (maker.GetNumberOfCells() == 0)
  {
    return nullptr;
  }

  const GLTFMaterial* material = nullptr;
  this->Errors.Attempt(
    [&]
    {
      if (const std::optional<std::size_t> index = primitive["material"].GetIndex())
      {
        material = &this->Materials.Get(*index);
        data->GetFieldData()->ShallowCopy(material->Arrays->GetFieldData());
      }
    });
  this->Errors.Attempt([&] { this->AddNormals(attributes, data); });
  this->Errors.Attempt([&] { this->AddColors(attributes, material, data); });
  if (material && material->HasTextures)
  {
    this->Errors.Attempt([&] { this->AddTexCoords(attributes, material->Mapping, data); });
  }
  return data;
}

void GLTFPrimitives::AddNormals(const GLTFValue& attributes, vtkPolyData* data)
{
  const GLTFValue attribute = attributes["NORMAL"];
  const std::optional<std::size_t> accessor = attribute.GetIndex();
  if (!accessor)
  {
    return;
  }
  const GLTFNumbers normals = ReadAttribute(
    this->Document, attribute, *accessor, data->GetNumberOfPoints(), GLTFIntegers::AsDeclared);
  if (normals.Components != 3)
  {
    attribute.Fail("is not a list of 3D directions");
  }
  const vtkSmartPointer<vtkFloatArray> array = MakeArray("Normals", 3, data->GetNumberOfPoints());
  for (std::size_t i = 0; i < normals.Values.size(); ++i)
  {
    array->SetValue(static_cast<vtkIdType>(i), static_cast<float>(normals.Values[i]));
  }
  data->GetPointData()->SetNormals(array);
}

/// glTF's v grows downwards from the image's upper edge.
void GLTFPrimitives::AddTexCoords(
  const GLTFValue& attributes, const GLTFTextureMapping& mapping, vtkPolyData* data)
{
  const std::string name = "TEXCOORD_" + std::to_string(mapping.Set);
  const GLTFValue attribute = attributes[name.c_str()];
  const std::optional<std::size_t> accessor = attribute.GetIndex();
  if (!accessor)
  {
    return;
  }
  const GLTFNumbers coordinates = ReadAttribute(
    this->Document, attribute, *accessor, data->GetNumberOfPoints(), GLTFIntegers::AsDeclared);
  if (coordinates.Components != 2)
  {
    attribute.Fail("is not a list of 2D points");
  }
  const double sine = std::sin(mapping.Rotation);
  const double cosine = std::cos(mapping.Rotation);
  const vtkSmartPointer<vtkFloatArray> array =
    MakeArray("TextureCoordinates", 2, data->GetNumberOfPoints());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    const double u = mapping.Scale[0] * coordinates.Values[2 * i];
    const double v = mapping.Scale[1] * coordinates.Values[2 * i + 1];
    array->SetTypedComponent(i, 0, static_cast<float>(mapping.Offset[0] + cosine * u + sine * v));
    array->SetTypedComponent(
      i, 1, static_cast<float>(1.0 - (mapping.Offset[1] - sine * u + cosine * v)));
  }
  data->GetPointData()->SetTCoords(array);
}

/// Linear colours times the linear factor of the material, as sRGB bytes, with alpha if the
/// material uses it.
void GLTFPrimitives::AddColors(
  const GLTFValue& attributes, const GLTFMaterial* material, vtkPolyData* data)
{
  const GLTFValue attribute = attributes["COLOR_0"];
  const std::optional<std::size_t> accessor = attribute.GetIndex();
  if (!accessor)
  {
    return;
  }
  const GLTFNumbers linear = ReadAttribute(
    this->Document, attribute, *accessor, data->GetNumberOfPoints(), GLTFIntegers::Normalized);
  if (linear.Components < 3)
  {
    attribute.Fail("is not a list of colours");
  }
  const bool useAlpha = material && material->UsesAlpha && linear.Components == 4;
  const int components = useAlpha ? 4 : 3;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Colors");
  colors->SetNumberOfComponents(components);
  colors->SetNumberOfTuples(data->GetNumberOfPoints());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      const double value = linear.Values[i * linear.Components + c];
      const double factor = material ? material->Color[c] : 1.0;
      colors->SetTypedComponent(i, c, ToByte(c < 3 ? LinearToSRGB(factor * value) : value));
    }
  }
  data->GetPointData()->SetScalars(colors);
}
}
