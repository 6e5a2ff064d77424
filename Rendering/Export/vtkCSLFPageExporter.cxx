// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFPageExporter.h"

#include "Coding/Containers/cslfFileParts.h"
#include "Coding/Geometry/cslfGeometryCodec.h"
#include "Options/cslfOptionTable.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "SceneLook/cslfNamedColorMaps.h"
#include "cslfColor.h"
#include "cslfJSON.h"
#include "cslfPage.h"
#include "cslfPageViewer.h"
#include "cslfShownField.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkImageResize.h>
#include <vtkJPEGWriter.h>
#include <vtkLookupTable.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
using JSON = nlohmann::json;

/// The height of the poster in pixels, and its quality in percent.
constexpr int PosterHeight = 480;
constexpr int PosterQuality = 75;

std::string Deflate(const std::string& bytes)
{
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string deflated(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(deflated.data()), &size,
        reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()),
        Z_BEST_COMPRESSION) != Z_OK)
  {
    throw std::bad_alloc();
  }
  deflated.resize(size);
  return deflated;
}

std::string EncodeBase64(const std::string& bytes)
{
  return cslf::ToBase64(bytes.data(), bytes.size());
}

std::string EscapeHTML(const std::string& text)
{
  std::string escaped;
  for (const char c : text)
  {
    const char* entity = c == '&' ? "&amp;"
      : c == '<'                  ? "&lt;"
      : c == '>'                  ? "&gt;"
      : c == '"'                  ? "&quot;"
                                  : nullptr;
    entity ? escaped.append(entity) : escaped.append(1, c);
  }
  return escaped;
}

/// #rrggbb
std::string WriteColor(const double color[3])
{
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", cslf::ToByte(color[0]),
    cslf::ToByte(color[1]), cslf::ToByte(color[2]));
  return text.data();
}

/// As setBackground of the viewer has it.
bool IsLight(const double color[3])
{
  return 0.3 * color[0] + 0.6 * color[1] + 0.1 * color[2] > 0.5;
}

/// Steps and colours; each but the first three numbers is the difference to the colour before.
JSON DescribeColors(const cslf::ColorMap& map)
{
  std::vector<cslf::ColorMap::Pixel> colors = map.Colors;
  colors.push_back(map.NanColor);
  JSON steps = JSON::array();
  for (std::size_t i = 0; i < colors.size(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      steps.push_back(i == 0 ? int(colors[i][c]) : colors[i][c] - colors[i - 1][c]);
    }
  }
  return { { "steps", map.GetSteps() }, { "colors", steps } };
}

JSON DescribeMaps(const cslf::ShownMaps& maps)
{
  JSON all = JSON::array();
  for (std::size_t i = 0; i < maps.GetMaps().size(); ++i)
  {
    const cslf::ColorMap& map = maps.GetMaps()[i];
    const cslf::ShownArray& shown = maps.GetArrays()[i];
    if (map.IsImage())
    {
      all.push_back({ { "image", true } });
      continue;
    }
    JSON one = DescribeColors(map);
    one["range"] = { map.Range[0], map.Range[1] };
    one["logarithmic"] = map.IsLogarithmic;
    if (map.HasScalars())
    {
      one["array"] = map.Array;
      one["component"] = map.Component;
    }
    if (shown.Number >= 0)
    {
      one["source"] = { { "array", shown.Number }, { "component", shown.Component } };
    }
    all.push_back(one);
  }
  return all;
}

/// The maps that users may choose.
JSON DescribePresets()
{
  JSON presets = JSON::object();
  const auto& names = cslf::options::ColorMap.Names;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    if (static_cast<int>(i) != cslf::options::ColorMap.Default)
    {
      vtkNew<vtkLookupTable> table;
      cslf::SetUpLookupTable(static_cast<int>(i), table);
      presets[names[i]] = DescribeColors(cslf::MakeColorMap(table));
    }
  }
  return presets;
}

/// Whether the maps are those that the geometry has.
bool AreOwn(const cslf::ShownMaps& maps, const std::vector<cslf::ColorMap>& own)
{
  const auto& shown = maps.GetMaps();
  return std::equal(shown.begin(), shown.end(), own.begin(), own.end(),
           [](const cslf::ColorMap& a, const cslf::ColorMap& b)
           {
             return a.Colors == b.Colors && a.NanColor == b.NanColor && a.Range[0] == b.Range[0] &&
               a.Range[1] == b.Range[1] && a.IsLogarithmic == b.IsLogarithmic;
           }) &&
    std::all_of(maps.GetArrays().begin(), maps.GetArrays().end(),
      [](const cslf::ShownArray& array) { return array.Number < 0; });
}

/// One in perspective, at such a distance that the focal point has the same scale.
JSON DescribeCamera(vtkCamera* camera)
{
  const auto list = [](const double* vector) { return JSON{ vector[0], vector[1], vector[2] }; };
  std::array<double, 3> position{};
  camera->GetPosition(position.data());
  if (camera->GetParallelProjection())
  {
    const double distance = camera->GetParallelScale() /
      std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle()));
    for (int axis = 0; axis < 3; ++axis)
    {
      position[axis] =
        camera->GetFocalPoint()[axis] - distance * camera->GetDirectionOfProjection()[axis];
    }
  }
  return { { "position", list(position.data()) }, { "focalPoint", list(camera->GetFocalPoint()) },
    { "viewUp", list(camera->GetViewUp()) }, { "viewAngle", camera->GetViewAngle() } };
}

JSON DescribePage(const cslf::ShownField& field, const std::string& title)
{
  const cslf::Cube& box = field.Shown.Field.Box;
  JSON page = { { "title", title }, { "background", WriteColor(field.Renderer->GetBackground()) },
    { "camera", DescribeCamera(field.Renderer->GetActiveCamera()) },
    { "center", { box.Center.x, box.Center.y, box.Center.z } },
    { "edges", { box.Edges.x, box.Edges.y, box.Edges.z } }, { "notes", field.Omissions } };
  vtkNew<vtkMatrix4x4> columns;
  vtkMatrix4x4::Transpose(field.Actor->GetMatrix(), columns);
  page["matrix"] = std::vector<double>(columns->GetData(), columns->GetData() + 16);
  if (field.Shown.Maps)
  {
    page["presets"] = DescribePresets();
    if (!AreOwn(*field.Shown.Maps, field.Shown.Mesh->Mapped.Maps))
    {
      page["maps"] = DescribeMaps(*field.Shown.Maps);
    }
  }
  return page;
}

/// Linear colours become sRGB-encoded ones of 8 bits, with their brightness above 1.
void EncodeColors(const cslf::PointColorArrays& from, vtkPolyData* to)
{
  const vtkIdType count = from.Front->GetNumberOfTuples();
  vtkNew<vtkUnsignedCharArray> exact;
  exact->SetName(cslf::ExactColorName);
  exact->SetNumberOfComponents(2);
  exact->SetNumberOfTuples(count);
  for (const int side : { 0, 1 })
  {
    vtkDataArray* array = side == 1 && from.Back ? from.Back : from.Front;
    vtkNew<vtkUnsignedCharArray> codes;
    codes->SetName(array->GetName());
    codes->SetNumberOfComponents(4);
    codes->SetNumberOfTuples(count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      double light[4];
      array->GetTuple(i, light);
      const double alpha = std::max(light[3], 1e-6);
      const double brightness = std::max({ light[0], light[1], light[2], alpha }) / alpha;
      const unsigned char code = cslf::ToExactCode(brightness);
      const double factor = std::exp2((code - 1.0) / 8.0);
      for (int c = 0; c < 3; ++c)
      {
        codes->SetTypedComponent(
          i, c, cslf::ToByte(cslf::LinearToSRGB(std::min(light[c] / alpha / factor, 1.0))));
      }
      codes->SetTypedComponent(i, 3, 255);
      exact->SetTypedComponent(i, side, code);
    }
    to->GetPointData()->AddArray(codes);
  }
  to->GetPointData()->AddArray(exact);
}

std::string EncodeSurfaces(const cslf::ShownGeometry& shown)
{
  vtkNew<vtkPolyData> geometry;
  geometry->ShallowCopy(shown.Geometry);
  const cslf::PointColorArrays colors = cslf::FindPointColors(shown.Geometry);
  if (colors.Front && colors.Front->GetDataType() != VTK_UNSIGNED_CHAR)
  {
    EncodeColors(colors, geometry);
  }
  std::string error;
  const std::vector<unsigned char> bytes =
    cslf::EncodeGeometry(geometry, shown.Field.Box, shown.Field.Grid.GetResolution(), error);
  if (bytes.empty())
  {
    throw std::runtime_error(error);
  }
  return { bytes.begin(), bytes.end() };
}

/// The size of the text, as 32-bit little-endian integer, the deflated text, and the geometry.
std::string JoinData(const std::string& text, const std::string& geometry)
{
  const std::string deflated = Deflate(text);
  std::string data;
  for (unsigned int shift = 0; shift < 32; shift += 8)
  {
    data.push_back(static_cast<char>(deflated.size() >> shift & 255U));
  }
  return data + deflated + geometry;
}

/// The window's picture as an address, or nothing if it cannot be drawn.
std::string DrawPoster(vtkRenderWindow* window)
{
  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(window);
  grabber->ReadFrontBufferOff();
  grabber->Update();
  int size[3];
  grabber->GetOutput()->GetDimensions(size);
  if (size[0] < 1 || size[1] < 1)
  {
    return "";
  }
  vtkNew<vtkImageResize> resize;
  resize->SetInputConnection(grabber->GetOutputPort());
  const double factor = std::min(1.0, double(PosterHeight) / size[1]);
  resize->SetOutputDimensions(std::max(1, int(std::lround(factor * size[0]))),
    std::max(1, int(std::lround(factor * size[1]))), 1);
  vtkNew<vtkJPEGWriter> writer;
  writer->SetInputConnection(resize->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->SetQuality(PosterQuality);
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  return bytes ? "data:image/jpeg;base64," +
      EncodeBase64({ reinterpret_cast<const char*>(bytes->GetPointer(0)),
        static_cast<std::size_t>(bytes->GetNumberOfValues()) })
               : "";
}

/// The page's template, cut where the names of values are in double braces, which are replaced.
std::vector<std::string> FillIn(
  const std::string& page, const std::vector<std::pair<std::string, std::string>>& values)
{
  std::vector<std::string> parts;
  std::size_t place = 0;
  for (std::size_t brace = page.find("{{"); brace != std::string::npos;
       brace = page.find("{{", place))
  {
    const std::size_t end = page.find("}}", brace);
    const std::string name = page.substr(brace + 2, end - brace - 2);
    const auto value = std::find_if(
      values.begin(), values.end(), [&](const auto& each) { return each.first == name; });
    parts.push_back(page.substr(place, brace - place));
    parts.push_back(value->second);
    place = end + 2;
  }
  parts.push_back(page.substr(place));
  return parts;
}
}

vtkStandardNewMacro(vtkCSLFPageExporter);

vtkCSLFPageExporter::vtkCSLFPageExporter() = default;

vtkCSLFPageExporter::~vtkCSLFPageExporter()
{
  this->SetFileName(nullptr);
  this->SetTitle(nullptr);
}

void vtkCSLFPageExporter::WriteData()
{
  cslf::ExportField(this, this->FileName, this->Title,
    [this](const cslf::ShownField& field, const std::string& title)
    {
      const std::string data =
        JoinData(DescribePage(field, title).dump(-1, ' ', false, JSON::error_handler_t::replace),
          EncodeSurfaces(field.Shown));
      return FillIn(cslfPage,
        { { "title", EscapeHTML(title) },
          { "background", WriteColor(field.Renderer->GetBackground()) },
          { "theme", IsLight(field.Renderer->GetBackground()) ? "light" : "dark" },
          { "poster", this->Poster ? DrawPoster(this->RenderWindow) : "" },
          { "data", EncodeBase64(data) }, { "viewer", EncodeBase64(Deflate(cslfPageViewer)) } });
    });
}

void vtkCSLFPageExporter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Title: " << (this->Title ? this->Title : "(none)") << "\n";
  os << indent << "Poster: " << (this->Poster ? "on" : "off") << "\n";
}
