// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Colour maps as they are shown: ColorMap in Filters/Pipeline/cslfColorMap.h and
// Rendering/cslfShownMaps.h.

/** @typedef {import("./geometry.js").Batch} Batch */
/** @typedef {import("./geometry.js").ColorMap} ColorMap */
/** @typedef {import("./geometry.js").Geometry} Geometry */

const Inset = 1e-6;
const SnapDistance = 1e-7;
const MaximumColumn = 1e6;
const FloatStep = 2 ** -24;

/**
 * As --color-by of the tool takes it; nothing for one colour.
 * @param {ColorMap} map
 */
export function nameOf(map) {
  return map.array === undefined ? ""
    : (map.array || "Scalars") + (map.component ? ":" + map.component.replace("Magnitude", "magnitude") : "");
}

/**
 * The value, or its logarithm on a logarithmic map.
 * @param {ColorMap} map @param {number} value
 */
function toScale(map, value) {
  return map.logarithmic ? Math.log10(Math.max(value, Number.MIN_VALUE)) : value;
}

/**
 * The value at a share of the range.
 * @param {ColorMap} map @param {number} share
 */
export function valueAt(map, share) {
  const [first, last] = map.range.map((value) => toScale(map, value));
  const value = first + share * (last - first);
  return map.logarithmic ? 10 ** value : value;
}

/**
 * The column of a value, which is a number.
 * @param {ColorMap} map @param {number} value
 */
function columnOf(map, value) {
  const [first, last] = map.range.map((end) => toScale(map, end));
  const steps = map.steps;
  let column = 1 + (steps * (toScale(map, value) - first)) / (last - first);
  const rounding = FloatStep * Math.max(Math.abs(map.range[0]), Math.abs(map.range[1]));
  if (value >= map.range[0] - rounding && value <= map.range[1] + rounding) {
    const inset = Inset * (steps + 2);
    column = Math.min(Math.max(column, 1 + inset), 1 + steps - inset);
  }
  const whole = Math.round(column);
  column = Math.abs(column - whole) < SnapDistance ? whole : column;
  return Math.min(Math.max(column, -MaximumColumn), MaximumColumn);
}

/**
 * The columns on a shown map of all places that the file stores, which lie on the field's own; the
 * last place is no number.
 * @param {ColorMap} own @param {ColorMap} shown
 */
function listColumns(own, shown) {
  const [first, last] = own.places || [0, 0];
  const none = 2 ** (own.bits || 8) - 1;
  return Float32Array.from({ length: none + 1 }, (_, place) => {
    const column = first + ((last - first) * place) / (none - 1);
    return place === none ? 0.5 * (shown.steps + 2)
      : columnOf(shown, valueAt(own, (column - 1) / own.steps));
  });
}

/**
 * The value of an array's component, or the magnitude.
 * @param {Float64Array[]} components
 */
function valueOf(components, /** @type {number} */ component, /** @type {number} */ i) {
  return component < 0 ? Math.hypot(...components.map((values) => values[i]))
    : components[component][i];
}

// The array of places on images, in steps of pixels: Filters/Pipeline/cslfColorMap.h.
const TexturePlaces = "CSLF:TexturePlaces";

/**
 * Of each point of a batch: the column on its shown map, 1 for what is not a number, otherwise 0;
 * or the place on an image; and the number of the map, from 0, or -1 without one.
 * @param {Batch} batch @param {Geometry} geometry @param {ColorMap[]} shown
 */
export function listPlaces(batch, geometry, shown) {
  const { mapPlaces, mapNumbers, arrays } = batch;
  const columns = geometry.maps.map((map, i) =>
    shown[i].source || map.image ? new Float32Array(0) : listColumns(map, shown[i]));
  const onImages = arrays[geometry.arrays.findIndex(({ name }) => name === TexturePlaces)];
  const places = new Float32Array(3 * (mapPlaces ? mapPlaces.length : 0));
  for (let i = 0; mapPlaces && mapNumbers && i < mapPlaces.length; ++i) {
    const k = mapNumbers[i] - 1;
    places[3 * i + 2] = k;
    if (k < 0) {
      continue;
    }
    const { image } = shown[k];
    if (image) {
      places[3 * i] = onImages[0][i] / image.steps;
      places[3 * i + 1] = onImages[1][i] / image.steps;
      continue;
    }
    const { source, steps } = shown[k];
    const value = source ? valueOf(arrays[source.array], source.component, i) : 0;
    const isNone = source ? isNaN(value) : mapPlaces[i] === columns[k].length - 1;
    places[3 * i] = isNone ? 0.5 * (steps + 2)
      : source ? columnOf(shown[k], value) : columns[k][mapPlaces[i]];
    places[3 * i + 1] = isNone ? 1 : 0;
  }
  return places;
}

/**
 * The maps that show arrays which gave no colours, as the field itself would: one for each
 * component and magnitude.
 * @param {Geometry} geometry @param {{steps: number, colors: Uint8Array}} fallback
 * @returns {ColorMap[]}
 */
export function listArrayMaps({ arrays, maps }, fallback) {
  const { steps, colors } = maps.find((map) => map.array !== undefined) || fallback;
  return arrays.flatMap(({ name, components }, array) => {
    if (name === TexturePlaces) {
      return [];
    }
    const only = components.length === 1;
    return (only ? [0] : [-1, ...components.keys()]).map((component) => ({
      array: name, range: [0, 1], steps, colors, source: { array, component },
      component: only ? "" : component < 0 ? "magnitude" : components[component] || String(component),
    }));
  });
}

/**
 * The smallest and the largest value that a map can show.
 * @param {Geometry} geometry
 * @param {ColorMap} map of an array, or of the geometry
 */
export function rangeOfData({ batches, maps }, map) {
  let low = Infinity, high = -Infinity;
  const { source } = map;
  batches.forEach(({ arrays }) => source && arrays[source.array]?.[0].forEach((_, i) => {
    const value = valueOf(arrays[source.array], source.component, i);
    low = value < low ? value : low;
    high = value > high ? value : high;
  }));
  for (const own of source ? [] : maps.filter((one) => nameOf(one) === nameOf(map))) {
    const ends = (own.places || [1, 1 + own.steps]).map((column) =>
      valueAt(own, (column - 1) / own.steps));
    low = Math.min(low, ends[0]);
    high = Math.max(high, ends[1]);
  }
  return low < high ? [low, high] : low === high ? [low, low + 1] : [0, 1];
}

/** Whether points with a map, of which the number is given, have values of an array. */
export function hasArray(/** @type {Geometry} */ { batches }, /** @type {number} */ array,
  /** @type {number} */ number) {
  return batches.some(({ mapNumbers, arrays }) => mapNumbers?.some((one, i) =>
    one === number && !isNaN(arrays[array][0][i])));
}

/**
 * The index, among the colours, of a column.
 * @param {ColorMap} map @param {number} column
 */
export function indexOf(map, column) {
  return Math.min(Math.max(Math.floor(column), 0), map.steps + 1);
}

/**
 * A preset's colours over the range of another map. Below and above the range, the preset goes on
 * with its ends.
 * @param {ColorMap} map @param {{steps: number, colors: Uint8Array} | null} preset
 * @param {number[]} range @returns {ColorMap}
 */
export function recolor(map, preset, range) {
  return { ...map, ...(preset || {}), range };
}

/**
 * Whether values can be mapped over a range.
 * @param {ColorMap} map @param {number[]} range
 */
export function isRange(map, range) {
  return range.length === 2 && range.every(Number.isFinite) && range[0] < range[1] &&
    !(map.logarithmic && range[0] <= 0);
}

/** A value for a scalar bar: with four digits of the range, or of its own if that is logarithmic. */
export function format(/** @type {number} */ value, /** @type {ColorMap} */ map) {
  if (map.logarithmic) {
    return String(Number(value.toPrecision(4)));
  }
  const unit = 10 ** (Math.floor(Math.log10(map.range[1] - map.range[0])) - 3);
  return String(Number((Math.round(value / unit) * unit).toPrecision(15)));
}

/** A map's colours from the bottom of a canvas of one column to its top. */
export function paintBar(/** @type {HTMLCanvasElement} */ canvas, /** @type {ColorMap} */ map) {
  const height = (canvas.height = 256);
  canvas.width = 1;
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  const image = context.createImageData(1, height);
  for (let y = 0; y < height; ++y) {
    const at = 3 * indexOf(map, 1 + ((height - 0.5 - y) / height) * map.steps);
    image.data.set([...map.colors.subarray(at, at + 3), 255], 4 * y);
  }
  context.putImageData(image, 0, 0);
}
