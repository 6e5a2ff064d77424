// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// The cube's geometry, the twin of Module/cslfCube.cxx. Faces: +X, -X, +Y, -Y, +Z, -Z; in-face axes
// as OpenGL's cube maps; cube space (CC) is [-1,1]^3.

struct SurfacePoint
{
  int Face;
  vec2 Coordinates; // (sc, tc) in [-1,1]
};

struct RayCoordinates
{
  bool Hits;
  SurfacePoint Entry; // (u,v)
  SurfacePoint Exit;  // (s,t)
};

int FaceAxis(int face)
{
  return face / 2;
}

float FaceSign(int face)
{
  return face % 2 == 0 ? 1.0 : -1.0;
}

int FaceOf(int axis, float sign)
{
  return 2 * axis + (sign < 0.0 ? 1 : 0);
}

vec3 FaceToCube(int face, vec2 coordinates)
{
  float sc = coordinates.x;
  float tc = coordinates.y;
  switch (face)
  {
    case 0:
      return vec3(1.0, -tc, -sc);
    case 1:
      return vec3(-1.0, -tc, sc);
    case 2:
      return vec3(sc, 1.0, tc);
    case 3:
      return vec3(sc, -1.0, -tc);
    case 4:
      return vec3(sc, -tc, 1.0);
    default:
      return vec3(-sc, -tc, -1.0);
  }
}

vec2 CubeToFace(int face, vec3 pointCC)
{
  switch (face)
  {
    case 0:
      return vec2(-pointCC.z, -pointCC.y);
    case 1:
      return vec2(pointCC.z, -pointCC.y);
    case 2:
      return vec2(pointCC.x, pointCC.z);
    case 3:
      return vec2(pointCC.x, -pointCC.z);
    case 4:
      return vec2(pointCC.x, -pointCC.y);
    default:
      return vec2(-pointCC.x, -pointCC.y);
  }
}

RayCoordinates RayToCoordinates(vec3 originCC, vec3 directionCC)
{
  RayCoordinates ray;
  float entryDistance = -1.0e30;
  float exitDistance = 1.0e30;
  int entryAxis = 0;
  int exitAxis = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    float direction = directionCC[axis];
    // A ray along a face's plane meets it far away, on the side that it is on.
    direction = abs(direction) < 1.0e-12 ? 1.0e-12 : direction;
    float sign = direction < 0.0 ? -1.0 : 1.0;
    float nearDistance = (-sign - originCC[axis]) / direction;
    float farDistance = (sign - originCC[axis]) / direction;
    if (nearDistance > entryDistance)
    {
      entryDistance = nearDistance;
      entryAxis = axis;
    }
    if (farDistance < exitDistance)
    {
      exitDistance = farDistance;
      exitAxis = axis;
    }
  }
  ray.Hits = entryDistance < exitDistance;
  vec3 entry = originCC + entryDistance * directionCC;
  vec3 exit = originCC + exitDistance * directionCC;
  ray.Entry.Face = FaceOf(entryAxis, -directionCC[entryAxis]);
  ray.Entry.Coordinates = clamp(CubeToFace(ray.Entry.Face, entry), -1.0, 1.0);
  ray.Exit.Face = FaceOf(exitAxis, directionCC[exitAxis]);
  ray.Exit.Coordinates = clamp(CubeToFace(ray.Exit.Face, exit), -1.0, 1.0);
  return ray;
}
