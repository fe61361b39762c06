// SPDX-License-Identifier: GPL-2.0-or-later
// Which face is at a point of the screen's plane. Works on what `raster.js` draws.

export const kNone = -1;

// How far towards the eye a face in space is at (x, y); as raster.js has it.
export function depthOnFace({xy, depth, corners}, f, x, y) {
  const n = corners[4 * f + 3] < 0 ? 3 : 4, p = [];
  for (let i = 0; i < n; ++i) {
    const v = corners[4 * f + i];
    p.push([xy[2 * v], xy[2 * v + 1], depth[v]]);
  }
  const middle = [0, 1, 2].map((k) => p.reduce((sum, q) => sum + q[k], 0) / n);
  const [u, w] = [[p[2], p[0]], [n === 4 ? p[3] : p[1], n === 4 ? p[1] : p[0]]].map(([a, b]) => a.map((_, k) => a[k] - b[k]));
  const normal = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
  if (normal[2] === 0) return middle[2];
  const z = middle[2] - (normal[0] * (x - middle[0]) + normal[1] * (y - middle[1])) / normal[2];
  return Math.min(Math.max(z, Math.min(...p.map((q) => q[2]))), Math.max(...p.map((q) => q[2])));
}

// The face at (x, y), the one in front of several; or kNone. `isShown(f)` says which there are.
export function faceAt(drawable, x, y, isShown) {
  const {corners, xy, faceCount, depth} = drawable;
  let found = kNone, nearest = -Infinity;
  for (let f = 0; f < faceCount; ++f) {
    if (!isShown(f)) continue;
    const n = corners[4 * f + 3] < 0 ? 3 : 4;
    let inside = false;
    for (let i = 0, j = n - 1; i < n; j = i++) {
      const a = 2 * corners[4 * f + i], b = 2 * corners[4 * f + j];
      if ((xy[a + 1] > y) !== (xy[b + 1] > y) && x < xy[a] + ((y - xy[a + 1]) / (xy[b + 1] - xy[a + 1])) * (xy[b] - xy[a])) inside = !inside;
    }
    if (!inside) continue;
    if (!depth) return f;
    const z = depthOnFace(drawable, f, x, y);
    if (z > nearest) nearest = z, found = f;
  }
  return found;
}

// How far the face in front is at (x, y); null if there is none.
export function depthAt(drawable, x, y, isShown) {
  const f = faceAt(drawable, x, y, isShown);
  return f === kNone ? null : depthOnFace(drawable, f, x, y);
}
