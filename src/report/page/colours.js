// SPDX-License-Identifier: GPL-2.0-or-later
// Colours that mean something. The scale runs from dark blue by green to pale yellow with lightness growing evenly, so
// that it reads the same with any colour vision and in grey.

let scale = [[128, 128, 128]];
// The program's own, from dark to pale: see report/drawing.hpp.
export function useScale(colours) { scale = colours; }

export const kInverted = [208, 28, 139];   // magenta: an element that is turned over
export const kUndefined = [150, 150, 150];  // the figure is not defined for the element

// The colour of t in [0, 1] as [r, g, b].
export const onScale = (t) => scale[Math.min(scale.length - 1, Math.max(0, Math.round(t * (scale.length - 1))))];
export const css = ([r, g, b]) => `rgb(${r}, ${g}, ${b})`;
// As a pixel of an ImageData seen through a Uint32Array.
export const pixel = ([r, g, b]) => (0xff000000 | (b << 16) | (g << 8) | r) >>> 0;

export const kFigures = {
  scaled_jacobian: {name: "scaled Jacobian", about: "sine of the worst corner: 1 for a rectangle, 0 for a straight corner"},
  eta: {name: "eta", about: "1 where all corners are right angles, 0 where one is straight; of quads"},
  thesis_metric: {name: "thesis metric", about: "1 for a square (quads) or equal sides (triangles), under 0 if inverted"},
  size: {name: "size", about: "mean length of the element's edges, in the model's unit", logarithmic: true},
};

// A figure's values on the scale. `range` is [low, high]; beyond it the ends' colours are taken.
export class Colouring {
  constructor(key, range) {
    this.key = key;
    this.range = range;
  }
  position(value) {
    const [low, high] = this.range;
    const t = kFigures[this.key].logarithmic ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
    return Number.isFinite(t) ? t : 1;
  }
  // The inverse: for the legend's ticks.
  value(t) {
    const [low, high] = this.range;
    return kFigures[this.key].logarithmic ? low * (high / low) ** t : low + t * (high - low);
  }
  colour(value) {
    if (Number.isNaN(value)) return kUndefined;
    if (!kFigures[this.key].logarithmic && value <= 0) return kInverted;
    return onScale(this.position(value));
  }
}

// One pixel value a face; 0 for faces that are not shown.
export function facePixels(mesh, colouring, plain) {
  const pixels = new Uint32Array(mesh.faceCount);
  const values = colouring && mesh.figures[colouring.key];
  const plainPixel = pixel(plain);
  for (let f = 0; f < mesh.faceCount; ++f)
    if (mesh.shown[f]) pixels[f] = colouring ? pixel(colouring.colour(values[f])) : plainPixel;
  return pixels;
}

// What `share` of the sorted values are below.
export function quantile(sorted, share) {
  return sorted.length ? sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] : 0;
}
