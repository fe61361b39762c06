// SPDX-License-Identifier: GPL-2.0-or-later
// A film: what the front did, as changes from step to step. The coding is described in src/report/film.hpp.

import {Lift} from "./film_lift.js";
import {project, joined} from "./mesh.js";
import {faceAt, depthAt} from "./picking.js";

export const kSteps = [
  {name: "quad"}, {name: "small loop closed"}, {name: "seam"}, {name: "transition seam"}, {name: "transition split"},
  {name: "long edge split", about: "the input gets finer ahead"},
];
export const kSides = ["front edge", "existing edge", "swapped diagonal", "split edge", "edge cut in two"];
const kGone = -1;

class Bytes {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }
  byte() { return this.bytes[this.at++]; }
  number() {
    let value = 0, factor = 1, byte;
    do {
      byte = this.bytes[this.at++];
      value += (byte & 127) * factor;
      factor *= 128;
    } while (byte & 128);
    return value;
  }
  signed() {
    const n = this.number();
    return n % 2 === 0 ? n / 2 : -(n + 1) / 2;
  }
}

// Front edges by the key of their end nodes.
const kKey = 2 ** 26;
export const edgeKey = (a, b) => a * kKey + b;

// The films of all regions, one after another, as one mesh that changes. `xy` (two a node), `corners` (four a face, -1 for
// none) and, in space, `depth` are what the panes draw. Step 0 is the start; `step` is how many have been taken.
export class Film {
  constructor(facts, array) {
    this.regions = facts.regions;
    this.stepCount = 0;
    let nodes = 0, faces = 0;
    for (const region of this.regions) {
      region.firstStep = this.stepCount;
      region.firstNode = nodes;
      region.firstFace = faces;
      region.bytes = array(region.steps);
      this.stepCount += region.step_count;
      this.index(region);
      nodes += region.nodeCount;
      faces += region.faceCount;
    }
    this.nodeCount = nodes;
    this.xy = new Float32Array(2 * nodes);
    this.depth = facts.frame.flat ? null : new Float32Array(nodes);
    this.points = facts.frame.flat ? null : new Float32Array(3 * nodes);  // in space
    this.hints = facts.frame.flat ? null : new Int32Array(nodes);  // a triangle of the region's start near the node
    this.places = new Float64Array(2 * nodes);  // in the film's units
    this.seen = new Uint8Array(nodes);
    this.corners = new Int32Array(4 * faces).fill(kGone);
    this.faceCount = faces;
    this.sides = new Map();   // from an edge's key to the face on its left
    this.frontKeys = new Set();
    this.faceCounts = {quads: 0, triangles: 0};
    this.levels = new Map();  // from a front edge's key to its level, if it is not 0
    this.undo = new Array(this.stepCount);
    this.quadStep = new Int32Array(faces).fill(-1);  // the step that made a face a quad
    this.step = 0;
    for (const region of this.regions) this.begin(region, array);
    this.boundary = [];  // end nodes of its edges, which never change
    for (const key of this.sides.keys()) {
      const a = Math.floor(key / kKey), b = key % kKey;
      if (!this.sides.has(edgeKey(b, a))) this.boundary.push(a, b);
    }
  }

  // Where each step of a region begins, and how many nodes and faces it will have.
  index(region) {
    const bytes = new Bytes(region.bytes);
    region.starts = new Uint32Array(region.step_count);
    region.nodeCount = region.point_count;
    region.faceCount = region.face_count;
    for (let s = 0; s < region.step_count; ++s) {
      region.starts[s] = bytes.at;
      this.visit(bytes, {
        node: (v) => { region.nodeCount = Math.max(region.nodeCount, v + 1); },
        face: (f) => { region.faceCount = Math.max(region.faceCount, f + 1); },
      });
    }
  }

  begin(region, array) {
    const points = new Bytes(array(region.points)), faces = new Bytes(array(region.faces));
    for (let v = 0, x = 0, y = 0; v < region.point_count; ++v) {
      this.seen[region.firstNode + v] = 1;
      x += points.signed(), y += points.signed();
      this.places.set([x, y], 2 * (region.firstNode + v));
    }
    for (let f = 0, node = region.firstNode; f < region.face_count; ++f) {
      const corners = [kGone, kGone, kGone, kGone];
      for (let i = 0, n = faces.signed(); i < n; ++i) corners[i] = node += faces.signed();
      this.setFace(region.firstFace + f, corners);
    }
    if (region.places) region.lift = new Lift(this, region, array(region.places));
    for (let v = region.firstNode; v < region.firstNode + region.point_count; ++v) {
      if (region.lift) this.hints[v] = region.lift.triangleAt(v - region.firstNode);
      this.setPlace(region, v, this.places[2 * v], this.places[2 * v + 1]);
    }
  }

  // Places on the screen's plane, from the rows of a rotation.
  project(rows) {
    this.rows = rows;
    this.isStale = true;
  }
  // Brings them up to date.
  update() {
    if (!this.isStale) return;
    project(this.points, this.nodeCount, this.rows, this.xy, this.depth);
    this.isStale = false;
  }
  // Around what there was at the start.
  bounds() {
    this.update();
    let box = [Infinity, Infinity, -Infinity, -Infinity];
    for (const {firstNode, point_count} of this.regions)
      for (let v = firstNode; v < firstNode + point_count; ++v) {
        const x = this.xy[2 * v], y = this.xy[2 * v + 1];
        box = joined(box, [x, y, x, y]);
      }
    return box[0] <= box[2] ? box : [-1, -1, 1, 1];
  }

  // Reads one step and calls what the visitor has: head(kind, ...), node(v, dx, dy), face(f, corners), level(a, b, level).
  // Numbers of nodes and faces are the region's own.
  visit(bytes, visitor) {
    const kind = bytes.byte(), note = {kind, left: 0, right: 0, metFront: false, swaps: 0};
    if (kind === 0) {
      const sides = bytes.byte();
      note.left = sides & 7, note.right = (sides >> 3) & 7, note.metFront = sides >= 64;
      note.swaps = bytes.number();
    }
    const near = bytes.number();
    note.base = [near, near + bytes.signed()];
    visitor.head?.(note);
    for (let i = bytes.number(), v = near; i > 0; --i) {
      v += bytes.signed();
      const dx = bytes.signed(), dy = bytes.signed();
      visitor.node?.(v, dx, dy);
    }
    for (let i = bytes.number(), f = 0; i > 0; --i) {
      f += bytes.signed();
      const corners = [kGone, kGone, kGone, kGone], count = bytes.number();
      for (let c = 0; c < count; ++c) corners[c] = near + bytes.signed();
      visitor.face?.(f, corners);
    }
    for (let i = bytes.number(); i > 0; --i) {
      const a = near + bytes.signed(), b = near + bytes.signed(), level = bytes.number();
      visitor.level?.(a, b, level);
    }
    return note;
  }

  setPlace(region, v, x, y) {
    this.places[2 * v] = x, this.places[2 * v + 1] = y;
    const {at, u, w} = region;
    if (!this.points) {
      this.xy[2 * v] = at[0] + x * u[0] + y * w[0];
      this.xy[2 * v + 1] = at[1] + x * u[1] + y * w[1];
      return;
    }
    this.isStale = true;
    if (region.lift) this.hints[v] = region.lift.place(x, y, this.hints[v], this.points, 3 * v);
    else for (let i = 0; i < 3; ++i) this.points[3 * v + i] = at[i] + x * u[i] + y * w[i];
  }

  setFace(f, corners) {
    const now = this.corners.subarray(4 * f, 4 * f + 4), old = Array.from(now);
    now.set(corners);
    this.noteCount(old, -1);
    this.noteCount(corners, 1);
    for (let i = 0, n = count(old); i < n; ++i) {
      const key = edgeKey(old[i], old[(i + 1) % n]);
      if (this.sides.get(key) === f) this.sides.delete(key);
    }
    for (let i = 0, n = count(corners); i < n; ++i) this.sides.set(edgeKey(corners[i], corners[(i + 1) % n]), f);
    for (const list of [old, corners])
      for (let i = 0, n = count(list); i < n; ++i) this.noteFront(list[i], list[(i + 1) % n]);
  }
  noteCount(corners, change) {
    const n = count(corners);
    if (n === 4) this.faceCounts.quads += change;
    if (n === 3) this.faceCounts.triangles += change;
  }
  // The front has the edges with a triangle on their left and none on their right.
  noteFront(a, b) {
    const key = edgeKey(a, b), twin = edgeKey(b, a);
    const left = this.isTriangle(this.sides.get(key)), right = this.isTriangle(this.sides.get(twin));
    for (const [edge, on] of [[key, left && !right], [twin, right && !left]]) {
      if (on) this.frontKeys.add(edge);
      else this.frontKeys.delete(edge);
    }
  }

  regionOf(step) {
    return this.regions.findLast((region) => region.firstStep <= step && region.step_count > 0) ?? this.regions[0];
  }
  bytesOf(step) {
    const region = this.regionOf(step), bytes = new Bytes(region.bytes);
    bytes.at = region.starts[step - region.firstStep];
    return {region, bytes};
  }

  // What the step did, for people: the head of its record with nodes of the film.
  describe(step) {
    const {region, bytes} = this.bytesOf(step);
    const note = this.visit(bytes, {});
    note.base = note.base.map((v) => v + region.firstNode);
    note.region = region;
    return note;
  }

  forward() {
    const step = this.step++, {region, bytes} = this.bytesOf(step);
    const first = this.undo[step] === undefined;
    const undo = {nodes: [], faces: [], levels: []};
    let near = 0, nearPlace = null;
    this.touched = new Set();
    this.visit(bytes, {
      head: (note) => {
        near = note.base[0] + region.firstNode;
        nearPlace = [this.places[2 * near], this.places[2 * near + 1]];
      },
      node: (own, dx, dy) => {
        const v = own + region.firstNode;
        const [x, y] = this.seen[v] ? [this.places[2 * v], this.places[2 * v + 1]] : nearPlace;
        if (first) undo.nodes.push(v, this.places[2 * v], this.places[2 * v + 1], this.seen[v], this.hints?.[v] ?? 0);
        this.seen[v] = 1;
        if (this.hints) this.hints[v] = this.hints[near];
        this.setPlace(region, v, x + dx, y + dy);
      },
      face: (own, corners) => {
        const f = own + region.firstFace, nodes = corners.map((v) => (v === kGone ? kGone : v + region.firstNode));
        if (first) undo.faces.push(f, ...this.corners.subarray(4 * f, 4 * f + 4), this.quadStep[f]);
        if (count(nodes) === 4 && count(this.corners.subarray(4 * f, 4 * f + 4)) !== 4) this.quadStep[f] = step;
        this.setFace(f, nodes);
        this.touched.add(f);
      },
      level: (a, b, level) => {
        const key = edgeKey(a + region.firstNode, b + region.firstNode);
        if (first) undo.levels.push(key, this.levels.get(key) ?? 0);
        this.levels.set(key, level);
      },
    });
    if (first) this.undo[step] = {nodes: Float64Array.from(undo.nodes), faces: Int32Array.from(undo.faces), levels: Float64Array.from(undo.levels)};
  }

  backward() {
    const undo = this.undo[--this.step], region = this.regionOf(this.step);
    for (let i = undo.levels.length - 2; i >= 0; i -= 2) this.levels.set(undo.levels[i], undo.levels[i + 1]);
    // All faces are taken away before any comes back: they share sides.
    for (let i = 0; i < undo.faces.length; i += 6) this.setFace(undo.faces[i], [kGone, kGone, kGone, kGone]);
    for (let i = undo.faces.length - 6; i >= 0; i -= 6) {
      this.setFace(undo.faces[i], undo.faces.subarray(i + 1, i + 5));
      this.quadStep[undo.faces[i]] = undo.faces[i + 5];
    }
    for (let i = undo.nodes.length - 5; i >= 0; i -= 5) {
      if (this.hints) this.hints[undo.nodes[i]] = undo.nodes[i + 4];
      this.setPlace(region, undo.nodes[i], undo.nodes[i + 1], undo.nodes[i + 2]);
      this.seen[undo.nodes[i]] = undo.nodes[i + 3];
    }
    this.touched = new Set();
  }

  goTo(step) {
    const target = Math.min(this.stepCount, Math.max(0, Math.round(step)));
    while (this.step < target) this.forward();
    while (this.step > target) this.backward();
  }

  isTriangle(f) { return f !== undefined && this.corners[4 * f] !== kGone && this.corners[4 * f + 3] === kGone; }

  // The front now: edges, each with its level and its state: how many of its ends are corners.
  front() {
    const edges = [];
    for (const key of this.frontKeys) {
      const a = Math.floor(key / kKey), b = key % kKey;
      edges.push({a, b, level: this.levels.get(key) ?? 0, corners: this.isCorner(...this.before(a, b), b) + this.isCorner(a, b, this.after(a, b))});
    }
    return edges;
  }

  third(f, a, b) {
    for (let i = 0; i < 3; ++i) if (this.corners[4 * f + i] !== a && this.corners[4 * f + i] !== b) return this.corners[4 * f + i];
    return a;
  }
  // The node that the front edge after a -> b leads to, through the triangles ahead.
  after(a, b) {
    let from = a;
    for (let turns = 0; turns < 1000; ++turns) {
      const c = this.third(this.sides.get(edgeKey(from, b)), from, b);
      if (!this.isTriangle(this.sides.get(edgeKey(c, b)))) return c;
      from = c;
    }
    return from;
  }
  // The node that the front edge before it comes from, and a.
  before(a, b) {
    let to = b;
    for (let turns = 0; turns < 1000; ++turns) {
      const c = this.third(this.sides.get(edgeKey(a, to)), a, to);
      if (!this.isTriangle(this.sides.get(edgeKey(a, c)))) return [c, a];
      to = c;
    }
    return [to, a];
  }
  // Is the angle at b, from b -> c counter-clockwise to b -> a, below that of a corner?
  isCorner(a, b, c) {
    const {places: xy} = this;  // in the plane where the front works
    const ax = xy[2 * a] - xy[2 * b], ay = xy[2 * a + 1] - xy[2 * b + 1], cx = xy[2 * c] - xy[2 * b], cy = xy[2 * c + 1] - xy[2 * b + 1];
    const cross = cx * ay - cy * ax, dot = cx * ax + cy * ay;
    return cross > 0 && Math.atan2(cross, dot) < this.regions[0].corner_angle ? 1 : 0;
  }

  faceAt(x, y) {
    if (this.points) this.update();
    return faceAt(this, x, y, (f) => this.corners[4 * f] !== kGone);
  }
  depthAt(x, y) {
    this.update();
    return depthAt(this, x, y, (f) => this.corners[4 * f] !== kGone);
  }

  counts() { return {...this.faceCounts}; }
}

function count(corners) { return corners[0] === kGone ? 0 : corners[3] === kGone ? 3 : 4; }
