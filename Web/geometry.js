// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Reads a field's geometry from the bytes that coded files have of it: Documentation/FileFormat.md,
// section Geometry. Positions are cube coordinates (CC).

/**
 * One mesh at one or several places, its bodies.
 * @typedef {object} Batch
 * @property {Uint32Array} corners three for each triangle
 * @property {Uint16Array | Int16Array} places of the points, which `matrices` take to CC
 * @property {number} stride numbers from one place to the next
 * @property {number} points of the mesh
 * @property {Float64Array} matrices 3 x 4 numbers for each body, row by row
 * @property {number} bodies
 * @property {number} unmirrored the first bodies, whose matrices do not mirror
 * @property {number} ballRadius if the mesh stands for the unit sphere, the length in `places` of its
 *   radius; otherwise 0
 * @property {Uint8Array[]} sides of each side, red, green, blue and the code of exact colours of
 *   each point of each body; one side if both are alike
 * @property {Uint16Array | null} mapPlaces of each point of each body
 * @property {Uint8Array | null} mapNumbers of each point of each body, from 1, or 0 without a map
 * @property {Float64Array[][]} arrays of each array and component, the value at each point of each
 *   body, or NaN
 * @property {number[]} [order] of bodies in the file
 *
 * Scalars as colours: cslfColorMap.h.
 * @typedef {object} ColorMap
 * @property {string} [array] none for surfaces of one colour
 * @property {string} [component]
 * @property {number[]} range
 * @property {boolean} [logarithmic]
 * @property {number} steps
 * @property {Uint8Array} colors red, green and blue, sRGB-encoded: below the range, of the steps,
 *   above it, and of what is not a number
 * @property {{size: number[], repeats: boolean[], steps: number, smooth: boolean, jpeg: boolean, bytes: number}} [image] what is
 *   there instead of scalars: colours are its pixels, the lowest row first
 * @property {number[]} [places] columns of the smallest and the largest stored place
 * @property {number} [bits] of a stored place
 * @property {{array: number, component: number}} [source] what is shown in place of the map's own
 *   scalars: the number of an array, and a component, or -1 for the magnitude
 *
 * An array that gave surfaces no colours.
 * @typedef {object} ArrayHeader
 * @property {string} name
 * @property {string[]} components
 * @property {number[][]} ranges
 * @property {number[]} steps
 *
 * @typedef {object} Geometry
 * @property {any} header
 * @property {Batch[]} batches
 * @property {ColorMap[]} maps
 * @property {ArrayHeader[]} arrays
 */

/**
 * Bytes that were deflated, with zlib's header.
 * @param {Uint8Array} bytes
 */
export async function inflate(bytes) {
  const inflater = new /** @type {any} */ (window).DecompressionStream("deflate");
  const stream = new Blob([/** @type {any} */ (bytes)]).stream().pipeThrough(inflater);
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** @param {boolean} isTrue @param {string} what */
export function require(isTrue, what) {
  if (!isTrue) {
    throw new Error(what);
  }
}

/**
 * The mode TRIANGLES of EXT_meshopt_compression, version 1.
 * @param {Uint8Array} stream @param {number} triangles
 */
function readCorners(stream, triangles) {
  require(stream[0] === 0xe1, "its corners have another version");
  const corners = new Uint32Array(3 * triangles);
  const edges = new Uint32Array(32);
  const points = new Uint32Array(16);
  const table = stream.subarray(stream.length - 16);
  let edge = 0, point = 0, next = 0, last = 0, place = 1 + triangles;

  const keepPoint = (/** @type {number} */ p) => {
    points[point] = p;
    point = (point + 1) & 15;
  };
  const keepEdge = (/** @type {number} */ a, /** @type {number} */ b) => {
    edges[2 * edge] = a;
    edges[2 * edge + 1] = b;
    edge = (edge + 1) & 15;
  };
  // The difference to the last such point, in groups of seven bits.
  const readPoint = () => {
    let number = 0, shift = 0, byte = 0;
    do {
      byte = stream[place++];
      number |= (byte & 127) << shift;
      shift += 7;
    } while (byte > 127);
    last = (last + ((number >>> 1) ^ -(number & 1))) >>> 0;
    return last;
  };

  for (let i = 0; i < triangles; ++i) {
    const code = stream[1 + i];
    let a, b, c;
    if (code < 0xf0) {
      const known = 2 * ((edge - 1 - (code >> 4)) & 15);
      a = edges[known];
      b = edges[known + 1];
      const kind = code & 15;
      if (kind > 0 && kind < 13) {
        c = points[(point - 1 - kind) & 15];
      } else {
        c = kind === 0 ? next++ : kind === 15 ? readPoint() : (last += kind === 13 ? -1 : 1);
        keepPoint(c);
      }
    } else {
      const both = code < 0xfe ? table[code & 15] : stream[place++];
      if (code >= 0xfe && both === 0) {
        next = 0;
      }
      const kinds = [code === 0xff ? 15 : 0, both >> 4, both & 15];
      const start = point;
      const before = points.slice();
      // New points come before those that the stream states.
      const all = kinds.map((kind) => (kind === 0 ? next++ : before[(start - kind) & 15]));
      kinds.forEach((kind, k) => {
        all[k] = kind === 15 ? readPoint() : all[k];
        if (kind === 0 || kind === 15) {
          keepPoint(all[k]);
        }
      });
      [a, b, c] = all;
      keepEdge(b, a);
    }
    keepEdge(c, b);
    keepEdge(a, c);
    corners.set([a, b, c], 3 * i);
  }
  require(place + 16 === stream.length, "its corners are damaged");
  return corners;
}

/**
 * The mode ATTRIBUTES, version 0: `size` bytes for each point.
 * @param {Uint8Array} stream @param {number} points @param {number} size
 */
function readAttributes(stream, points, size) {
  require(stream[0] === 0xa0, "its points have another version");
  const result = new Uint8Array(points * size);
  const last = stream.slice(stream.length - size);
  const maximum = Math.min((8192 / size) & ~15, 256);
  let place = 1;
  const codes = new Uint8Array(maximum + 16);
  for (let first = 0; first < points; first += maximum) {
    const count = Math.min(maximum, points - first);
    const groups = (count + 15) >> 4;
    for (let k = 0; k < size; ++k) {
      const kinds = place;
      place += (groups + 3) >> 2;
      for (let group = 0; group < groups; ++group) {
        const kind = (stream[kinds + (group >> 2)] >> (2 * (group & 3))) & 3;
        const bits = kind === 3 ? 8 : 2 * kind;
        const escape = (1 << bits) - 1;
        let more = place + 2 * bits;
        for (let i = 0; i < 16; ++i) {
          let code = 0;
          if (kind === 3) {
            code = stream[place + i];
          } else if (kind > 0) {
            const bit = i * bits;
            code = (stream[place + (bit >> 3)] >> (8 - bits - (bit & 7))) & escape;
            code = code === escape ? stream[more++] : code;
          }
          codes[16 * group + i] = code;
        }
        place = more;
      }
      let value = last[k];
      for (let i = 0; i < count; ++i) {
        value = (value + ((codes[i] >> 1) ^ -(codes[i] & 1))) & 255;
        result[(first + i) * size + k] = value;
      }
      last[k] = value;
    }
  }
  require(place <= stream.length, "its points are damaged");
  return result;
}

/** Reads sequences of bytes, one after the other. */
class Streams {
  /** @param {Uint8Array} bytes */
  constructor(bytes) {
    this.bytes = bytes;
    this.place = 0;
  }

  /** @param {number} count */
  take(count) {
    require(count >= 0 && this.place + count <= this.bytes.length, "it ends too early");
    this.place += count;
    return this.bytes.subarray(this.place - count, this.place);
  }

  /**
   * Integers whose low bytes come before their high bytes.
   * @template {Int16Array | Int32Array | Uint16Array | Uint32Array} Numbers
   * @param {Numbers} numbers @returns {Numbers}
   */
  fill(numbers) {
    const size = numbers.BYTES_PER_ELEMENT;
    const planes = this.take(numbers.length * size);
    const bytes = new Uint8Array(numbers.buffer);
    for (let i = 0; i < numbers.length; ++i) {
      for (let k = 0; k < size; ++k) {
        bytes[i * size + k] = planes[k * numbers.length + i];
      }
    }
    return numbers;
  }

  /**
   * Integers that are folded.
   * @param {number} count
   */
  takeFolded(count) {
    const folded = this.fill(new Uint16Array(count));
    return Int16Array.from(folded, (number) => (number >> 1) ^ -(number & 1));
  }
}

/**
 * The colours of the points that are no bodies.
 * @param {any} header @param {Streams} streams
 */
function readSides(header, streams) {
  const [fronts, backs, exact] = ["color_bytes", "back_color_bytes", "exact_bytes"].map((key) => {
    const bytes = streams.take(header[key] || 0);
    return bytes.length ? readAttributes(bytes, header.points, 4) : null;
  });
  const sides = [fronts, backs].flatMap((side) => (side ? [side] : []));
  const subtracted = header.subtracted || ["front"];
  if (subtracted.includes("green")) {
    for (const side of sides) {
      for (let i = 0; i < side.length; i += 4) {
        side[i] += side[i + 1];
        side[i + 2] += side[i + 1];
      }
    }
  }
  if (fronts && backs && subtracted.includes("front")) {
    backs.forEach((code, i) => (backs[i] = code + fronts[i]));
  }
  const scale = header.colors === "srgb6" ? 255 / 63 : 1;
  sides.forEach((side, k) => {
    for (let i = 0; i < side.length; i += 4) {
      const alpha = side[i + 3] * scale;
      // Colours are associated with their alpha.
      const factor = alpha > 0 && alpha < 255 ? (255 / alpha) * scale : scale;
      for (let c = 0; factor !== 1 && c < 3; ++c) {
        side[i + c] = Math.min(255, Math.round(factor * side[i + c]));
      }
      side[i + 3] = exact ? exact[i + k] : 0;
    }
  });
  return sides;
}

/**
 * Bodies that are one mesh at several places.
 * @param {any} all the part of the header that tells of all groups @param {any} group
 * @param {Streams} streams @param {number} positionBits @param {number} scale of colours
 * @returns {Batch}
 */
function readBodies(all, group, streams, positionBits, scale) {
  const { points, bodies, extent } = group;
  const count = 3 * points * all.sides;
  const corners = streams.fill(new Uint32Array(3 * group.triangles));
  const places = streams.fill(new Int16Array(3 * points));
  const mean = streams.fill(new Int32Array(count));
  const vectors = Array.from({ length: group.vectors }, () =>
    streams.fill(new Int16Array(count)));

  const matrices = new Float64Array(12 * bodies);
  const steps = 2 ** (positionBits - 1);
  for (let k = 0; k < 12; ++k) {
    const differences = streams.takeFolded(bodies);
    const unit = k % 4 === 3 ? 1 / (steps - 1) : 1 / (steps * 32767);
    let number = 0;
    for (let body = 0; body < bodies; ++body) {
      number = ((number + differences[body]) << 16) >> 16;
      matrices[12 * body + k] = number * unit;
    }
  }
  const multiples = vectors.map(() => streams.takeFolded(bodies));
  const flags = all.has_exact ? streams.take(2 * points * bodies) : null;

  // Mirrored bodies come last.
  const isMirrored = (/** @type {number} */ body) => {
    const [a, b, c, , d, e, f, , g, h, i] = matrices.subarray(12 * body, 12 * body + 12);
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) < 0;
  };
  const order = Array.from({ length: bodies }, (_, body) => body);
  const mirrored = order.filter(isMirrored);
  const sorted = mirrored.length
    ? order.filter((body) => !isMirrored(body)).concat(mirrored) : order;
  const sides = Array.from({ length: all.sides }, () => new Uint8Array(4 * points * bodies));
  const placed = new Float64Array(12 * bodies);
  const sums = new Float64Array(count);
  sorted.forEach((body, place) => {
    placed.set(matrices.subarray(12 * body, 12 * body + 12), 12 * place);
    sums.set(mean);
    vectors.forEach((vector, v) => {
      const factor = all.step * multiples[v][body];
      for (let i = 0; factor !== 0 && i < count; ++i) {
        sums[i] += factor * vector[i];
      }
    });
    for (let s = 0, i = 0; s < all.sides; ++s) {
      const side = sides[s];
      for (let p = 0, to = 4 * points * place; p < points; ++p) {
        for (let c = 0; c < 3; ++c) {
          const code = Math.floor(sums[i++] / 32768 + 0.5);
          side[to++] = Math.round(scale * Math.max(0, Math.min(255 / scale, code)));
        }
        side[to++] = flags ? flags[(s * bodies + body) * points + p] : 0;
      }
    }
  });
  return {
    corners, places, stride: 3, points, matrices: placed, bodies,
    unmirrored: bodies - mirrored.length, ballRadius: group.balls ? 32767 / extent : 0, sides,
    mapPlaces: null, mapNumbers: null, arrays: [], order: sorted,
  };
}

/**
 * Gives a batch the places on maps of its points.
 * @param {any} batch @param {Uint8Array} codes
 */
function placeOnMaps(batch, codes) {
  const count = batch.points * batch.bodies;
  batch.mapPlaces = Uint16Array.from({ length: count }, (_, i) => codes[4 * i] + 256 * codes[4 * i + 1]);
  batch.mapNumbers = Uint8Array.from({ length: count }, (_, i) => codes[4 * i + 2]);
}

/**
 * The values of an array at points, for each component.
 * @param {ArrayHeader} array @param {Uint8Array} stream @param {number} points
 */
function readArray({ ranges, steps }, stream, points) {
  const isShort = steps.every((count) => count < 65535);
  const size = (steps.length * (isShort ? 2 : 4) + 3) & ~3;
  const { buffer } = readAttributes(stream, points, size);
  const codes = isShort ? new Uint16Array(buffer) : new Uint32Array(buffer);
  const stride = codes.length / points;
  return ranges.map(([first, last], c) => Float64Array.from({ length: points }, (_, i) => {
    const code = codes[i * stride + c];
    return code > steps[c] ? NaN : first + ((last - first) * code) / steps[c];
  }));
}

/**
 * What lies at the points of a batch, in the order of its bodies.
 * @template {Float64Array | Uint8Array} Values
 * @param {Batch} batch @param {Values} values in the order of the file
 * @param {number} first of the batch @param {number} size of a point
 */
function takeBatch(batch, values, first, size) {
  const end = size * (first + batch.points * batch.bodies);
  const result = /** @type {Values} */ (values.slice(size * first, end));
  batch.order?.forEach((from, to) => {
    const start = size * (first + from * batch.points);
    result.set(values.subarray(start, start + size * batch.points), size * to * batch.points);
  });
  return result;
}

/**
 * The pixels of a JPEG file, whose row at the bottom becomes the first.
 * @param {Uint8Array} bytes @param {number[]} size
 */
async function decodeImage(bytes, [width, height]) {
  const image = await createImageBitmap(new Blob([/** @type {any} */ (bytes)]),
    { colorSpaceConversion: "none", premultiplyAlpha: "none" });
  require(image.width === width && image.height === height, "an image is damaged");
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  const context = /** @type {CanvasRenderingContext2D} */ (
    canvas.getContext("2d", { willReadFrequently: true }));
  context.drawImage(image, 0, 0);
  const { data } = context.getImageData(0, 0, width, height);
  const colors = new Uint8Array(3 * width * height);
  for (let y = 0, to = 0; y < height; ++y) {
    for (let x = 0, from = 4 * width * (height - 1 - y); x < width; ++x, from += 4) {
      colors[to++] = data[from];
      colors[to++] = data[from + 1];
      colors[to++] = data[from + 2];
    }
  }
  return colors;
}

/**
 * The colours of maps end the part: planes of red, green, blue and alpha, as differences; or images.
 * @param {any} header @param {Streams} streams @returns {Promise<ColorMap[]>}
 */
function readMaps(header, streams) {
  return Promise.all((header.color_maps || []).map(async (/** @type {any} */ map) => {
    const { image } = map;
    const count = image ? image.size[0] * image.size[1] : map.steps + 3;
    const planes = streams.take(image ? image.bytes : 4 * count);
    const all = image ? { ...map, range: [0, 1], steps: count - 3 } : map;
    if (image?.jpeg) {
      return { ...all, colors: await decodeImage(planes, image.size) };
    }
    require(planes.length >= 3 * count, "a colour map is damaged");
    const colors = new Uint8Array(3 * count);
    for (let c = 0; c < 3; ++c) {
      let code = 0;
      for (let i = 0; i < count; ++i) {
        code = (code + planes[c * count + i]) & 255;
        colors[3 * i + c] = code;
      }
    }
    return { ...all, colors };
  }));
}

/**
 * Throws an Error that says what is wrong.
 * @param {Uint8Array} bytes of the part @returns {Promise<Geometry>}
 */
export async function readGeometry(bytes) {
  const size = new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + size)));
  const streams = new Streams(await inflate(bytes.subarray(4 + size)));
  require(["srgb6", "srgb8", "light8"].includes(header.colors), "it has no colours that can be shown");
  const bits = header.position_bits || 16;
  const cornerBytes = streams.take(header.corner_bytes);
  const positionBytes = streams.take(header.position_bytes);
  /** @type {any[]} */
  const batches = [];
  if (header.triangles > 0) {
    const bounds = header.position_bounds || [-1, -1, -1, 1, 1, 1];
    const matrix = new Float64Array(12);
    for (let axis = 0; axis < 3; ++axis) {
      matrix[5 * axis] = (bounds[3 + axis] - bounds[axis]) / (2 ** bits - 1);
      matrix[4 * axis + 3] = bounds[axis];
    }
    batches.push({
      corners: readCorners(cornerBytes, header.triangles),
      places: new Uint16Array(readAttributes(positionBytes, header.points, 8).buffer),
      stride: 4, points: header.points, matrices: matrix, bodies: 1, unmirrored: 1, ballRadius: 0,
      sides: readSides(header, streams), mapPlaces: null, mapNumbers: null, arrays: [],
    });
  }
  // The points of bodies follow those of the mesh.
  const placeBytes = ["place_bytes", "body_place_bytes"].map((key) => streams.take(header[key] || 0));
  /** @type {any[]} */
  const arrays = header.arrays || [];
  const arrayBytes = arrays.map((array) =>
    [array.bytes, array.body_bytes].map((size) => streams.take(size)));
  const all = header.bodies || { groups: [] };
  const own = batches.length;
  for (const group of all.groups) {
    batches.push(readBodies(all, group, streams, bits, header.colors === "srgb6" ? 255 / 63 : 1));
  }
  const maps = await readMaps(header, streams);
  if (maps.length) {
    for (const [k, part] of [batches.slice(0, own), batches.slice(own)].entries()) {
      const count = part.reduce((sum, batch) => sum + batch.points * batch.bodies, 0);
      if (count === 0) {
        continue;
      }
      const codes = readAttributes(placeBytes[k], count, 4);
      const values = arrays.map((array, i) => readArray(array, arrayBytes[i][k], count));
      let first = 0;
      for (const batch of part) {
        placeOnMaps(batch, takeBatch(batch, codes, first, 4));
        batch.arrays = values.map((components) =>
          components.map((component) => takeBatch(batch, component, first, 1)));
        first += batch.points * batch.bodies;
      }
    }
  }
  for (const batch of batches) {
    require(batch.corners.every((/** @type {number} */ corner) => corner < batch.points) &&
      batch.sides.length > 0, "its triangles are damaged");
  }
  return { header, batches, maps, arrays };
}
