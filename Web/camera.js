// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// A camera as VTK's, in world coordinates, and what moves it.

/** @typedef {number[]} Vector */

/** @param {Vector} a @param {Vector} b @param {number} [factor] */
export const add = (a, b, factor = 1) => a.map((x, i) => x + factor * b[i]);
/** @param {Vector} a @param {Vector} b */
export const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
/** @param {Vector} a @param {Vector} b */
export const cross = (a, b) => [0, 1, 2].map((i) =>
  a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
/** @param {Vector} a */
export const length = (a) => Math.hypot(...a);
/** @param {Vector} a */
export const normalize = (a) => a.map((x) => x / (length(a) || 1));

/** A vector turned about an axis of unit length. */
function turn(/** @type {Vector} */ v, /** @type {Vector} */ axis, /** @type {number} */ angle) {
  const along = axis.map((x) => x * dot(axis, v) * (1 - Math.cos(angle)));
  return add(add(v.map((x) => x * Math.cos(angle)), cross(axis, v), Math.sin(angle)), along);
}

const Steepest = 0.999; // the cosine between the view and its up, beyond which it does not tilt

export class Camera {
  /** @param {{position: Vector, focalPoint: Vector, viewUp: Vector, viewAngle: number}} view */
  constructor(view) {
    this.position = view.position;
    this.focalPoint = view.focalPoint;
    this.viewUp = view.viewUp;
    this.viewAngle = view.viewAngle; // along the smaller side of the picture, in degrees
  }

  get distance() {
    return length(add(this.position, this.focalPoint, -1));
  }

  /** Right, up and towards the eye, of unit length. */
  get axes() {
    const back = normalize(add(this.position, this.focalPoint, -1));
    let right = cross(this.viewUp, back);
    if (length(right) < 1e-6 * length(this.viewUp)) {
      right = cross(Math.abs(back[2]) < 0.9 ? [0, 0, 1] : [0, 1, 0], back);
    }
    right = normalize(right);
    return [right, cross(back, right), back];
  }

  /**
   * The tangents of half of the angles that a picture of this shape shows.
   * @param {number} aspect
   */
  extent(aspect) {
    const tangent = Math.tan((this.viewAngle * Math.PI) / 360);
    return aspect > 1 ? [tangent * aspect, tangent] : [tangent, tangent / aspect];
  }

  /**
   * From the world to clip coordinates.
   * @param {number} aspect @param {Vector} center of a sphere around all @param {number} radius
   * @param {number} x @param {number} y by what the picture is shifted, in clip coordinates
   */
  matrix(aspect, center, radius, x = 0, y = 0) {
    const [right, up, back] = this.axes;
    const eye = this.position;
    const view = new DOMMatrix([right[0], up[0], back[0], 0, right[1], up[1], back[1], 0,
      right[2], up[2], back[2], 0, -dot(right, eye), -dot(up, eye), -dot(back, eye), 1]);
    const middle = dot(back, add(eye, center, -1));
    const far = Math.max(middle + 1.01 * radius, 1e-6 * radius);
    const near = Math.max(middle - 1.01 * radius, 0.001 * far);
    const [width, height] = this.extent(aspect);
    const projection = new DOMMatrix([1 / width, 0, 0, 0, 0, 1 / height, 0, 0,
      -x, -y, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0]);
    return projection.multiply(view);
  }

  /**
   * Turns the view about the focal point.
   * @param {number} across @param {number} along in radians
   */
  orbit(across, along) {
    const [right] = this.axes;
    const axis = normalize(this.viewUp);
    const back = add(this.position, this.focalPoint, -1);
    const tilted = turn(back, right, along);
    const isSteep = Math.abs(dot(axis, normalize(tilted))) > Steepest;
    this.position = add(this.focalPoint, turn(isSteep ? back : tilted, axis, across));
  }

  /**
   * By shares of the picture's smaller side.
   * @param {number} x @param {number} y
   */
  pan(x, y) {
    const [right, up] = this.axes;
    const size = 2 * this.distance * Math.tan((this.viewAngle * Math.PI) / 360);
    const way = add(right.map((r) => -x * size * r), up, -y * size);
    this.position = add(this.position, way);
    this.focalPoint = add(this.focalPoint, way);
  }

  /** @param {number} factor of the distance */
  zoom(factor) {
    this.position = add(this.focalPoint, add(this.position, this.focalPoint, -1), factor);
  }
}

/**
 * Whether a text, a list or an open dialog gets the key.
 * @param {KeyboardEvent} event
 */
export const isBusy = (event) => /** @type {HTMLElement} */ (event.target)
  .matches("input, select") || document.querySelector("dialog[open]") !== null;

/**
 * Lets a pointer and fingers on an element, and keys anywhere but in texts and lists, move what
 * `act` moves: turns, pans and zooms.
 * @param {HTMLElement} element
 * @param {{orbit: (x: number, y: number) => void, pan: (x: number, y: number) => void,
 *   zoom: (factor: number) => void}} act x and y are shares of the element's smaller side
 */
export function listen(element, act) {
  /** @type {Map<number, number[]>} */
  const pointers = new Map();
  const size = () => Math.min(element.clientWidth, element.clientHeight) || 1;
  element.addEventListener("pointerdown", (event) => {
    element.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
  });
  element.addEventListener("pointermove", (event) => {
    const from = pointers.get(event.pointerId);
    if (!from) {
      return;
    }
    const to = [event.clientX, event.clientY];
    const others = [...pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
    pointers.set(event.pointerId, to);
    const [x, y] = add(to, from, -1).map((way) => way / size());
    if (others.length === 0 && event.buttons === 1 && !event.shiftKey) {
      act.orbit(x, y);
    } else if (others.length === 0) {
      act.pan(x, -y);
    } else {
      act.zoom(length(add(from, others[0], -1)) / Math.max(length(add(to, others[0], -1)), 1));
      act.pan(x / 2, -y / 2);
    }
  });
  for (const kind of ["pointerup", "pointercancel"]) {
    element.addEventListener(kind, (event) =>
      pointers.delete(/** @type {PointerEvent} */ (event).pointerId));
  }
  element.addEventListener("contextmenu", (event) => event.preventDefault());
  element.addEventListener("wheel", (event) => {
    event.preventDefault();
    act.zoom(Math.exp(event.deltaY * (event.deltaMode ? 0.05 : 0.001)));
  }, { passive: false });
  document.addEventListener("keydown", (event) => {
    const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const way = ways[/** @type {keyof ways} */ (event.key)];
    if (event.ctrlKey || event.altKey || event.metaKey || isBusy(event)) {
      return;
    }
    if (way && event.shiftKey) {
      act.pan(0.04 * way[0], -0.04 * way[1]);
    } else if (way) {
      act.orbit(0.04 * way[0], 0.04 * way[1]);
    } else if (["+", "=", "-"].includes(event.key)) {
      act.zoom(event.key === "-" ? 1.1 : 1 / 1.1);
    } else {
      return;
    }
    event.preventDefault();
  });
}
