// SPDX-License-Identifier: GPL-2.0-or-later
// From a chart of a curved surface back to the surface: by the triangle of the start that a point lies in. Charts may lie
// over themselves, so the way is a walk from a triangle nearby.

const kMostSteps = 300, kMostAround = 200, kOutside = -1e-9;

export class Lift {
  // `film` has the start of the region; `places` are its nodes in space.
  constructor(film, region, places) {
    const {firstNode, point_count} = region;
    this.flat = film.places.slice(2 * firstNode, 2 * (firstNode + point_count));
    this.places = places;
    this.triangles = trianglesOf(film, region);
    this.at = new Int32Array(point_count);  // some triangle at a node
    for (let i = 0; i < this.triangles.length; ++i) this.at[this.triangles[i]] = Math.floor(i / 3);
    this.neighbours = neighboursOf(this.triangles, point_count);
    this.weights = new Float64Array(3);
  }
  triangleAt(node) { return this.at[node]; }

  // Writes the place of (x, y) to out[at], out[at + 1], out[at + 2]; returns the triangle, found from `hint`.
  place(x, y, hint, out, at) {
    const {places, triangles, weights} = this, t = this.find(x, y, hint);
    this.weigh(t, x, y);
    let sum = 0;
    for (let i = 0; i < 3; ++i) sum += weights[i] = Math.max(0, weights[i]);
    for (let k = 0; k < 3; ++k) {
      let value = 0;
      for (let i = 0; i < 3; ++i) value += (weights[i] / sum) * places[3 * triangles[3 * t + i] + k];
      out[at + k] = value;
    }
    return t;
  }

  // Barycentric coordinates; returns the least.
  weigh(t, x, y) {
    const {flat, triangles, weights} = this;
    const a = 2 * triangles[3 * t], b = 2 * triangles[3 * t + 1], c = 2 * triangles[3 * t + 2];
    const ax = flat[a] - x, ay = flat[a + 1] - y, bx = flat[b] - x, by = flat[b + 1] - y, cx = flat[c] - x, cy = flat[c + 1] - y;
    const u = bx * cy - by * cx, v = cx * ay - cy * ax, w = ax * by - ay * bx, sum = u + v + w || 1;
    weights[0] = u / sum, weights[1] = v / sum, weights[2] = w / sum;
    return Math.min(weights[0], weights[1], weights[2]);
  }

  find(x, y, hint) {
    let t = hint, from = -1;
    for (let step = 0; step < kMostSteps; ++step) {
      if (this.weigh(t, x, y) >= kOutside) return t;
      let next = -1, least = 0;
      for (let i = 0; i < 3; ++i) {
        const other = this.neighbours[3 * t + i];
        if (this.weights[i] < least && other >= 0 && other !== from) least = this.weights[i], next = other;
      }
      if (next < 0) break;
      from = t;
      t = next;
    }
    return this.findAround(x, y, t);
  }
  // Ring by ring; the least outside if none has it.
  findAround(x, y, start) {
    const seen = new Set([start]);
    let best = start, most = -Infinity;
    for (const t of seen) {
      const inside = this.weigh(t, x, y);
      if (inside > most) most = inside, best = t;
      if (most >= kOutside || seen.size > kMostAround) break;
      for (let i = 0; i < 3; ++i) if (this.neighbours[3 * t + i] >= 0) seen.add(this.neighbours[3 * t + i]);
    }
    return best;
  }
}

// Of the start, quads as two each; in the region's own numbers.
function trianglesOf(film, {firstNode, firstFace, face_count}) {
  const list = [];
  for (let f = firstFace; f < firstFace + face_count; ++f) {
    const [a, b, c, d] = Array.from(film.corners.subarray(4 * f, 4 * f + 4), (v) => v - firstNode);
    if (a < 0) continue;
    list.push(a, b, c);
    if (d >= 0) list.push(a, c, d);
  }
  return Int32Array.from(list);
}

// The triangle across the side opposite each corner, -1 where there is none.
function neighboursOf(triangles, nodes) {
  const first = new Int32Array(nodes + 1), fans = new Int32Array(triangles.length);
  for (const v of triangles) ++first[v + 1];
  for (let v = 0; v < nodes; ++v) first[v + 1] += first[v];
  const next = first.slice();
  for (let i = 0; i < triangles.length; ++i) fans[next[triangles[i]]++] = Math.floor(i / 3);
  const has = (t, v) => triangles[3 * t] === v || triangles[3 * t + 1] === v || triangles[3 * t + 2] === v;
  return Int32Array.from(triangles, (_, i) => {
    const t = Math.floor(i / 3), a = triangles[3 * t + ((i + 1) % 3)], b = triangles[3 * t + ((i + 2) % 3)];
    for (let k = first[a]; k < first[a + 1]; ++k) if (fans[k] !== t && has(fans[k], b)) return fans[k];
    return -1;
  });
}
