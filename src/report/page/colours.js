// Colours that mean something. The scale runs from dark blue by green to pale yellow with lightness growing evenly, so
// that it reads the same with any colour vision and in grey.

// From OKLCH (lightness, chroma, hue in degrees) to sRGB bytes; see B. Ottosson, "A perceptual color space", 2020.
function fromOklch(lightness, chroma, hue) {
  const a = chroma * Math.cos((hue * Math.PI) / 180), b = chroma * Math.sin((hue * Math.PI) / 180);
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const linear = [4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                  -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                  -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s];
  return linear.map((v) => {
    const c = Math.min(Math.max(v, 0), 1);
    return Math.round(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055));
  });
}

const kShades = 256;
const scale = Array.from({length: kShades}, (_, i) => {
  const t = i / (kShades - 1);
  return fromOklch(0.27 + 0.69 * t, 0.055 + 0.32 * t * (1 - t), 275 - 175 * t);
});

export const kInverted = [208, 28, 139];   // magenta: an element that is turned over
export const kUndefined = [150, 150, 150];  // the figure is not defined for the element

// The colour of t in [0, 1] as [r, g, b].
export const onScale = (t) => scale[Math.min(kShades - 1, Math.max(0, Math.round(t * (kShades - 1))))];
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
