// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Draws the surfaces of a geometry with WebGL 2, in linear light, as Rendering/Shaders do. Balls
// are spheres with octahedral maps: Rendering/cslfBalls.cxx. Their coordinates (BC) are cube
// coordinates (CC) times half of the cube's edges.

import { indexOf, listPlaces } from "./colors.js";

/** @typedef {import("./geometry.js").Batch} Batch */
/** @typedef {import("./geometry.js").Geometry} Geometry */
/** @typedef {import("./geometry.js").ColorMap} ColorMap */

const RowBits = 12; // a row of images has 4096 texels, which all devices allow

// Rendering/Shaders/cslfEncoding.glsl.
export const Encoding = `@cslfEncoding@`;

// Groups of fewer bodies, or larger meshes, are drawn as triangles.
const MinimumBalls = 32;
const MaximumPrototype = 1024;
const TexelsPerPoint = 1.5;

const Head = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp isampler2D;
precision highp usampler2D;
const int RowBits = ${RowBits};
ivec2 TexelOf(int index)
{
  return ivec2(index & ((1 << RowBits) - 1), index >> RowBits);
}
${Encoding}
`;

const MeshVertices = `${Head}
in vec3 place;
in vec4 rowX, rowY, rowZ; // of the body's matrix to CC
uniform mat4 toDisplay;
uniform int firstBody, points;
uniform vec2 light; // the largest, and its code; 0 without maps
uniform usampler2D colors;
uniform sampler2D places; // listPlaces
uniform isampler2D mapRanges; // of each map, its first colour, their number, and what an image has
out vec3 color; // sRGB-encoded, or light, encoded so
out vec2 mapPlace;
flat out ivec4 map; // as in mapRanges; negative without one

void main()
{
  vec4 point = vec4(place, 1.0);
  vec3 pointCC = clamp(vec3(dot(rowX, point), dot(rowY, point), dot(rowZ, point)), -1.0, 1.0);
  gl_Position = toDisplay * vec4(pointCC, 1.0);
  ivec2 texel = TexelOf((firstBody + gl_InstanceID) * points + gl_VertexID);
  uvec4 codes = texelFetch(colors, texel, 0);
  color = vec3(codes.rgb) / 255.0;
  map = ivec4(-1);
  mapPlace = vec2(0.0);
  if (light.y > 0.0)
  {
    vec3 found = texelFetch(places, texel, 0).rgb;
    mapPlace = found.rg;
    if (found.b >= 0.0)
    {
      map = texelFetch(mapRanges, ivec2(int(found.b), 0), 0);
    }
  }
  if (map.x >= 0)
  {
    color = light.x * min(vec3(codes.rgb) / light.y, 1.0);
  }
  else if (codes.a > 1u)
  {
    color = RayFromLinear(exp2((float(codes.a) - 1.0) / 8.0) * RayToLinear(color));
  }
  // What is brighter than white lies a little behind what touches it, as in cslfGeometryFS.glsl.
  gl_Position.z += max(color.r, max(color.g, color.b)) > 1.0 ? 1e-5 * gl_Position.w : 0.0;
}`;

const MeshPixels = `${Head}
in vec3 color;
in vec2 mapPlace;
flat in ivec4 map;
uniform sampler2D mapColors; // all maps, one after the other; last of each, what is not a number
out vec4 shown;

// As in cslfGeometryFS.glsl.
vec3 GetPixel(vec2 pixel)
{
  vec2 size = vec2(map.z, map.y / map.z);
  vec2 repeats = vec2(map.w & 1, map.w >> 1 & 1);
  vec2 wrapped = clamp(mix(pixel, pixel - size * floor(pixel / size), repeats), vec2(0.0), size - 1.0);
  int index = map.x + int(wrapped.y) * map.z + int(wrapped.x);
  return texelFetch(mapColors, TexelOf(index), 0).rgb;
}

vec3 GetMapColor()
{
  if (map.z == 0)
  {
    int column = clamp(int(floor(mapPlace.x)), 0, map.y - 2);
    return texelFetch(mapColors, TexelOf(map.x + (mapPlace.y > 0.02 ? map.y - 1 : column)), 0).rgb;
  }
  if ((map.w & 4) == 0)
  {
    return GetPixel(floor(mapPlace));
  }
  vec2 first = floor(mapPlace - 0.5);
  vec2 share = mapPlace - 0.5 - first;
  return mix(mix(GetPixel(first), GetPixel(first + vec2(1.0, 0.0)), share.x),
    mix(GetPixel(first + vec2(0.0, 1.0)), GetPixel(first + 1.0), share.x), share.y);
}

void main()
{
  vec3 linear = RayToLinear(color);
  if (map.x >= 0)
  {
    linear *= GetMapColor();
  }
  shown = vec4(linear, 1.0);
}`;

const BallVertices = `${Head}
in vec4 sphere;
uniform mat4 toDisplay;
uniform vec3 eye;
uniform int side, squaresPerRow;
out vec3 pointBC;
flat out vec4 ball;
flat out vec2 square;

void main()
{
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  vec3 toEye = eye - sphere.xyz;
  vec3 facing = normalize(toEye);
  vec3 across =
    normalize(cross(facing, abs(facing.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
  float away = dot(toEye, toEye);
  float size = sphere.w * sqrt(away / max(away - sphere.w * sphere.w, 0.01 * away));
  pointBC = sphere.xyz + size * (corner.x * across + corner.y * cross(facing, across));
  ball = sphere;
  square =
    vec2(gl_InstanceID % squaresPerRow, gl_InstanceID / squaresPerRow) * float(side + 2) + 1.0;
  gl_Position = toDisplay * vec4(pointBC, 1.0);
}`;

const BallPixels = `${Head}
in vec3 pointBC;
flat in vec4 ball;
flat in vec2 square;
uniform mat4 toDisplay;
uniform vec3 eye;
uniform int side;
uniform sampler2D colors;
out vec4 shown;

vec2 FindPlace(vec3 direction)
{
  vec3 sides = direction / (abs(direction.x) + abs(direction.y) + abs(direction.z));
  vec2 folded = (1.0 - abs(sides.yx)) * vec2(sides.x < 0.0 ? -1.0 : 1.0, sides.y < 0.0 ? -1.0 : 1.0);
  return sides.z < 0.0 ? folded : sides.xy;
}

void main()
{
  vec3 direction = pointBC - eye;
  vec3 center = ball.xyz - pointBC;
  float square2 = dot(direction, direction);
  vec3 off = dot(center, direction) / square2 * direction - center;
  float inside = ball.w * ball.w - dot(off, off);
  if (inside < 0.0)
  {
    discard;
  }
  vec3 normal = off - sqrt(inside / square2) * direction;
  vec4 point = toDisplay * vec4(ball.xyz + normal, 1.0);
  gl_FragDepth = 0.5 * point.z / point.w + 0.5;
  vec2 texel = square + (0.5 * FindPlace(normal) + 0.5) * float(side);
  shown = vec4(RayToLinear(textureLod(colors, texel / vec2(textureSize(colors, 0)), 0.0).rgb), 1.0);
}`;

/**
 * Throws an Error with the compiler's words.
 * @param {WebGL2RenderingContext} gl @param {string} vertices @param {string} pixels
 */
export function makeProgram(gl, vertices, pixels) {
  const program = /** @type {WebGLProgram} */ (gl.createProgram());
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertices], [gl.FRAGMENT_SHADER, pixels]]) {
    const shader = /** @type {WebGLShader} */ (gl.createShader(Number(kind)));
    gl.shaderSource(shader, String(source));
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) {
      throw new Error(gl.getShaderInfoLog(shader) || "a shader");
    }
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    throw new Error(gl.getProgramInfoLog(program) || "a program");
  }
  /** @type {Record<string, WebGLUniformLocation | null>} */
  const uniforms = {};
  const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) || 0;
  for (let i = 0; i < count; ++i) {
    const { name } = /** @type {WebGLActiveInfo} */ (gl.getActiveUniform(program, i));
    uniforms[name.replace("[0]", "")] = gl.getUniformLocation(program, name);
  }
  return { program, uniforms, attribute: (/** @type {string} */ name) =>
    gl.getAttribLocation(program, name) };
}

/**
 * An image whose texels are addressed by one number.
 * @param {WebGL2RenderingContext} gl @param {ArrayBufferView & {length: number}} values
 * @param {number} channels @param {number} internal @param {number} format @param {number} type
 */
function makeList(gl, values, channels, internal, format, type) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  const width = 1 << RowBits;
  const rows = Math.max(1, Math.ceil(values.length / channels / width));
  if (rows > gl.getParameter(gl.MAX_TEXTURE_SIZE)) {
    throw new Error("it is too large for this device");
  }
  gl.texStorage2D(gl.TEXTURE_2D, 1, internal, width, rows);
  const whole = Math.floor(values.length / channels / width);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  const rest = values.length / channels - whole * width;
  if (whole > 0) {
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, whole, format, type, values);
  }
  if (rest > 0) {
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, whole, rest, 1, format, type, values,
      whole * width * channels);
  }
  return texture;
}

/**
 * @param {WebGL2RenderingContext} gl @param {number} target
 * @param {any} data typed array, whose type newer versions of TypeScript tell in other words
 */
function makeBuffer(gl, target, data) {
  const buffer = gl.createBuffer();
  gl.bindBuffer(target, buffer);
  gl.bufferData(target, data, gl.STATIC_DRAW);
  return buffer;
}

/** Linear light from 0 to 1 of encoded values. */
const toLinear = (/** @type {number} */ code) =>
  code <= 0.04045 ? code / 12.92 : ((code + 0.055) / 1.055) ** 2.4;
const toEncoded = (/** @type {number} */ light) =>
  light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055;

/** The direction of a place in an octahedral map, which goes on beyond its edges. */
function directionOf(/** @type {number} */ x, /** @type {number} */ y) {
  if (Math.abs(x) > 1) {
    [x, y] = [Math.sign(x) * 2 - x, -y];
  }
  if (Math.abs(y) > 1) {
    [x, y] = [-x, Math.sign(y) * 2 - y];
  }
  const z = 1 - Math.abs(x) - Math.abs(y);
  return z < 0
    ? [Math.sign(x || 1) * (1 - Math.abs(y)), Math.sign(y || 1) * (1 - Math.abs(x)), z] : [x, y, z];
}

/** Which triangle of a batch's mesh a direction from the origin meets, and where. */
function findBlend(/** @type {Batch} */ batch, /** @type {number[]} */ direction) {
  let best = { corners: [0, 0, 0], weights: [1, 0, 0] }, bestInside = -2;
  for (let i = 0; i < batch.corners.length; i += 3) {
    const corners = Array.from(batch.corners.subarray(i, i + 3));
    const [a, b, c] = corners.map((p) => batch.places.subarray(3 * p, 3 * p + 3));
    const volume = (/** @type {any} */ p, /** @type {any} */ q, /** @type {any} */ r) =>
      p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
      p[2] * (q[0] * r[1] - q[1] * r[0]);
    const whole = volume(a, b, c);
    const weights = [volume(direction, b, c), volume(a, direction, c), volume(a, b, direction)]
      .map((part) => part / whole);
    const sum = weights[0] + weights[1] + weights[2];
    const inside = Math.min(...weights) / sum;
    if (sum > 0 && inside > bestInside) {
      bestInside = inside;
      best = { corners, weights: weights.map((weight) => weight / sum) };
    }
  }
  return best;
}

/** The triangles of a batch, at all its places. */
class Mesh {
  /** @param {Surfaces} surfaces @param {Batch} batch */
  constructor(surfaces, batch) {
    const { gl, mesh } = surfaces;
    this.surfaces = surfaces;
    this.batch = batch;
    this.corners = makeBuffer(gl, gl.ELEMENT_ARRAY_BUFFER, batch.corners);
    this.places = makeBuffer(gl, gl.ARRAY_BUFFER, batch.places);
    this.matrices = makeBuffer(gl, gl.ARRAY_BUFFER, new Float32Array(batch.matrices));
    this.sides = batch.sides.map((side) =>
      makeList(gl, side, 4, gl.RGBA8UI, gl.RGBA_INTEGER, gl.UNSIGNED_BYTE));
    /** @type {WebGLTexture | null} */
    this.mapPlaces = null;
    // Those that are mirrored show their fronts clockwise.
    this.parts = [[0, batch.unmirrored, gl.CCW], [batch.unmirrored, batch.bodies, gl.CW]]
      .filter(([first, end]) => first < end)
      .map(([first, end, winding]) => {
        const array = gl.createVertexArray();
        gl.bindVertexArray(array);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.corners);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.places);
        const size = batch.places.BYTES_PER_ELEMENT;
        gl.enableVertexAttribArray(mesh.attribute("place"));
        gl.vertexAttribPointer(mesh.attribute("place"), 3,
          batch.places instanceof Uint16Array ? gl.UNSIGNED_SHORT : gl.SHORT, false,
          size * batch.stride, 0);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.matrices);
        ["rowX", "rowY", "rowZ"].forEach((row, i) => {
          const attribute = mesh.attribute(row);
          gl.enableVertexAttribArray(attribute);
          gl.vertexAttribPointer(attribute, 4, gl.FLOAT, false, 48, 48 * first + 16 * i);
          gl.vertexAttribDivisor(attribute, 1);
        });
        gl.bindVertexArray(null);
        return { array, first, count: end - first, winding };
      });
  }

  /** @param {Geometry} geometry @param {ColorMap[]} shown */
  setMaps(geometry, shown) {
    const { gl } = this.surfaces;
    const places = listPlaces(this.batch, geometry, shown);
    gl.deleteTexture(this.mapPlaces);
    this.mapPlaces = places.length ? makeList(gl, places, 3, gl.RGB32F, gl.RGB, gl.FLOAT) : null;
  }

  /**
   * @param {number} side 0: fronts, or both if they are alike; 1: backs
   * @param {boolean} isMirrored what is drawn
   */
  draw(side, isMirrored) {
    const { gl, mesh } = this.surfaces;
    if (side >= this.sides.length) {
      return;
    }
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.sides[side]);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, this.mapPlaces);
    gl.uniform1i(mesh.uniforms.points, this.batch.points);
    this.sides.length > 1 ? gl.enable(gl.CULL_FACE) : gl.disable(gl.CULL_FACE);
    gl.cullFace(side ? gl.FRONT : gl.BACK);
    for (const part of this.parts) {
      gl.frontFace(isMirrored === (part.winding === gl.CW) ? gl.CCW : gl.CW);
      gl.uniform1i(mesh.uniforms.firstBody, part.first);
      gl.bindVertexArray(part.array);
      gl.drawElementsInstanced(gl.TRIANGLES, this.batch.corners.length, gl.UNSIGNED_INT, 0,
        part.count);
    }
  }
}

/** The balls of a batch. */
class Balls {
  /** @param {Surfaces} surfaces @param {Batch} batch @param {number[]} scale from CC to BC */
  constructor(surfaces, batch, scale) {
    const { gl, ball } = surfaces;
    this.surfaces = surfaces;
    this.batch = batch;
    this.side = Math.ceil(Math.sqrt(TexelsPerPoint * batch.points));
    this.perRow = Math.ceil(Math.sqrt(batch.bodies));
    const size = this.side + 2;
    this.blends = Array.from({ length: size * size }, (_, i) =>
      findBlend(batch, directionOf((2 * (i % size) - 1) / this.side - 1,
        (2 * Math.floor(i / size) - 1) / this.side - 1)));
    const spheres = new Float32Array(4 * batch.bodies);
    for (let i = 0; i < batch.bodies; ++i) {
      const matrix = batch.matrices.subarray(12 * i, 12 * i + 12);
      let radius = 0;
      for (let axis = 0; axis < 3; ++axis) {
        spheres[4 * i + axis] = scale[axis] * matrix[4 * axis + 3];
        radius += (batch.ballRadius * scale[axis] * matrix[5 * axis]) / 3;
      }
      spheres[4 * i + 3] = radius;
    }
    this.array = gl.createVertexArray();
    gl.bindVertexArray(this.array);
    makeBuffer(gl, gl.ARRAY_BUFFER, spheres);
    gl.enableVertexAttribArray(ball.attribute("sphere"));
    gl.vertexAttribPointer(ball.attribute("sphere"), 4, gl.FLOAT, false, 0, 0);
    gl.vertexAttribDivisor(ball.attribute("sphere"), 1);
    gl.bindVertexArray(null);
    this.image = gl.createTexture();
  }

  /** Whether a batch can be drawn so. */
  static fits(/** @type {Batch} */ batch, /** @type {number} */ maximumLight,
    /** @type {number} */ maximumImage) {
    const size = Math.ceil(Math.sqrt(batch.bodies)) *
      (Math.ceil(Math.sqrt(TexelsPerPoint * batch.points)) + 2);
    return batch.ballRadius > 0 && batch.bodies >= MinimumBalls && batch.unmirrored === batch.bodies &&
      Math.max(batch.points, batch.corners.length / 3) <= MaximumPrototype &&
      size <= maximumImage && maximumLight <= 1 && batch.sides.length === 1 &&
      batch.sides[0].every((code, i) => (i & 3) !== 3 || code <= 1);
  }

  /** @param {Geometry} geometry @param {ColorMap[]} shown @param {number[]} light */
  setMaps(geometry, shown, light) {
    const { gl } = this.surfaces;
    const { points, bodies, sides: [side] } = this.batch;
    const places = listPlaces(this.batch, geometry, shown);
    const size = this.side + 2;
    const width = this.perRow * size;
    const height = Math.ceil(bodies / this.perRow) * size;
    const image = new Uint8Array(4 * width * height);
    for (let body = 0; body < bodies; ++body) {
      const first = Math.floor(body / this.perRow) * size * width + (body % this.perRow) * size;
      const start = body * points;
      this.blends.forEach(({ corners, weights }, i) => {
        const to = 4 * (first + Math.floor(i / size) * width + (i % size));
        const number = places.length ? places[3 * (start + corners[0]) + 2] : -1;
        let column = 0, none = 0;
        for (let k = 0; number >= 0 && k < 3; ++k) {
          const place = 3 * (start + corners[k]);
          column += weights[k] * places[place];
          none += weights[k] * places[place + 1];
        }
        const map = shown[number];
        const base = map ? 3 * (none > 0.02 ? map.steps + 2 : indexOf(map, column)) : 0;
        for (let c = 0; c < 3; ++c) {
          let code = 0;
          for (let k = 0; k < 3; ++k) {
            code += weights[k] * side[4 * (start + corners[k]) + c];
          }
          image[to + c] = !map ? Math.round(code) : Math.round(255 * toEncoded(
            toLinear(light[0] * Math.min(code / light[1], 1)) * toLinear(map.colors[base + c] / 255)));
        }
        image[to + 3] = 255;
      });
    }
    gl.bindTexture(gl.TEXTURE_2D, this.image);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, image);
    for (const [name, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR],
      [gl.TEXTURE_MAG_FILTER, gl.LINEAR], [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE],
      [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]]) {
      gl.texParameteri(gl.TEXTURE_2D, name, value);
    }
  }

  draw() {
    const { gl, ball } = this.surfaces;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.image);
    gl.uniform1i(ball.uniforms.side, this.side);
    gl.uniform1i(ball.uniforms.squaresPerRow, this.perRow);
    gl.bindVertexArray(this.array);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.batch.bodies);
  }
}

export class Surfaces {
  /**
   * @param {WebGL2RenderingContext} gl @param {Geometry} geometry
   * @param {number[]} scale half of the cube's edges
   */
  constructor(gl, geometry, scale) {
    this.gl = gl;
    this.mesh = makeProgram(gl, MeshVertices, MeshPixels);
    this.ball = makeProgram(gl, BallVertices, BallPixels);
    this.geometry = geometry;
    this.light = geometry.maps.length
      ? [geometry.header.maximum_light, geometry.header.light_steps] : [0, 0];
    /** @type {Mesh[]} */
    this.meshes = [];
    /** @type {Balls[]} */
    this.balls = [];
    const limit = Math.min(8192, gl.getParameter(gl.MAX_TEXTURE_SIZE));
    for (const batch of geometry.batches) {
      if (Balls.fits(batch, this.light[0], limit)) {
        this.balls.push(new Balls(this, batch, scale));
      } else {
        this.meshes.push(new Mesh(this, batch));
      }
    }
    /** @type {(WebGLTexture | null)[]} */
    this.maps = [null, null];
  }

  /**
   * Shows the field's maps so. There are as many.
   * @param {ColorMap[]} shown
   */
  setMaps(shown) {
    const { gl } = this;
    const ranges = new Int32Array(4 * shown.length);
    let count = 0;
    shown.forEach(({ steps, image }, i) => {
      const flags = image ? Number(image.repeats[0]) + 2 * Number(image.repeats[1]) +
        4 * Number(image.smooth) : 0;
      ranges.set([count, steps + 3, image ? image.size[0] : 0, flags], 4 * i);
      count += steps + 3;
    });
    const codes = new Uint8Array(4 * count).fill(255);
    shown.forEach(({ colors, steps }, i) => {
      for (let k = 0, to = 4 * ranges[4 * i]; k < steps + 3; ++k, to += 4) {
        codes[to] = colors[3 * k];
        codes[to + 1] = colors[3 * k + 1];
        codes[to + 2] = colors[3 * k + 2];
      }
    });
    this.maps.forEach((image) => gl.deleteTexture(image));
    this.maps = [
      makeList(gl, codes, 4, gl.SRGB8_ALPHA8, gl.RGBA, gl.UNSIGNED_BYTE),
      makeList(gl, ranges, 4, gl.RGBA32I, gl.RGBA_INTEGER, gl.INT),
    ];
    for (const one of [...this.meshes, ...this.balls]) {
      one.setMaps(this.geometry, shown, this.light);
    }
  }

  /**
   * Draws into the current framebuffer.
   * @param {DOMMatrix} ccToDisplay @param {DOMMatrix} bcToDisplay @param {number[]} eyeBC
   * @param {boolean} isMirrored whether these matrices mirror what is in front of the eye
   */
  draw(ccToDisplay, bcToDisplay, eyeBC, isMirrored) {
    const { gl, mesh, ball } = this;
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LESS);
    gl.disable(gl.BLEND);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    if (this.balls.length) {
      gl.disable(gl.CULL_FACE);
      gl.useProgram(ball.program);
      gl.uniformMatrix4fv(ball.uniforms.toDisplay, false, bcToDisplay.toFloat32Array());
      gl.uniform3fv(ball.uniforms.eye, eyeBC);
      gl.uniform1i(ball.uniforms.colors, 0);
      this.balls.forEach((one) => one.draw());
    }
    gl.useProgram(mesh.program);
    gl.uniformMatrix4fv(mesh.uniforms.toDisplay, false, ccToDisplay.toFloat32Array());
    gl.uniform2fv(mesh.uniforms.light, this.light);
    gl.uniform1i(mesh.uniforms.colors, 0);
    gl.uniform1i(mesh.uniforms.places, 1);
    ["mapColors", "mapRanges"].forEach((name, i) => {
      gl.uniform1i(mesh.uniforms[name], 2 + i);
      gl.activeTexture(gl.TEXTURE2 + i);
      gl.bindTexture(gl.TEXTURE_2D, this.maps[i]);
    });
    this.meshes.forEach((one) => one.draw(0, isMirrored));
    // Along silhouettes, fronts and backs are equally deep, and the front must be seen.
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(0, 2);
    this.meshes.forEach((one) => one.draw(1, isMirrored));
    gl.disable(gl.POLYGON_OFFSET_FILL);
    gl.bindVertexArray(null);
  }
}
