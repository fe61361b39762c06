// SPDX-License-Identifier: GPL-2.0-or-later
// What a pane of the report shows: faces by colour, their sides, curves and boundary, points, irregular nodes, what is
// chosen.

import {strokeSegments, faceSides, polygonPath} from "./lines.js";
import {DepthBuffer} from "./depth_buffer.js";
import {fillFaces, fillFacesInSpace} from "./raster.js";
import {facePixels, pixel} from "./colours.js";
import {themeColour, isDark} from "./theme.js";

// Below these sizes of elements, in CSS pixels, sides and marks would cover everything.
const kLeastSidePixels = 4, kFullSidePixels = 14, kLeastMarkPixels = 2.2;

// Colours of marks differ in lightness too, and shapes differ: three edges: triangle, five: pentagon, others: disc.
export const kMarks = {3: {sides: 3, colour: "#e8590c", size: 1.25}, 5: {sides: 5, colour: "#1c5fd4", size: 1},
                       0: {sides: 16, colour: "#111111", size: 0.95}};

// A colour of the style sheet as [r, g, b].
export function rgbOf(name) {
  const hex = themeColour(name);
  return [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
}

export class ReportPainter {
  // `settings`: {colouring or null, sides, irregular, boundary, groups: Set of indices, selected: face or -1}
  constructor(mesh, settings) {
    this.mesh = mesh;
    this.settings = settings;
    this.buffer = mesh.depth ? new DepthBuffer() : null;
  }
  background() { return themeColour("pane"); }

  // To be called when colours or what is shown have changed.
  refresh() { this.pixels = null; }

  paint(ctx, image, view) {
    const {mesh, settings} = this;
    mesh.update();
    this.pixels ??= facePixels(mesh, settings.colouring, rgbOf("plain"));
    const pixels = new Uint32Array(image.data.buffer);
    pixels.fill(pixel(rgbOf("pane")));
    const drawn = this.buffer ? fillFacesInSpace(pixels, mesh, view, this.pixels, this.buffer.begin(view))
                              : fillFaces(pixels, mesh, view, this.pixels);
    this.painted = view;
    ctx.putImageData(image, 0, 0);
    this.elementPixels = Math.sqrt(drawn.area / Math.max(drawn.faces, 1)) / view.ratio;
    if (!view.draft) this.paintSides(ctx, view);
    this.paintCurves(ctx, view);
    if (!view.draft) this.paintMarks(ctx, view);
  }

  paintSides(ctx, view) {
    const {mesh, settings, buffer} = this;
    const strength = Math.min(1, (this.elementPixels - kLeastSidePixels) / (kFullSidePixels - kLeastSidePixels));
    if (!settings.sides || strength <= 0) return;
    const seen = buffer ? buffer.seenFaces(mesh.faceCount) : mesh.shown;
    const segments = faceSides(mesh, view, (f) => seen[f] === 1, buffer && new Set());
    strokeSegments(ctx, mesh, view, segments, `rgba(0, 0, 0, ${(0.62 * strength).toFixed(3)})`, 0.8 * view.ratio, buffer);
  }

  paintCurves(ctx, view) {
    const {mesh, settings, buffer} = this;
    const ink = themeColour("curve"), width = Math.min(2.4, Math.max(1.1, 0.2 * this.elementPixels)) * view.ratio;
    if (settings.boundary) {
      // White on dark panes: with a dark rim it can be seen on pale elements, too.
      if (isDark())
        for (const list of [mesh.openEdges, mesh.lines])
          strokeSegments(ctx, mesh, view, list, "#000000", width + 2 * view.ratio, buffer);
      strokeSegments(ctx, mesh, view, mesh.openEdges, ink, width, buffer);
      strokeSegments(ctx, mesh, view, mesh.lines, ink, width, buffer);
      ctx.fillStyle = ink;
      for (const v of mesh.dots) this.paintDot(ctx, view, v, 1.1 * width);
    }
    for (const group of settings.groups) {
      if (mesh.groups[group]?.dim === 1)
        for (const curve of mesh.curves.filter((c) => c.groups.includes(group)))
          strokeSegments(ctx, mesh, view, mesh.lines.subarray(2 * curve.first, 2 * (curve.first + curve.count)),
                         groupColour(group), Math.max(3.2 * view.ratio, 1.8 * width), buffer);
    }
  }

  paintDot(ctx, view, v, radius) {
    const {xy} = this.mesh, x = view.k * xy[2 * v] + view.ox, y = view.oy - view.k * xy[2 * v + 1];
    if (!this.sees(view, x, y, v)) return;
    ctx.beginPath();
    ctx.arc(x, y, radius, 0, 2 * Math.PI);
    ctx.fill();
  }

  paintMarks(ctx, view) {
    const {mesh, settings} = this;
    if (!settings.irregular || this.elementPixels < kLeastMarkPixels) return;
    const radius = Math.min(7, Math.max(1.6, 0.26 * this.elementPixels)) * view.ratio;
    ctx.strokeStyle = "#ffffff";
    ctx.lineWidth = radius > 3 * view.ratio ? view.ratio : 0.5 * view.ratio;
    for (const [kind, mark] of Object.entries(kMarks)) {
      ctx.fillStyle = mark.colour;
      for (let i = 0; i < mesh.irregular.length; ++i) {
        const valence = mesh.valences[i], v = mesh.irregular[i];
        if (String(valence in kMarks ? valence : 0) !== kind || !this.isNodeShown(v)) continue;
        const x = view.k * mesh.xy[2 * v] + view.ox, y = view.oy - view.k * mesh.xy[2 * v + 1];
        if (x < 0 || y < 0 || x > view.width || y > view.height) continue;
        if (!this.sees(view, x, y, v)) continue;
        ctx.beginPath();
        polygonPath(ctx, x, y, radius * mark.size, mark.sides);
        ctx.fill();
        ctx.stroke();
      }
    }
  }

  sees(view, x, y, v) { return !this.buffer || this.buffer.sees(x, y, view.k * this.mesh.depth[v]); }
  isNodeShown(v) {
    if (!this.hiddenNodes) return true;
    return !this.hiddenNodes[v];
  }
  // Nodes of faces that are not shown have no marks.
  noteShown() {
    const {mesh} = this;
    this.hiddenNodes = mesh.shown.includes(0) ? new Uint8Array(mesh.nodeCount).fill(1) : null;
    if (this.hiddenNodes)
      for (let f = 0; f < mesh.faceCount; ++f)
        if (mesh.shown[f]) for (const v of mesh.nodesOf(f)) this.hiddenNodes[v] = 0;
    this.refresh();
  }

  // Drawn at every frame, above the kept picture.
  overlay(ctx, view) {
    const {mesh, settings} = this;
    if (settings.selected < 0 || settings.selectedMesh !== mesh) return;
    ctx.globalAlpha = this.isHidden(settings.selected) ? 0.35 : 1;
    ctx.beginPath();
    mesh.nodesOf(settings.selected).forEach((v, i) => {
      const x = view.k * mesh.xy[2 * v] + view.ox, y = view.oy - view.k * mesh.xy[2 * v + 1];
      if (i === 0) ctx.moveTo(x, y);
      else ctx.lineTo(x, y);
    });
    ctx.closePath();
    ctx.lineJoin = "round";
    for (const [style, width] of [["#ffffff", 6], [isDark() ? "#ff4fa3" : "#c2107a", 3]]) {
      ctx.strokeStyle = style;
      ctx.lineWidth = width * view.ratio;
      ctx.stroke();
    }
    ctx.globalAlpha = 1;
  }
  // Is the middle of a face behind others, in the picture that was painted last?
  isHidden(face) {
    const {mesh, buffer, painted} = this;
    if (!buffer || !painted) return false;
    const nodes = mesh.nodesOf(face), mean = (of) => nodes.reduce((sum, v) => sum + of(v), 0) / nodes.length;
    return !buffer.sees(mean((v) => painted.k * mesh.xy[2 * v] + painted.ox), mean((v) => painted.oy - painted.k * mesh.xy[2 * v + 1]),
                        mean((v) => painted.k * mesh.depth[v]));
  }
}

// Colours for physical groups: Okabe and Ito's, which any colour vision tells apart.
const kGroupColours = ["#d55e00", "#0072b2", "#cc79a7", "#009e73", "#e69f00", "#56b4e9"];
export const groupColour = (index) => kGroupColours[index % kGroupColours.length];
