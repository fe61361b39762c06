// SPDX-License-Identifier: GPL-2.0-or-later
// A mesh as the page holds it: four corners a face, the last -1 in a triangle.

import {kNone, faceAt, depthAt} from "./picking.js";

const kNoFigure = -32768;

export class Mesh {
  constructor(facts, array, frame, figureSteps) {
    this.points = array(facts.points);
    this.dimension = frame.flat ? 2 : 3;
    this.nodeCount = this.points.length / this.dimension;
    this.nodeTags = array(facts.node_tags);
    this.faceTags = array(facts.face_tags);
    this.faceCount = this.faceTags.length;
    this.corners = this.expand(array(facts.corner_counts), array(facts.corners));
    this.figures = {size: array(facts.figures.size)};
    for (const key of ["scaled_jacobian", "eta", "thesis_metric"])
      this.figures[key] = Float32Array.from(array(facts.figures[key]), (v) => v === kNoFigure ? NaN : v / figureSteps);
    this.lines = array(facts.lines);
    this.openEdges = array(facts.open_edges);
    this.dots = array(facts.dots);
    this.irregular = array(facts.irregular);
    this.valences = array(facts.valences);
    this.surfaces = facts.surfaces;
    this.curves = facts.curves;
    this.groups = facts.groups;
    this.shown = new Uint8Array(this.faceCount).fill(1);
    this.xy = new Float32Array(2 * this.nodeCount);
    this.depth = frame.flat ? null : new Float32Array(this.nodeCount);
    if (frame.flat) this.xy.set(this.points);
  }

  expand(counts, flat) {
    const corners = new Int32Array(4 * this.faceCount).fill(kNone);
    for (let f = 0, at = 0; f < this.faceCount; ++f)
      for (let i = 0; i < counts[f]; ++i) corners[4 * f + i] = flat[at++];
    return corners;
  }

  cornerCount(f) { return this.corners[4 * f + 3] === kNone ? 3 : 4; }
  nodesOf(f) { return Array.from(this.corners.subarray(4 * f, 4 * f + this.cornerCount(f))); }
  surfaceOf(f) { return this.surfaces.find((s) => f >= s.first && f < s.first + s.count); }

  // Coordinates on the screen's plane and towards the eye, from the rows of a rotation; of a mesh in space.
  project(rows) {
    this.rows = rows;
    this.isStale = true;
  }
  // Brings them up to date, when somebody looks.
  update() {
    if (this.isStale) project(this.points, this.nodeCount, this.rows, this.xy, this.depth);
    this.isStale = false;
  }

  // Smallest box around the faces that are shown: [x0, y0, x1, y1].
  bounds() {
    this.update();
    let box = [Infinity, Infinity, -Infinity, -Infinity];
    for (let f = 0; f < this.faceCount; ++f) if (this.shown[f]) box = joined(box, this.faceBounds(f));
    return box[0] <= box[2] ? box : [-1, -1, 1, 1];
  }

  faceBounds(f) {
    this.update();
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    for (const v of this.nodesOf(f)) {
      const x = this.xy[2 * v], y = this.xy[2 * v + 1];
      box[0] = Math.min(box[0], x), box[1] = Math.min(box[1], y);
      box[2] = Math.max(box[2], x), box[3] = Math.max(box[3], y);
    }
    return box;
  }

  // The shown face that has the point (x, y), the foremost of several; or kNone.
  faceAt(x, y) {
    this.update();
    return faceAt(this, x, y, (f) => this.shown[f] === 1);
  }
  depthAt(x, y) {
    this.update();
    return depthAt(this, x, y, (f) => this.shown[f] === 1);
  }
}

export function project(points, count, [a, b, c, d, e, f, g, h, i], xy, depth) {
  for (let v = 0; v < count; ++v) {
    const x = points[3 * v], y = points[3 * v + 1], z = points[3 * v + 2];
    xy[2 * v] = a * x + b * y + c * z;
    xy[2 * v + 1] = d * x + e * y + f * z;
    depth[v] = g * x + h * y + i * z;
  }
}

export function joined(a, b) {
  return [Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.max(a[2], b[2]), Math.max(a[3], b[3])];
}

// Of a face in space, in the frame.
export function normalOf(mesh, face) {
  const nodes = mesh.nodesOf(face), n = nodes.length;
  const p = nodes.map((v) => Array.from(mesh.points.subarray(3 * v, 3 * v + 3)));
  const [u, w] = [[p[2], p[0]], [p[n - 1], n === 4 ? p[1] : p[0]]].map(([a, b]) => a.map((x, i) => x - b[i]));
  return [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
}

// Where a node is in the model, by the frame that the page's coordinates are in.
export function inSpace(mesh, frame, node) {
  const p = Array.from(mesh.points.subarray(mesh.dimension * node, mesh.dimension * (node + 1)));
  const [r, u] = [frame.right, frame.up];
  const n = [r[1] * u[2] - r[2] * u[1], r[2] * u[0] - r[0] * u[2], r[0] * u[1] - r[1] * u[0]];
  return [0, 1, 2].map((i) => frame.centre[i] + p[0] * r[i] + p[1] * u[i] + (p[2] ?? 0) * n[i]);
}
