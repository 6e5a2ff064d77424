// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// The picture of a view: a still one becomes the mean light of several pictures whose rays go
// through different places of the pixels, as Rendering/Shaders/cslfMeanFS.glsl has it.

import { Encoding, makeProgram } from "./surfaces.js";

const StillPictures = 20;
const SetShiftX = 0.2;
const SetShiftY = 0.4;
const SlowFrame = 60; // milliseconds, above which a moving view gets fewer pixels
const FastFrame = 40; // below which it gets more
const MinimumShare = 0.35; // of the pixels along each side

const Corners = `#version 300 es
void main()
{
  gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0);
}`;

const Sum = `#version 300 es
precision highp float;
uniform sampler2D image;
out vec4 shown;
void main()
{
  shown = min(texelFetch(image, ivec2(gl_FragCoord.xy), 0), 60.0);
}`;

const Show = `#version 300 es
precision highp float;
uniform sampler2D image;
uniform vec2 scale;
uniform float pictures; // in the sum
uniform vec3 background;
out vec4 shown;
${Encoding}
void main()
{
  vec4 sum = textureLod(image, gl_FragCoord.xy * scale, 0.0);
  float alpha = sum.a / max(pictures, 1.0);
  vec3 linear = clamp(sum.rgb / max(sum.a, 0.001), 0.0, 1.0);
  shown = vec4(mix(background, RayFromLinear(linear), alpha), 1.0);
}`;

/**
 * By how much a still view is shifted, in pixels, for a ray of each pixel, so that rays go through
 * the places that Rendering/cslfLookupPicture.cxx has: sets of one ray for each quarter of a pixel.
 */
function shiftOf(/** @type {number} */ ray) {
  const set = ray >> 2;
  return [SetShiftX, SetShiftY].map((share, axis) => {
    const quarter = axis ? (ray & 1) ^ ((ray >> 1) & 1) : ray & 1;
    return (share * set - Math.round(share * set)) / 2 + (quarter ? -0.25 : 0.25);
  });
}

export class Picture {
  /** @param {WebGL2RenderingContext} gl @param {(aspect: number, x: number, y: number) => void} draw */
  constructor(gl, draw) {
    this.gl = gl;
    this.drawSurfaces = draw;
    this.hasLight = Boolean(gl.getExtension("EXT_color_buffer_float") ||
      gl.getExtension("EXT_color_buffer_half_float"));
    gl.getExtension("OES_texture_half_float_linear");
    this.sum = makeProgram(gl, Corners, Sum);
    this.show = makeProgram(gl, Corners, Show);
    this.empty = gl.createVertexArray();
    this.frames = [gl.createFramebuffer(), gl.createFramebuffer()];
    /** @type {(WebGLTexture | null)[]} */
    this.images = [null, null];
    this.depth = gl.createRenderbuffer();
    this.width = 0;
    this.height = 0;
    this.pictures = 0; // in the sum
    this.share = 1; // of the pixels along each side that a moving view has
    this.background = [0, 0, 0];
  }

  /** Whether a still view cannot become better. */
  get isComplete() {
    return this.pictures >= (this.hasLight ? StillPictures : 1);
  }

  /** Forgets the pictures of another view. */
  reset() {
    this.pictures = 0;
  }

  allocate() {
    const { gl } = this;
    const { width, height } = gl.canvas;
    if (width === this.width && height === this.height) {
      return;
    }
    this.width = width;
    this.height = height;
    this.pictures = 0;
    gl.bindRenderbuffer(gl.RENDERBUFFER, this.depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
    this.images = this.images.map((image, i) => {
      gl.deleteTexture(image);
      const texture = gl.createTexture();
      gl.activeTexture(gl.TEXTURE0);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texStorage2D(gl.TEXTURE_2D, 1, this.hasLight ? gl.RGBA16F : gl.RGBA8, width, height);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.frames[i]);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
      return texture;
    });
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frames[0]);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, this.depth);
  }

  /**
   * Chooses how many pixels a moving view gets.
   * @param {number} milliseconds of its last picture
   */
  adapt(milliseconds) {
    if (milliseconds > SlowFrame) {
      this.share = Math.max(MinimumShare, this.share * 0.8);
    } else if (milliseconds < FastFrame) {
      this.share = Math.min(1, this.share * 1.1);
    }
  }

  /** @param {ReturnType<typeof makeProgram>} pass @param {WebGLTexture | null} image */
  drawPass(pass, image) {
    const { gl } = this;
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.CULL_FACE);
    gl.useProgram(pass.program);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, image);
    gl.uniform1i(pass.uniforms.image, 0);
    gl.bindVertexArray(this.empty);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  /**
   * Draws one more picture of a view, and shows all.
   * @param {boolean} isMoving
   */
  draw(isMoving) {
    const { gl } = this;
    this.allocate();
    const share = isMoving ? this.share : 1;
    const width = Math.max(1, Math.round(share * this.width));
    const height = Math.max(1, Math.round(share * this.height));
    const [x, y] = isMoving || !this.hasLight ? [0, 0] : shiftOf(this.pictures);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frames[0]);
    gl.viewport(0, 0, width, height);
    this.drawSurfaces(this.width / this.height, (2 * x) / width, (2 * y) / height);
    let shown = this.images[0];
    if (!isMoving && this.hasLight) {
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.frames[1]);
      if (this.pictures === 0) {
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT);
      }
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.ONE, gl.ONE);
      this.drawPass(this.sum, this.images[0]);
      gl.disable(gl.BLEND);
      shown = this.images[1];
    }
    this.pictures = isMoving ? 0 : this.pictures + 1;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, this.width, this.height);
    gl.useProgram(this.show.program);
    gl.uniform1f(this.show.uniforms.pictures, this.hasLight ? this.pictures : 1);
    gl.uniform2f(this.show.uniforms.scale, width / this.width ** 2, height / this.height ** 2);
    gl.uniform3fv(this.show.uniforms.background, this.background);
    this.drawPass(this.show, shown);
  }
}
