// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPixelBeams.h"

#include "RandomNumbers/cslfSampleStream.h"

#include <vtkMath.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace cslf
{
namespace
{
///@{
/// The cameras: their distance from the cube's centre in edges, their view angle in degrees, and
/// the width of their pictures in pixels.
constexpr double Distance = 2.0;
constexpr double ViewAngle = 40.0;
constexpr int PictureSize = 512;
///@}

/// Turns a spiral's next point by the golden angle, which spreads the points evenly.
const double GoldenAngle = vtkMath::Pi() * (3.0 - std::sqrt(5.0));

/// The random numbers of a camera, in [0,1).
class CameraNumbers
{
public:
  CameraNumbers(int seed, int camera)
    : Hash(MixBits(MixBits(CertificateSalt, static_cast<std::uint32_t>(seed)),
        static_cast<std::uint32_t>(camera)))
  {
  }

  double Next() { return static_cast<double>(MixBits(this->Hash, this->Index++) >> 11) * 0x1p-53; }

private:
  static constexpr std::uint64_t CertificateSalt = 0x4365727469666965u;
  std::uint64_t Hash;
  std::uint64_t Index = 0;
};

/// A camera's position and its picture, at twice the distance of the cube's centre.
struct Picture
{
  glm::dvec3 Eye;
  glm::dvec3 Corner; ///< from the eye to the first corner
  glm::dvec3 Right;  ///< a pixel's width
  glm::dvec3 Up;     ///< its height
};

Picture MakePicture(const Cube& box, const glm::dvec3& direction)
{
  const double distance = Distance * std::max({ box.Edges.x, box.Edges.y, box.Edges.z });
  const glm::dvec3 forward = -direction;
  const glm::dvec3 vertical =
    std::abs(direction.y) < 0.999 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, vertical));
  const double reach = 2.0 * distance;
  const double pixel = 2.0 * reach * std::tan(0.5 * glm::radians(ViewAngle)) / PictureSize;
  Picture picture;
  picture.Eye = box.Center + distance * direction;
  picture.Right = pixel * right;
  picture.Up = pixel * glm::cross(right, forward);
  picture.Corner = reach * forward - 0.5 * PictureSize * (picture.Right + picture.Up);
  return picture;
}

PixelBeam ChoosePixel(const Cube& box, const Picture& picture, CameraNumbers& numbers)
{
  const glm::dvec3 eyeCC = box.PointToCube(picture.Eye);
  // The pixel in the middle sees the centre of the cube, but flat cubes may cover little else.
  constexpr int mostTries = 10000;
  int x = PictureSize / 2;
  int y = PictureSize / 2;
  for (int attempt = 0; attempt < mostTries; ++attempt)
  {
    const int tryX = static_cast<int>(PictureSize * numbers.Next());
    const int tryY = static_cast<int>(PictureSize * numbers.Next());
    const glm::dvec3 center =
      picture.Corner + (tryX + 0.5) * picture.Right + (tryY + 0.5) * picture.Up;
    if (RayToCoordinates(eyeCC, box.VectorToCube(center)))
    {
      x = tryX;
      y = tryY;
      break;
    }
  }
  return { picture.Eye,
    picture.Corner + static_cast<double>(x) * picture.Right + static_cast<double>(y) * picture.Up,
    picture.Right, picture.Up };
}
}

std::vector<PixelBeam> MakePixelBeams(const Cube& box, int count, int seed)
{
  std::vector<PixelBeam> beams;
  const double firstAngle = 2.0 * vtkMath::Pi() * CameraNumbers(seed, count).Next();
  for (int camera = 0; camera < count; ++camera)
  {
    CameraNumbers numbers(seed, camera);
    const double cosine = 1.0 - 2.0 * (camera + numbers.Next()) / count;
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const double angle = firstAngle + camera * GoldenAngle;
    const glm::dvec3 direction(sine * std::cos(angle), sine * std::sin(angle), cosine);
    beams.push_back(ChoosePixel(box, MakePicture(box, direction), numbers));
  }
  return beams;
}

int FindSeenFaces(const Cube& box, const glm::dvec3& eye)
{
  const glm::dvec3 eyeCC = box.PointToCube(eye);
  int faces = 0;
  for (int face = 0; face < FaceCount; ++face)
  {
    faces |= FaceSign(face) * eyeCC[FaceAxis(face)] > 1.0 ? 1 << face : 0;
  }
  return faces;
}
}
