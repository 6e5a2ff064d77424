// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// The cube's geometry, as in cslfCube.cxx and cslfFaceSpace.cxx. Cube space (CC) is [-1,1]^3.
// Lookups work in the face space (FC) of the entry face that is being drawn: x and y are the
// face's (sc, tc), z is the depth below it, from 0 to 2.

uniform mat4 FCCCMatrix;

// Matrices that give the (s,t) of points of exit faces from FC with z - 1 in place of z: for the
// opposite face from (x,y), for those towards +x and -x from (y,z), and for those towards +y and -y
// from (x,z). On the negative side the signs differ. Each contains the (s,t) of both directions.
uniform vec4 OppositeAxes;
uniform vec4 SideXAxes;
uniform vec4 SideYAxes;
uniform vec2 SideXFlip;
uniform vec2 SideYFlip;

// A ray through the cube from the entry face, in FC.
struct Ray
{
  vec3 Entry;
  vec3 Chord; // from entry to exit
};

// The (s,t) of a point of an exit face.
vec2 ExitCoordinates(vec4 axes, vec2 point)
{
  return axes.xy * point.x + axes.zw * point.y;
}

// 1 over the distances from a point of the entry face to the sides at +1 and -1.
vec2 InverseToPositive(vec2 from)
{
  return 1.0 / max(1.0 - from, MinimumSideDistance);
}

vec2 InverseToNegative(vec2 from)
{
  return 1.0 / max(1.0 + from, MinimumSideDistance);
}

// The shares of the distances to the sides (x, y) and to the opposite face (z) that a direction
// covers. The ray leaves by the face with the largest share.
vec3 ShareOfWays(vec3 direction, vec2 inverseToPositive, vec2 inverseToNegative)
{
  return vec3(max(direction.xy * inverseToPositive, -direction.xy * inverseToNegative),
    0.5 * direction.z);
}

// The ray through a point, in a direction that enters the cube through the entry face.
Ray CastRay(vec3 point, vec3 direction)
{
  Ray ray;
  ray.Entry = vec3(clamp(point.xy - direction.xy * (point.z / direction.z), -1.0, 1.0), 0.0);
  vec3 share = ShareOfWays(
    direction, InverseToPositive(ray.Entry.xy), InverseToNegative(ray.Entry.xy));
  ray.Chord = direction / max(max(share.x, share.y), share.z);
  return ray;
}
