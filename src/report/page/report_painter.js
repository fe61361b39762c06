// SPDX-License-Identifier: GPL-2.0-or-later
// What a pane of the report shows: faces by colour, their sides, curves and boundary, points, irregular nodes, what is
// chosen.

import {strokeSegments, faceSides, polygonPath} from "./lines.js";
import {fillFaces} from "./raster.js";
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
  }
  background() { return themeColour("pane"); }

  // To be called when colours or what is shown have changed.
  refresh() { this.pixels = null; }

  paint(ctx, image, view) {
    const {mesh, settings} = this;
    this.pixels ??= facePixels(mesh, settings.colouring, rgbOf("plain"));
    const pixels = new Uint32Array(image.data.buffer);
    pixels.fill(pixel(rgbOf("pane")));
    if (mesh.depth) {
      if (this.ids?.length !== pixels.length) this.ids = new Int32Array(pixels.length);
      this.ids.fill(-1);
    }
    const drawn = fillFaces(pixels, mesh, view, this.pixels, mesh.depth ? this.ids : null);
    ctx.putImageData(image, 0, 0);
    this.elementPixels = Math.sqrt(drawn.area / Math.max(drawn.faces, 1)) / view.ratio;
    if (!view.draft) this.paintSides(ctx, view);
    this.paintCurves(ctx, view);
    if (!view.draft) this.paintMarks(ctx, view);
  }

  // In space: is nothing in front of a node-sized thing at (x, y)?
  inFront(view, x, y, depth) {
    if (!this.mesh.depth) return true;
    const px = Math.floor(x), py = Math.floor(y);
    if (px < 0 || py < 0 || px >= view.width || py >= view.height) return false;
    const f = this.ids[py * view.width + px];
    return f < 0 || depth >= this.mesh.faceDepth[f] - 0.8 * this.mesh.figures.size[f];
  }

  paintSides(ctx, view) {
    const {mesh, settings} = this;
    const strength = Math.min(1, (this.elementPixels - kLeastSidePixels) / (kFullSidePixels - kLeastSidePixels));
    if (!settings.sides || strength <= 0) return;
    let accept = (f) => mesh.shown[f] === 1;
    if (mesh.depth) {
      const seen = new Uint8Array(mesh.faceCount);
      for (const f of this.ids) if (f >= 0) seen[f] = 1;
      accept = (f) => seen[f] === 1;
    }
    const segments = faceSides(mesh, view, accept);
    const wanted = this.depthTest(segments, view);
    strokeSegments(ctx, mesh, view, segments, `rgba(0, 0, 0, ${(0.62 * strength).toFixed(3)})`, 0.8 * view.ratio, wanted);
  }

  depthTest(segments, view) {
    const {mesh} = this;
    return mesh.depth && ((i, x, y) =>
      this.inFront(view, x, y, (mesh.depth[segments[2 * i]] + mesh.depth[segments[2 * i + 1]]) / 2));
  }

  paintCurves(ctx, view) {
    const {mesh, settings} = this;
    const ink = themeColour("curve"), width = Math.min(2.4, Math.max(1.1, 0.2 * this.elementPixels)) * view.ratio;
    if (settings.boundary) {
      // White on dark panes: with a dark rim it can be seen on pale elements, too.
      if (isDark())
        for (const list of [mesh.openEdges, mesh.lines])
          strokeSegments(ctx, mesh, view, list, "#000000", width + 2 * view.ratio, this.depthTest(list, view));
      strokeSegments(ctx, mesh, view, mesh.openEdges, ink, width, this.depthTest(mesh.openEdges, view));
      strokeSegments(ctx, mesh, view, mesh.lines, ink, width, this.depthTest(mesh.lines, view));
      ctx.fillStyle = ink;
      for (const v of mesh.dots) this.paintDot(ctx, view, v, 1.1 * width);
    }
    for (const group of settings.groups) {
      if (mesh.groups[group]?.dim === 1)
        for (const curve of mesh.curves.filter((c) => c.groups.includes(group)))
          strokeSegments(ctx, mesh, view, mesh.lines.subarray(2 * curve.first, 2 * (curve.first + curve.count)),
                         groupColour(group), Math.max(3.2 * view.ratio, 1.8 * width));
    }
  }

  paintDot(ctx, view, v, radius) {
    const {xy} = this.mesh;
    ctx.beginPath();
    ctx.arc(view.k * xy[2 * v] + view.ox, view.oy - view.k * xy[2 * v + 1], radius, 0, 2 * Math.PI);
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
        if (mesh.depth && !this.inFront(view, x, y, mesh.depth[v])) continue;
        ctx.beginPath();
        polygonPath(ctx, x, y, radius * mark.size, mark.sides);
        ctx.fill();
        ctx.stroke();
      }
    }
  }

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
  }
}

// Colours for physical groups: Okabe and Ito's, which any colour vision tells apart.
const kGroupColours = ["#d55e00", "#0072b2", "#cc79a7", "#009e73", "#e69f00", "#56b4e9"];
export const groupColour = (index) => kGroupColours[index % kGroupColours.length];
