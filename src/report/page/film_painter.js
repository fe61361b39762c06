// SPDX-License-Identifier: GPL-2.0-or-later
// What the pane of the film shows: triangles, quads, the front by level and state, the step's own quad and base edge.

import {strokeSegments, faceSides} from "./lines.js";
import {fillFaces} from "./raster.js";
import {pixel} from "./colours.js";
import {themeColour} from "./theme.js";
import {rgbOf, groupColour} from "./report_painter.js";

const kLeastFilmSide = 4, kFullFilmSide = 12;
export const kLevels = 6;  // then colours begin anew

export const levelColour = (level) => groupColour(level % kLevels);
// Edges with more corners are chosen first and drawn thicker. In CSS pixels.
export const kStateWidths = [2, 4, 6.5];

export class FilmPainter {
  constructor(film) { this.film = film; }
  background() { return themeColour("pane"); }

  paint(ctx, image, view) {
    const {film} = this, pixels = new Uint32Array(image.data.buffer);
    pixels.fill(pixel(rgbOf("pane")));
    const triangle = pixel(rgbOf("triangle")), quad = pixel(rgbOf("quad")), fresh = pixel(rgbOf("fresh"));
    if (this.colours?.length !== film.faceCount) this.colours = new Uint32Array(film.faceCount);
    for (let f = 0; f < film.faceCount; ++f)
      this.colours[f] = film.corners[4 * f] < 0 ? 0 : film.corners[4 * f + 3] < 0 ? triangle : film.quadStep[f] === film.step - 1 ? fresh : quad;
    const drawn = fillFaces(pixels, film, view, this.colours, null);
    ctx.putImageData(image, 0, 0);
    const size = Math.sqrt(drawn.area / Math.max(1, drawn.faces)) / view.ratio;
    const strength = Math.min(1, (size - kLeastFilmSide) / (kFullFilmSide - kLeastFilmSide));
    if (strength > 0 && !view.draft) {
      ctx.globalAlpha = strength;
      const {corners} = film;
      strokeSegments(ctx, film, view, faceSides(film, view, (f) => corners[4 * f] >= 0 && corners[4 * f + 3] < 0), themeColour("triangle-line"), 0.6 * view.ratio);
      strokeSegments(ctx, film, view, faceSides(film, view, (f) => corners[4 * f + 3] >= 0), themeColour("quad-line"), 0.9 * view.ratio);
      ctx.globalAlpha = 1;
    }
    strokeSegments(ctx, film, view, film.boundary, themeColour("curve"), 1.2 * view.ratio);
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
      strokeSegments(ctx, this.film, view, segments, levelColour(level), kStateWidths[corners] * thickness * view.ratio);
    }
  }

  // The base edge of the step that was taken, as it is now.
  overlay(ctx, view) {
    if (this.film.step === 0) return;
    const {base} = this.film.describe(this.film.step - 1);
    strokeSegments(ctx, this.film, view, base, themeColour("curve"), 3.5 * view.ratio);
  }
}
