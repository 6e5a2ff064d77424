// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfBodyGroups.h"

#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfTriangleList.h"
#include "cslfJSON.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <Eigen/Eigenvalues>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace cslf
{
namespace
{
/// The largest coordinate of a prototype, and the largest one of a vector of colours.
constexpr double PointSteps = 32767.0;
constexpr double VectorSteps = 32768.0;

/// How far points may lie from where the arrays say, in cube coordinates.
constexpr double MaximumDistance = 1e-4;

/// The limits of a prototype's extent, and the most points and triangles of all bodies.
constexpr double MinimumExtent = 1e-30;
constexpr double MaximumExtent = 1e30;
constexpr double MaximumTotal = 1 << 25;

/// The most multiplications that colours may take.
constexpr std::size_t MaximumProducts = std::size_t(1) << 33;

constexpr int Columns = 4;
constexpr int PlacementNumbers = 3 * Columns;

/// The step of multiples: of colours that end at 255, and of coarser ones. Multiples are rounded up
/// only from this share of it: small ones cost more bytes than they are worth.
constexpr int FineStep = 4;
constexpr int CoarseStep = 1;
constexpr double DeadShare = 0.7;

/// Vectors whose multiples are smaller, as a root mean square in steps, are left out.
constexpr double MinimumDeviation = 0.3;

/// The most numbers of a body's colours: the time to find the vectors grows with their cube.
constexpr std::size_t MaximumNumbers = 1024;

bool IsOffset(int component)
{
  return component % Columns == Columns - 1;
}

glm::dvec3 GetPoint(const BodyGroup& group, std::size_t point)
{
  const std::int16_t* place = &group.Points[3 * point];
  return glm::dvec3(place[0], place[1], place[2]) * group.Extent / PointSteps;
}

glm::dvec3 Transform(const std::array<double, 12>& matrix, const glm::dvec3& point)
{
  glm::dvec3 place;
  for (int row = 0; row < 3; ++row)
  {
    const double* m = &matrix[Columns * row];
    place[row] = m[0] * point.x + m[1] * point.y + m[2] * point.z + m[3];
  }
  return place;
}

bool IsMirrored(const std::array<double, 12>& m)
{
  return glm::dot(glm::cross(glm::dvec3(m[0], m[4], m[8]), glm::dvec3(m[1], m[5], m[9])),
           glm::dvec3(m[2], m[6], m[10])) < 0.0;
}

void RequireBodies(bool condition)
{
  if (!condition)
  {
    throw std::invalid_argument("its bodies are damaged");
  }
}

/// Adds numbers as bytes: of all the low ones first, then the next ones.
template <typename Number>
void AddPlanes(const std::vector<Number>& numbers, std::vector<unsigned char>& bytes)
{
  for (std::size_t byte = 0; byte < sizeof(Number); ++byte)
  {
    for (const Number number : numbers)
    {
      bytes.push_back(static_cast<unsigned char>(number >> (8 * byte)));
    }
  }
}

template <typename Number>
void TakePlanes(const unsigned char*& bytes, std::vector<Number>& numbers)
{
  std::vector<std::uint32_t> sums(numbers.size(), 0);
  for (std::size_t byte = 0; byte < sizeof(Number); ++byte)
  {
    for (std::uint32_t& sum : sums)
    {
      sum |= std::uint32_t(*bytes++) << (8 * byte);
    }
  }
  std::transform(sums.begin(), sums.end(), numbers.begin(),
    [](std::uint32_t sum) { return static_cast<Number>(sum); });
}

/// Small numbers of both signs as small ones without sign: 0, -1, 1, -2 and so on.
std::uint16_t Fold(std::int16_t number)
{
  return static_cast<std::uint16_t>(number < 0 ? -2 * number - 1 : 2 * number);
}

std::int16_t Unfold(std::uint16_t number)
{
  return static_cast<std::int16_t>(number % 2 == 0 ? number / 2 : -(number / 2) - 1);
}

/// Visits the sequences of numbers that are packed alike, folded, some as differences.
template <typename Group, typename Visit>
void VisitSequences(Group& group, Visit visit)
{
  for (int i = 0; i < PlacementNumbers; ++i)
  {
    visit(
      [&group, i ](std::size_t body) -> auto& { return group.Placements[body][i]; }, true);
  }
  for (auto& multiples : group.Multiples)
  {
    visit(
      [&multiples](std::size_t body) -> auto& { return multiples[body]; }, false);
  }
}

/// The colours of each body, one after another: of all points the front, then the back.
std::vector<double> ListColors(
  const BodyGroup& group, std::size_t firstPoint, int sides, const PointCodes& codes)
{
  std::vector<double> values;
  for (std::size_t body = 0; body < group.GetBodies(); ++body)
  {
    for (int side = 0; side < sides; ++side)
    {
      const auto& colors = side == 0 ? codes.Colors : codes.BackColors;
      for (std::size_t point = 0; point < group.GetPoints(); ++point)
      {
        const unsigned char* color = &colors[4 * (firstPoint + body * group.GetPoints() + point)];
        values.insert(values.end(), color, color + 3);
      }
    }
  }
  return values;
}

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

template <typename Vector>
std::vector<std::int16_t> ToSteps(const Vector& numbers)
{
  std::vector<std::int16_t> steps;
  for (Eigen::Index i = 0; i < numbers.size(); ++i)
  {
    steps.push_back(static_cast<std::int16_t>(
      std::clamp(std::round(numbers[i] * VectorSteps), -PointSteps, PointSteps)));
  }
  return steps;
}

/// Finds the principal components of the colours of all bodies, the largest first.
void FitColors(const std::vector<double>& colors, int step, BodyGroup& group)
{
  const auto bodies = static_cast<Eigen::Index>(group.GetBodies());
  const auto size = static_cast<Eigen::Index>(colors.size()) / bodies;
  Matrix rests = Eigen::Map<const Matrix>(colors.data(), bodies, size);
  const Eigen::RowVectorXd mean = rests.colwise().mean();
  rests.rowwise() -= mean;
  for (Eigen::Index i = 0; i < size; ++i)
  {
    group.Mean.push_back(static_cast<std::int32_t>(std::lround(mean[i] * VectorSteps)));
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> components(
    rests.transpose() * rests / static_cast<double>(bodies));
  for (Eigen::Index k = size; k-- > 0;)
  {
    if (!(components.eigenvalues()[k] > std::pow(MinimumDeviation * step, 2.0)))
    {
      break;
    }
    const Eigen::VectorXd component = components.eigenvectors().col(k);
    group.Vectors.push_back(ToSteps(component));
    const Eigen::VectorXd all = rests * component / step;
    std::vector<std::int16_t>& multiples = group.Multiples.emplace_back();
    for (Eigen::Index body = 0; body < bodies; ++body)
    {
      const double whole = std::floor(std::abs(all[body]) + 1.0 - DeadShare);
      multiples.push_back(static_cast<std::int16_t>(std::copysign(whole, all[body])));
    }
  }
}
}

double BodyGroups::GetOffsetSteps() const
{
  return (1 << (this->PositionBits - 1)) - 1;
}

// A step moves no point by more than one of offsets.
double BodyGroups::GetLinearStep(const BodyGroup& group) const
{
  return 1.0 / ((1 << (this->PositionBits - 1)) * group.Extent);
}

std::array<double, 12> BodyGroups::GetMatrix(const BodyGroup& group, std::size_t body) const
{
  std::array<double, 12> matrix;
  for (int i = 0; i < PlacementNumbers; ++i)
  {
    const std::int16_t number = group.Placements[body][i];
    matrix[i] = IsOffset(i) ? number / this->GetOffsetSteps() : number * this->GetLinearStep(group);
  }
  return matrix;
}

BodyGroups BodyGroups::Take(vtkPolyData* geometry, vtkPolyData* triangles, const Cube& box,
  int positionBits, int maximum, PointCodes& codes)
{
  const auto allPoints = static_cast<std::size_t>(triangles->GetNumberOfPoints());
  const auto allTriangles = static_cast<std::size_t>(triangles->GetNumberOfPolys());
  const std::vector<BodyGroupData> all = ListBodyGroups(geometry, allPoints, allTriangles);
  if (all.empty() || static_cast<double>(allPoints + allTriangles) > MaximumTotal)
  {
    return {};
  }
  auto point = static_cast<vtkIdType>(all.front().FirstPoint);
  auto triangle = static_cast<vtkIdType>(all.front().FirstTriangle);
  const std::vector<unsigned int> corners = ListCorners(triangles);
  if (std::any_of(corners.begin(), corners.begin() + 3 * triangle,
        [point](unsigned int corner) { return corner >= point; }))
  {
    return {};
  }
  BodyGroups result;
  result.PositionBits = positionBits;
  for (const BodyGroupData& listed : all)
  {
    const auto points = static_cast<vtkIdType>(listed.Prototype.size());
    const auto groupTriangles = static_cast<vtkIdType>(listed.Triangles);
    BodyGroup group;
    group.AreBalls = listed.AreBalls;
    const std::vector<glm::dvec3>& places = listed.Prototype;
    for (const glm::dvec3& place : places)
    {
      group.Extent =
        std::max({ group.Extent, std::abs(place.x), std::abs(place.y), std::abs(place.z) });
    }
    if (!(group.Extent >= MinimumExtent && group.Extent <= MaximumExtent))
    {
      return {};
    }
    std::vector<std::array<double, 12>> matrices = listed.Matrices;
    for (std::array<double, 12>& matrix : matrices)
    {
      const bool isMirrored = IsMirrored(matrix);
      for (vtkIdType i = 0; i < points; ++i, ++point)
      {
        double found[3];
        triangles->GetPoint(point, found);
        const glm::dvec3 place = box.PointToCube(Transform(matrix, places[i]));
        const glm::dvec3 away = glm::clamp(place, glm::dvec3(-1.0), glm::dvec3(1.0)) -
          box.PointToCube({ found[0], found[1], found[2] });
        if (!(glm::length(away) <= MaximumDistance))
        {
          return {};
        }
      }
      const unsigned int first = static_cast<unsigned int>(point - points);
      for (vtkIdType corner = 0; corner < 3 * groupTriangles; ++corner)
      {
        // Mirrored bodies have their last two corners exchanged.
        const vtkIdType from =
          corner % 3 == 0 || !isMirrored ? corner : corner + (corner % 3 == 1 ? 1 : -1);
        const unsigned int number = corners[3 * triangle + from] - first;
        if (&matrix == &matrices.front())
        {
          group.Corners.push_back(number);
        }
        if (number >= points || number != group.Corners[corner])
        {
          return {};
        }
      }
      triangle += groupTriangles;
      // From world to cube coordinates.
      for (int row = 0; row < 3; ++row)
      {
        for (int column = 0; column < Columns; ++column)
        {
          double& number = matrix[Columns * row + column];
          number = 2.0 * (number - (column == 3 ? box.Center[row] : 0.0)) / box.Edges[row];
        }
      }
    }
    for (const glm::dvec3& place : places)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        group.Points.push_back(
          static_cast<std::int16_t>(std::lround(place[axis] / group.Extent * PointSteps)));
      }
    }
    for (const std::array<double, 12>& matrix : matrices)
    {
      std::array<std::int16_t, 12>& numbers = group.Placements.emplace_back();
      for (int i = 0; i < PlacementNumbers; ++i)
      {
        const double number = std::round(IsOffset(i) ? matrix[i] * result.GetOffsetSteps()
                                                     : matrix[i] / result.GetLinearStep(group));
        if (!(std::abs(number) <= PointSteps))
        {
          return {};
        }
        numbers[i] = static_cast<std::int16_t>(number);
      }
      if (IsMirrored(matrix) != IsMirrored(result.GetMatrix(group, group.GetBodies() - 1)))
      {
        return {};
      }
    }
    result.Groups.push_back(std::move(group));
  }
  return result.Fit(maximum, codes) ? result : BodyGroups();
}

// The bodies' colours and flags, which are the last codes. False if they cannot be stored.
bool BodyGroups::Fit(int maximum, const PointCodes& codes)
{
  const std::size_t points = this->CountPoints();
  const std::size_t end = codes.Colors.size() / 4;
  const std::size_t first = end - std::min(points, end);
  const auto isSame =
    [](const std::vector<unsigned char>& a, const std::vector<unsigned char>& b, std::size_t begin)
  { return std::equal(a.begin() + 4 * begin, a.end(), b.begin() + 4 * begin); };
  this->Sides = codes.Colors.empty()                                            ? 0
    : codes.BackColors.empty() || isSame(codes.Colors, codes.BackColors, first) ? 1
                                                                                : 2;
  this->Step = maximum == 255 ? FineStep : CoarseStep;
  this->HasFlags = !codes.Flags.empty();
  std::size_t point = first;
  for (BodyGroup& group : this->Groups)
  {
    if (this->Sides > 0)
    {
      if (3 * group.GetPoints() * this->Sides > MaximumNumbers)
      {
        return false;
      }
      FitColors(ListColors(group, point, this->Sides, codes), this->Step, group);
    }
    for (int side = 0; this->HasFlags && side < 2; ++side)
    {
      for (std::size_t i = 0; i < group.GetPoints() * group.GetBodies(); ++i)
      {
        group.Flags.push_back(codes.Flags[4 * (point + i) + side]);
      }
    }
    point += group.GetPoints() * group.GetBodies();
  }
  return true;
}

std::size_t BodyGroups::CountPoints() const
{
  return std::accumulate(this->Groups.begin(), this->Groups.end(), std::size_t(0),
    [](std::size_t sum, const BodyGroup& group)
    { return sum + group.GetPoints() * group.GetBodies(); });
}

std::size_t BodyGroups::CountTriangles() const
{
  return std::accumulate(this->Groups.begin(), this->Groups.end(), std::size_t(0),
    [](std::size_t sum, const BodyGroup& group)
    { return sum + group.GetTriangles() * group.GetBodies(); });
}

nlohmann::json BodyGroups::Describe() const
{
  nlohmann::json groups = nlohmann::json::array();
  for (const BodyGroup& group : this->Groups)
  {
    groups.push_back({ { "points", group.GetPoints() }, { "triangles", group.GetTriangles() },
      { "bodies", group.GetBodies() }, { "extent", group.Extent },
      { "vectors", group.Vectors.size() }, { "balls", group.AreBalls } });
  }
  return { { "groups", groups }, { "sides", this->Sides }, { "step", this->Step },
    { "has_exact", this->HasFlags } };
}

BodyGroups BodyGroups::Read(
  const nlohmann::json& header, int positionBits, std::size_t mostPoints, std::size_t mostBytes)
{
  const auto getCount = [](const nlohmann::json& entry, const char* key, std::size_t most)
  {
    const nlohmann::json& number = entry.at(key);
    RequireBodies(number.is_number_unsigned() && number.get<std::uint64_t>() <= most);
    return number.get<std::size_t>();
  };
  BodyGroups result;
  result.PositionBits = positionBits;
  result.Sides = static_cast<int>(getCount(header, "sides", 2));
  result.Step = static_cast<int>(getCount(header, "step", 255));
  result.HasFlags = header.at("has_exact").get<bool>();
  RequireBodies(header.at("groups").is_array() && !header.at("groups").empty());
  std::size_t all = 0;
  std::size_t bytes = 0;
  for (const nlohmann::json& entry : header.at("groups"))
  {
    const std::size_t points = getCount(entry, "points", mostPoints);
    const std::size_t triangles = getCount(entry, "triangles", mostPoints);
    const std::size_t bodies = getCount(entry, "bodies", mostPoints);
    const std::size_t numbers = 3 * points * result.Sides;
    // No product can overflow: the limit is 2^25, and numbers have 64 bits.
    all += (points + triangles) * bodies;
    RequireBodies(points > 0 && triangles > 0 && bodies > 0 && all <= mostPoints);
    const std::size_t vectors = getCount(entry, "vectors", std::min(numbers, MaximumNumbers));
    RequireBodies(numbers <= MaximumNumbers);
    const std::size_t flags = result.HasFlags ? 2 * points * bodies : 0;
    bytes += 4 * (3 * triangles + numbers) + 2 * (3 * points + vectors * numbers) +
      2 * bodies * (PlacementNumbers + vectors) + flags;
    RequireBodies(bytes <= mostBytes && vectors * numbers * bodies <= MaximumProducts);
    BodyGroup& group = result.Groups.emplace_back();
    group.Corners.resize(3 * triangles);
    group.Points.resize(3 * points);
    group.Placements.resize(bodies);
    group.Mean.resize(numbers);
    group.Vectors.assign(vectors, std::vector<std::int16_t>(numbers));
    group.Multiples.assign(vectors, std::vector<std::int16_t>(bodies));
    group.Flags.resize(flags);
    group.AreBalls = entry.value("balls", false);
    group.Extent = entry.at("extent").get<double>();
    RequireBodies(group.Extent >= MinimumExtent && group.Extent <= MaximumExtent);
  }
  return result;
}

std::vector<unsigned char> BodyGroups::Pack() const
{
  std::vector<unsigned char> bytes;
  for (const BodyGroup& group : this->Groups)
  {
    AddPlanes(group.Corners, bytes);
    AddPlanes(group.Points, bytes);
    AddPlanes(group.Mean, bytes);
    for (const std::vector<std::int16_t>& vector : group.Vectors)
    {
      AddPlanes(vector, bytes);
    }
    VisitSequences(group,
      [&](auto numberOf, bool areDifferences)
      {
        std::vector<std::uint16_t> numbers;
        std::int16_t before = 0;
        for (std::size_t body = 0; body < group.GetBodies(); ++body)
        {
          const std::int16_t number = numberOf(body);
          numbers.push_back(Fold(static_cast<std::int16_t>(number - before)));
          before = areDifferences ? number : std::int16_t(0);
        }
        AddPlanes(numbers, bytes);
      });
    AddPlanes(group.Flags, bytes);
  }
  return bytes;
}

std::size_t BodyGroups::GetSize() const
{
  std::size_t size = 0;
  for (const BodyGroup& group : this->Groups)
  {
    size += 4 * (group.Corners.size() + group.Mean.size()) +
      2 * (group.Points.size() + group.Vectors.size() * group.Mean.size()) +
      2 * group.GetBodies() * (PlacementNumbers + group.Multiples.size()) + group.Flags.size();
  }
  return size;
}

void BodyGroups::Unpack(const unsigned char* bytes)
{
  for (BodyGroup& group : this->Groups)
  {
    TakePlanes(bytes, group.Corners);
    RequireBodies(std::all_of(group.Corners.begin(), group.Corners.end(),
      [&group](std::uint32_t corner) { return corner < group.GetPoints(); }));
    TakePlanes(bytes, group.Points);
    TakePlanes(bytes, group.Mean);
    for (std::vector<std::int16_t>& vector : group.Vectors)
    {
      TakePlanes(bytes, vector);
    }
    std::vector<std::uint16_t> numbers(group.GetBodies());
    VisitSequences(group,
      [&](auto numberOf, bool areDifferences)
      {
        TakePlanes(bytes, numbers);
        std::int16_t before = 0;
        for (std::size_t body = 0; body < numbers.size(); ++body)
        {
          numberOf(body) = static_cast<std::int16_t>(before + Unfold(numbers[body]));
          before = areDifferences ? numberOf(body) : std::int16_t(0);
        }
      });
    TakePlanes(bytes, group.Flags);
  }
}

void BodyGroups::AddCodes(int maximum, bool hasBack, PointCodes& codes) const
{
  for (const BodyGroup& group : this->Groups)
  {
    const std::size_t points = group.GetPoints();
    std::vector<std::int64_t> sums(group.Mean.size());
    for (std::size_t body = 0; body < group.GetBodies(); ++body)
    {
      std::fill(sums.begin(), sums.end(), std::int64_t(0));
      for (std::size_t k = 0; k < group.Vectors.size(); ++k)
      {
        const std::int64_t multiple = group.Multiples[k][body];
        for (std::size_t i = 0; multiple != 0 && i < sums.size(); ++i)
        {
          sums[i] += multiple * group.Vectors[k][i];
        }
      }
      for (int side = 0; side < (this->Sides == 0 ? 0 : hasBack ? 2 : 1); ++side)
      {
        const std::size_t first = side < this->Sides ? side * 3 * points : 0;
        std::vector<unsigned char>& colors = side == 0 ? codes.Colors : codes.BackColors;
        for (std::size_t i = 0; i < 3 * points; ++i)
        {
          constexpr auto one = static_cast<std::int64_t>(VectorSteps);
          const std::int64_t sum = group.Mean[first + i] + this->Step * sums[first + i] + one / 2;
          const std::int64_t code = sum < 0 ? 0 : sum / one;
          colors.push_back(static_cast<unsigned char>(std::min<std::int64_t>(code, maximum)));
          if (i % 3 == 2)
          {
            colors.push_back(static_cast<unsigned char>(maximum));
          }
        }
      }
    }
    const std::size_t flags = group.Flags.size() / 2;
    for (std::size_t i = 0; i < flags; ++i)
    {
      codes.Flags.insert(codes.Flags.end(), { group.Flags[i], group.Flags[flags + i], 0, 0 });
    }
  }
}

void BodyGroups::Append(const Cube& box, vtkPolyData* geometry) const
{
  if (this->IsEmpty())
  {
    return;
  }
  vtkPoints* points = geometry->GetPoints();
  vtkCellArray* triangles = geometry->GetPolys();
  vtkNew<vtkIdTypeArray> sizes;
  sizes->SetName(GeometryGroupsName);
  sizes->SetNumberOfComponents(4);
  vtkNew<vtkDoubleArray> prototypes;
  prototypes->SetName(GeometryPrototypesName);
  prototypes->SetNumberOfComponents(3);
  vtkNew<vtkDoubleArray> placements;
  placements->SetName(GeometryPlacementsName);
  placements->SetNumberOfComponents(12);
  for (const BodyGroup& group : this->Groups)
  {
    sizes->InsertNextTuple4(static_cast<double>(group.GetPoints()),
      static_cast<double>(group.GetTriangles()), static_cast<double>(group.GetBodies()),
      group.AreBalls ? 1.0 : 0.0);
    for (std::size_t point = 0; point < group.GetPoints(); ++point)
    {
      const glm::dvec3 place = GetPoint(group, point);
      prototypes->InsertNextTuple3(place.x, place.y, place.z);
    }
    for (std::size_t body = 0; body < group.GetBodies(); ++body)
    {
      std::array<double, 12> matrix = this->GetMatrix(group, body);
      const vtkIdType first = points->GetNumberOfPoints();
      for (std::size_t point = 0; point < group.GetPoints(); ++point)
      {
        const glm::dvec3 place = box.PointToWorld(
          glm::clamp(Transform(matrix, GetPoint(group, point)), glm::dvec3(-1.0), glm::dvec3(1.0)));
        points->InsertNextPoint(place.x, place.y, place.z);
      }
      const bool isMirrored = IsMirrored(matrix);
      for (std::size_t corner = 0; corner < group.Corners.size(); corner += 3)
      {
        const vtkIdType a = first + group.Corners[corner];
        const vtkIdType b = first + group.Corners[corner + 1];
        const vtkIdType c = first + group.Corners[corner + 2];
        triangles->InsertNextCell({ a, isMirrored ? c : b, isMirrored ? b : c });
      }
      for (int row = 0; row < 3; ++row)
      {
        for (int column = 0; column < Columns; ++column)
        {
          double& number = matrix[Columns * row + column];
          number = 0.5 * number * box.Edges[row] + (column == 3 ? box.Center[row] : 0.0);
        }
      }
      placements->InsertNextTuple(matrix.data());
    }
  }
  for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{ sizes, prototypes, placements })
  {
    geometry->GetFieldData()->AddArray(array);
  }
}
}
