// SPDX-License-Identifier: GPL-2.0-or-later
// What the pane of the film shows: triangles, quads, the front by level and state, the step's own quad and base edge.

import {strokeSegments, faceSides} from "./lines.js";
import {DepthBuffer} from "./depth_buffer.js";
import {fillFaces, fillFacesInSpace} from "./raster.js";
import {pixel} from "./colours.js";
import {themeColour} from "./theme.js";
import {rgbOf, groupColour} from "./report_painter.js";

const kLeastFilmSide = 4, kFullFilmSide = 12;
export const kLevels = 6;  // then colours begin anew

export const levelColour = (level) => groupColour(level % kLevels);
// Edges with more corners are chosen first and drawn thicker. In CSS pixels.
export const kStateWidths = [2, 4, 6.5];

export class FilmPainter {
  constructor(film) {
    this.film = film;
    this.buffer = film.depth ? new DepthBuffer() : null;
  }
  background() { return themeColour("pane"); }

  paint(ctx, image, view) {
    const {film, buffer} = this, pixels = new Uint32Array(image.data.buffer);
    film.update();
    pixels.fill(pixel(rgbOf("pane")));
    const triangle = pixel(rgbOf("triangle")), quad = pixel(rgbOf("quad")), fresh = pixel(rgbOf("fresh"));
    if (this.colours?.length !== film.faceCount) this.colours = new Uint32Array(film.faceCount);
    for (let f = 0; f < film.faceCount; ++f)
      this.colours[f] = film.corners[4 * f] < 0 ? 0 : film.corners[4 * f + 3] < 0 ? triangle : film.quadStep[f] === film.step - 1 ? fresh : quad;
    const drawn = buffer ? fillFacesInSpace(pixels, film, view, this.colours, buffer.begin(view)) : fillFaces(pixels, film, view, this.colours);
    this.painted = view;
    ctx.putImageData(image, 0, 0);
    const size = Math.sqrt(drawn.area / Math.max(1, drawn.faces)) / view.ratio;
    const strength = Math.min(1, (size - kLeastFilmSide) / (kFullFilmSide - kLeastFilmSide));
    if (strength > 0 && !view.draft) {
      ctx.globalAlpha = strength;
      const {corners} = film, once = buffer && new Set(), seen = buffer?.seenFaces(film.faceCount);
      const quads = faceSides(film, view, (f) => corners[4 * f + 3] >= 0 && (!seen || seen[f] === 1), once);
      const triangles = faceSides(film, view, (f) => corners[4 * f] >= 0 && corners[4 * f + 3] < 0 && (!seen || seen[f] === 1), once);
      strokeSegments(ctx, film, view, triangles, themeColour("triangle-line"), 0.6 * view.ratio, buffer);
      strokeSegments(ctx, film, view, quads, themeColour("quad-line"), 0.9 * view.ratio, buffer);
      ctx.globalAlpha = 1;
    }
    strokeSegments(ctx, film, view, film.boundary, themeColour("curve"), 1.2 * view.ratio, buffer);
    this.paintFront(ctx, view, Math.min(1, Math.max(0.6, size / 12)));
  }

  paintFront(ctx, view, thickness) {
    const groups = new Map();
    for (const edge of this.film.front()) {
      const key = `${edge.level % kLevels} ${edge.corners}`;
      if (!groups.has(key)) groups.set(key, []);
      groups.get(key).push(edge.a, edge.b);
    }
    for (const [key, segments] of [...groups].sort()) {
      const [level, corners] = key.split(" ").map(Number);
      strokeSegments(ctx, this.film, view, segments, levelColour(level), kStateWidths[corners] * thickness * view.ratio, this.buffer);
    }
  }

  // The base edge of the step that was taken, as it is now.
  overlay(ctx, view) {
    if (this.film.step === 0) return;
    this.film.update();
    const {base} = this.film.describe(this.film.step - 1);
    ctx.globalAlpha = this.isHidden(base) ? 0.3 : 1;
    strokeSegments(ctx, this.film, view, base, themeColour("curve"), 3.5 * view.ratio);
    ctx.globalAlpha = 1;
  }
  // Is the middle of an edge behind others, in the picture that was painted last?
  isHidden([a, b]) {
    const {film, buffer, painted} = this;
    if (!buffer || !painted) return false;
    const x = (film.xy[2 * a] + film.xy[2 * b]) / 2, y = (film.xy[2 * a + 1] + film.xy[2 * b + 1]) / 2;
    return !buffer.sees(painted.k * x + painted.ox, painted.oy - painted.k * y, (painted.k * (film.depth[a] + film.depth[b])) / 2);
  }
}
