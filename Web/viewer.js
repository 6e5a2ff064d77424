// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// The page of a light field: Web/page.html. Its state is the attribute data-state of the root:
// loading, ready as soon as a still view has its best picture, drawing, or failed.

import { Camera, cross, dot, isBusy, listen } from "./camera.js";
import { format, hasArray, isRange, listArrayMaps, nameOf, paintBar, rangeOfData, recolor, valueAt }
  from "./colors.js";
import { inflate, readGeometry, require } from "./geometry.js";
import { Picture } from "./picture.js";
import { Surfaces } from "./surfaces.js";

/**
 * @typedef {import("./geometry.js").ColorMap} ColorMap
 * @typedef {[string, string, string, string, () => boolean | void]} Tool name, key, label, icon, and
 *   what it does; switches tell their state
 */

const Labels = 5;
const MaximumBars = 3; // more would cover the picture
const StillAfter = 250; // milliseconds after the last movement
const RotationPeriod = 30; // seconds
const MaximumPixelRatio = 2;
const Backgrounds = ["#1a1a1f", "#f4f4f6"];

const root = document.documentElement;
const find = (/** @type {string} */ selector) =>
  /** @type {any} */ (document.querySelector(selector));

/** @param {string} text */
function decodeBase64(text) {
  const fromBase64 = /** @type {any} */ (Uint8Array).fromBase64;
  return /** @type {Uint8Array} */ (fromBase64 ? fromBase64(text)
    : Uint8Array.from(atob(text), (character) => character.charCodeAt(0)));
}

/** @param {any} map whose colours are differences */
function readColors(map) {
  const colors = new Uint8Array(map.colors.length);
  map.colors.forEach((/** @type {number} */ step, /** @type {number} */ i) =>
    (colors[i] = step + (i > 2 ? colors[i - 3] : 0)));
  require(colors.length === 3 * (map.steps + 3), "a colour map is damaged");
  return { ...map, colors };
}

/** What the page has: its JSON text and its geometry. */
async function readData() {
  const bytes = decodeBase64(find("#data").textContent.trim());
  require(bytes.length > 4, "there is no data");
  const size = new DataView(bytes.buffer).getUint32(0, true);
  const page = JSON.parse(new TextDecoder().decode(await inflate(bytes.subarray(4, 4 + size))));
  const geometry = await readGeometry(bytes.subarray(4 + size));
  /** @type {ColorMap[]} */
  const exported = page.maps
    ? page.maps.map((/** @type {any} */ map, /** @type {number} */ i) =>
      map.image ? geometry.maps[i] : readColors(map))
    : geometry.maps;
  require(exported.length === geometry.maps.length, "its colour maps do not fit");
  /** @type {Record<string, {steps: number, colors: Uint8Array}>} */
  const presets = Object.fromEntries(Object.entries(page.presets || {})
    .map(([name, preset]) => [name, readColors(preset)]));
  return { page, geometry, exported, presets };
}

/** Red, green and blue, from 0 to 1, of #rrggbb. */
function readColor(/** @type {string} */ text) {
  return [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16) / 255);
}

/** Numbers from -1e30 to 1e30, or NaN. */
const numbers = (/** @type {string | null} */ text) => (text || "").split(",").map((part) =>
  part.trim() && Math.abs(Number(part)) <= 1e30 ? Number(part) : NaN);
const write = (/** @type {number[]} */ values) =>
  values.map(String).join(",");

/**
 * @param {Awaited<ReturnType<typeof readData>>} data @param {WebGL2RenderingContext} gl
 * @param {(text: string) => void} fail
 */
function show({ page, geometry, exported, presets }, gl, fail) {
  const canvas = /** @type {HTMLCanvasElement} */ (gl.canvas);
  const half = page.edges.map((/** @type {number} */ edge) => edge / 2);
  const surfaces = new Surfaces(gl, geometry, half);
  const toWorld = new DOMMatrix(page.matrix);
  const bcToWorld = toWorld.translate(...page.center);
  const ccToWorld = bcToWorld.scale(half[0], half[1], half[2]);
  const center = toWorld.transformPoint(new DOMPoint(...page.center));
  const corner = toWorld.transformPoint(new DOMPoint(
    ...page.center.map((/** @type {number} */ c, /** @type {number} */ i) => c + half[i])));
  const middle = [center.x, center.y, center.z];
  const { m11, m12, m13, m21, m22, m23, m31, m32, m33 } = toWorld;
  const isMirrored = dot([m11, m12, m13], cross([m21, m22, m23], [m31, m32, m33])) < 0;
  const radius = Math.hypot(corner.x - center.x, corner.y - center.y, corner.z - center.z);
  const camera = new Camera(page.camera);
  const arrayMaps = exported.length ? listArrayMaps(geometry, Object.values(presets)[0]) : [];
  const names = [...new Set([...geometry.maps, ...arrayMaps].map(nameOf))].filter(Boolean);
  const hasMaps = names.length > 0;
  let shown = exported;
  /** @type {{array: string, map: string, range: number[] | null}} */
  const colors = { array: "", map: "", range: null };
  let background = page.background, isRotating = false, movingUntil = 0, lastFrame = 0;
  let isRequested = false, wasMoving = false, hasBar = hasMaps, hasAxes = true;

  const picture = new Picture(gl, (aspect, x, y) => {
    const world = camera.matrix(aspect, middle, radius, x, y);
    const eye = bcToWorld.inverse().transformPoint(new DOMPoint(...camera.position));
    surfaces.draw(world.multiply(ccToWorld), world.multiply(bcToWorld), [eye.x, eye.y, eye.z],
      isMirrored);
  });

  const request = () => {
    if (!isRequested) {
      isRequested = true;
      requestAnimationFrame(frame);
    }
  };
  const redraw = () => {
    picture.reset();
    root.dataset.state = "drawing";
    request();
  };
  const move = () => {
    movingUntil = performance.now() + StillAfter;
    redraw();
  };

  /** @param {number} now */
  function frame(now) {
    isRequested = false;
    if (gl.isContextLost()) {
      return;
    }
    const isMoving = isRotating || now < movingUntil;
    if (isRotating) {
      camera.orbit((-Math.min(now - lastFrame, 100) / 1000 / RotationPeriod) * 2 * Math.PI, 0);
    }
    if (isMoving && wasMoving) {
      picture.adapt(now - lastFrame);
    }
    lastFrame = now;
    wasMoving = isMoving;
    if (isMoving || !picture.isComplete) {
      picture.draw(isMoving);
      root.dataset.drawn = "";
      drawAxes();
      request();
    } else {
      root.dataset.state = "ready";
      writeHash();
    }
  }

  function drawAxes() {
    const [right, up] = camera.axes;
    const ends = ["X", "Y", "Z"].map((name, i) => ({
      name, x: 26 * right[i], y: -26 * up[i], color: ["#e5484d", "#30a46c", "#4c8dff"][i] }));
    find("#axes").innerHTML = ends.map(({ name, x, y, color }) =>
      `<line x2="${x}" y2="${y}" stroke="${color}"/>` +
      `<text x="${1.3 * x}" y="${1.3 * y}" fill="${color}">${name}</text>`).join("");
  }

  function resize() {
    const ratio = Math.min(window.devicePixelRatio || 1, MaximumPixelRatio);
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    redraw();
  }

  // Colours.

  const selects = (/** @type {ColorMap} */ map) =>
    colors.array ? nameOf(map) === colors.array : map.array !== undefined;
  const isLike = (/** @type {ColorMap} */ map, /** @type {ColorMap} */ other) =>
    nameOf(map) === nameOf(other) && write(map.range) === write(other.range);

  /** The maps in which the chosen array is shown as the field itself or the exported page does. */
  function chooseMaps() {
    return exported.map((map, i) => {
      if (!colors.array || selects(map)) {
        return map;
      }
      const array = arrayMaps.find(selects);
      return array?.source && hasArray(geometry, array.source.array, i + 1)
        ? { ...array, range: rangeOfData(geometry, array) }
        : selects(geometry.maps[i]) ? geometry.maps[i] : map;
    });
  }

  /** A scalar bar. */
  function makeBar(/** @type {ColorMap} */ map) {
    const bar = document.createElement("figure");
    bar.innerHTML = "<figcaption></figcaption><div><canvas></canvas><ol></ol></div>";
    const [caption, canvas, labels] = /** @type {any} */ (bar.querySelectorAll("figcaption, canvas, ol"));
    caption.textContent = nameOf(map);
    paintBar(canvas, map);
    labels.innerHTML = Array.from({ length: Labels }, (_, i) =>
      `<li>${format(valueAt(map, i / (Labels - 1)), map)}</li>`).join("");
    return bar;
  }

  function showColors() {
    const chosen = chooseMaps();
    const first = chosen.find(selects);
    // The range is that of the first bar.
    shown = chosen.map((map) => !first || !selects(map) ? map
      : recolor(map, presets[colors.map] || null,
        colors.range && isRange(map, colors.range) && isLike(map, first) ? colors.range : map.range));
    surfaces.setMaps(shown);
    const form = find("#colors");
    const map = shown.find(selects);
    form.high.setCustomValidity("");
    form.array.value = colors.array;
    form.map.value = colors.map;
    find("#bars").hidden = !hasBar || !map;
    find("#bars").replaceChildren(...shown.filter((one, i) => selects(one) &&
      shown.findIndex((other) => selects(other) && isLike(one, other)) === i)
      .slice(0, MaximumBars).map(makeBar).reverse());
    form.low.disabled = form.high.disabled = form.map.disabled = form.data.disabled = !map;
    if (map) {
      [form.low.value, form.high.value] = map.range.map(String);
    }
    redraw();
  }

  function setBackground(/** @type {string} */ color) {
    background = color;
    picture.background = readColor(color);
    document.body.style.setProperty("--background", color);
    const [red, green, blue] = picture.background;
    root.dataset.theme = 0.3 * red + 0.6 * green + 0.1 * blue > 0.5 ? "light" : "dark";
    redraw();
  }

  function addColorControls() {
    const form = find("#colors");
    const option = (/** @type {string} */ value, /** @type {string} */ text) =>
      new Option(text, value);
    form.array.append(option("", names.length > 1 ? "as exported" : names[0]),
      ...(names.length > 1 ? names.map((name) => option(name, name)) : []));
    form.map.append(option("", "as exported"),
      ...Object.keys(presets).map((name) => option(name, name)));
    form.addEventListener("submit", (/** @type {Event} */ event) => event.preventDefault());
    form.addEventListener("change", (/** @type {any} */ event) => {
      const range = numbers([form.low, form.high].map((input) =>
        input.value.replace(",", ".")).join(","));
      const map = /** @type {ColorMap} */ (shown.find(selects) || shown[0]);
      const isRangeChanged = event.target === form.low || event.target === form.high;
      const isValid = !isRangeChanged || isRange(map, range);
      if (colors.array !== form.array.value) {
        colors.range = null; // that of another array
      } else if (isRangeChanged && isValid) {
        colors.range = range;
      }
      colors.array = form.array.value;
      colors.map = form.map.value;
      if (isValid) {
        showColors();
      } else {
        form.high.setCustomValidity(map.logarithmic ? "The range must be of two numbers above 0, " +
          "the smaller one first." : "The range must be of two numbers, the smaller one first.");
        form.high.reportValidity();
      }
    });
    form.data.addEventListener("click", () => {
      colors.range = rangeOfData(geometry, /** @type {ColorMap} */ (shown.find(selects)));
      showColors();
    });
    form.addEventListener("reset", (/** @type {Event} */ event) => {
      event.preventDefault();
      Object.assign(colors, { array: "", map: "", range: null });
      showColors();
    });
  }

  // The address has the view, with the names of the options of cslf render.

  const isFirstView = () => camera.viewAngle === page.camera.viewAngle &&
    ["position", "focalPoint", "viewUp"].every((key) =>
      write(/** @type {any} */ (camera)[key]) === write(page.camera[key]));

  function writeHash() {
    const isFirst = isFirstView();
    const values = { position: !isFirst && write(camera.position),
      "focal-point": !isFirst && write(camera.focalPoint),
      "view-up": !isFirst && write(camera.viewUp), "view-angle": !isFirst && String(camera.viewAngle),
      "color-by": colors.array, "color-map": colors.map, range: colors.range && write(colors.range),
      background: background !== page.background && background };
    const hash = Object.entries(values).filter(([, value]) => value)
      .map(([name, value]) => name + "=" + encodeURIComponent(String(value)).replace(/%2C/g, ","));
    try {
      history.replaceState(null, "", hash.length ? "#" + hash.join("&")
        : location.pathname + location.search);
    } catch (error) {
      // Some browsers limit how often the address changes.
    }
  }

  function readHash() {
    const values = new URLSearchParams(location.hash.slice(1));
    Object.assign(camera, page.camera);
    for (const [name, key] of [["position", "position"], ["focal-point", "focalPoint"],
      ["view-up", "viewUp"]]) {
      const vector = numbers(values.get(name));
      if (vector.length === 3 && vector.every(Number.isFinite)) {
        Object.assign(camera, { [key]: vector });
      }
    }
    const angle = numbers(values.get("view-angle"))[0];
    camera.viewAngle = angle >= 0.01 && angle <= 179 ? angle : page.camera.viewAngle;
    if (!(camera.distance > 0) || camera.viewUp.every((x) => x === 0)) {
      Object.assign(camera, page.camera);
    }
    const range = numbers(values.get("range"));
    const array = values.get("color-by") || "";
    const map = values.get("color-map") || "";
    colors.array = names.length > 1 && names.includes(array) ? array : "";
    colors.map = Object.hasOwn(presets, map) ? map : "";
    colors.range = range.length === 2 && range[0] < range[1] ? range : null;
    const color = values.get("background") || "";
    setBackground(/^#[0-9a-f]{6}$/i.test(color) ? color : page.background);
    showColors();
  }

  // Tools, with the keys that call them.

  const toggle = (/** @type {string} */ selector) => (find(selector).hidden = !find(selector).hidden);
  /** @type {Tool[]} */
  const tools = [
    ["reset", "0", "First view", "M4 10l6-6 6 6M6 9v7h8V9", () => {
      Object.assign(camera, page.camera);
      if (isRotating) {
        find("#tool-rotate").click();
      }
      redraw();
    }],
    ["rotate", "r", "Turn by itself", "M16 7a7 7 0 1 0 1 4M17 3v4h-4", () => {
      isRotating = !isRotating;
      move();
      return isRotating;
    }],
    ["axes", "a", "Axes", "M5 3v12h12M5 15l-3 3M3 5l2-2 2 2M15 13l2 2-2 2", () => {
      hasAxes = !hasAxes;
      find("#axes").style.display = hasAxes ? "" : "none";
      return hasAxes;
    }],
    ...(hasMaps ? /** @type {Tool[]} */ ([
      ["colors", "c", "Colours", "M10 3a7 7 0 1 0 0 14c2 0 1-2 1-3s3-1 4-1a2 2 0 0 0 2-3 7 7 0 0 0-7-7M6 9h0M9 6h0M13 7h0",
        () => !toggle("#colors")],
      ["scalars", "b", "Scalar bar", "M7 2h6v16H7zM7 6h6M7 10h6M7 14h6", () => {
        hasBar = !hasBar;
        find("#bars").hidden = !hasBar || !shown.some(selects);
        return hasBar;
      }]]) : []),
    ["background", "l", "Light or dark", "M10 3a7 7 0 0 0 0 14zM10 3a7 7 0 0 1 0 14", () => {
      const isLight = root.dataset.theme === "light";
      setBackground(
        background === page.background ? Backgrounds[isLight ? 0 : 1] : page.background);
    }],
    ["picture", "p", "Save the picture", "M3 6h3l1-2h6l1 2h3v10H3zM10 8a3 3 0 1 0 0 6 3 3 0 0 0 0-6", () =>
      canvas.toBlob((blob) => {
        const link = document.createElement("a");
        link.href = URL.createObjectURL(/** @type {Blob} */ (blob));
        link.download = (page.title || "picture") + ".png";
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href), 1000);
      })],
    ...(document.fullscreenEnabled ? /** @type {Tool[]} */ ([
      ["full", "f", "Full screen", "M3 7V3h4M13 3h4v4M17 13v4h-4M7 17H3v-4", () => {
        document.fullscreenElement ? document.exitFullscreen() : root.requestFullscreen();
      }]]) : []),
    ["help", "h", "Help", "M10 2a8 8 0 1 0 0 16 8 8 0 0 0 0-16M8 8a2 2 0 1 1 3 2c-1 0-1 1-1 2M10 14h0",
      () => find("#help").showModal()],
  ];
  const isOn = { axes: hasAxes, rotate: false, colors: false, scalars: hasBar };
  for (const [name, key, label, icon, act] of tools) {
    const button = document.createElement("button");
    button.id = "tool-" + name;
    button.type = "button";
    button.title = `${label} (${key})`;
    button.setAttribute("aria-label", label);
    button.setAttribute("aria-keyshortcuts", key);
    button.innerHTML = `<svg viewBox="0 0 20 20" aria-hidden="true"><path d="${icon}"/></svg>`;
    const press = (/** @type {boolean | void} */ state) => {
      if (name in isOn) {
        button.setAttribute("aria-pressed", String(Boolean(state)));
      }
    };
    press(isOn[/** @type {keyof isOn} */ (name)]);
    button.addEventListener("click", () => press(act()));
    find("#tools").append(button);
  }
  document.addEventListener("keydown", (event) => {
    const tool = tools.find(([, key]) => key === event.key.toLowerCase());
    if (event.key === "Escape" && hasMaps && !find("#colors").hidden) {
      find("#tool-colors").click();
    } else if (tool && !isBusy(event) && !event.ctrlKey && !event.altKey && !event.metaKey) {
      find("#tool-" + tool[0]).click();
    }
  });
  find("#help dl").innerHTML = [["Arrows", "turn; with Shift, move"], ["+ −", "zoom"],
    ...tools.map(([, key, label]) => [key.toUpperCase(), label])]
    .map(([key, label]) => `<dt>${key}</dt><dd>${label}</dd>`).join("");
  const count = geometry.batches.reduce((sum, batch) =>
    sum + (batch.corners.length / 3) * batch.bodies, 0);
  find("#facts").textContent = `${count.toLocaleString("en")} triangles, of which each has the ` +
    "light that path tracing found. This page loads nothing else.";
  find("#notes").append(...(page.notes || []).map((/** @type {string} */ note) =>
    Object.assign(document.createElement("li"), { textContent: note })));

  listen(canvas, {
    orbit: (x, y) => (camera.orbit(-x * Math.PI, -y * Math.PI), move()),
    pan: (x, y) => (camera.pan(x, y), move()),
    zoom: (factor) => (camera.zoom(factor), move()),
  });
  addColorControls();
  new ResizeObserver(resize).observe(canvas);
  window.addEventListener("hashchange", readHash);
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    fail("The picture stays still until the graphics device is back.");
  });
  canvas.addEventListener("webglcontextrestored", () => location.reload());
  resize();
  readHash();
}

async function start() {
  const canvas = find("#canvas");
  const gl = canvas.getContext("webgl2", { alpha: false, antialias: false, depth: false,
    preserveDrawingBuffer: true, powerPreference: "high-performance" });
  const fail = (/** @type {string} */ text) => {
    root.dataset.state = "failed";
    delete root.dataset.drawn;
    find("#tools").hidden = true;
    find("#message").hidden = false;
    find("#message").textContent = text;
  };
  if (!gl) {
    fail("The picture stays still, because this browser has no WebGL 2.");
    return;
  }
  try {
    show(await readData(), gl, fail);
  } catch (error) {
    fail("The picture stays still, because the data of this page cannot be read: " +
      `${error instanceof Error ? error.message : error}.`);
  }
}
start();
