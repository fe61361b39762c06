// SPDX-License-Identifier: GPL-2.0-or-later
// Fills polygons pixel by pixel: ten times faster than the canvas where there are hundreds of thousands, and every
// pixel has the colour of exactly one element: the one that has the pixel's middle.

// `drawable`: {xy, corners (4 a face, -1 for none), order (or null), faceCount}. `view`: {k, ox, oy, width, height}: a
// point is at (k x + ox, -k y + oy) in pixels. `colours`: a pixel a face, 0 to leave it out. `ids` (or null) takes the
// face of each pixel. Returns how many faces and pixels were drawn.
export function fillFaces(pixels, drawable, view, colours, ids) {
  const {xy, corners, order, faceCount} = drawable;
  const {k, ox, oy, width, height} = view;
  const X = new Float64Array(4), Y = new Float64Array(4);
  let faces = 0, area = 0;
  for (let at = 0; at < faceCount; ++at) {
    const f = order ? order[at] : at, colour = colours[f];
    if (colour === 0) continue;
    const n = corners[4 * f + 3] < 0 ? 3 : 4;
    let top = Infinity, bottom = -Infinity, left = Infinity, right = -Infinity;
    for (let i = 0; i < n; ++i) {
      const v = corners[4 * f + i];
      const x = (X[i] = k * xy[2 * v] + ox), y = (Y[i] = oy - k * xy[2 * v + 1]);
      if (y < top) top = y;
      if (y > bottom) bottom = y;
      if (x < left) left = x;
      if (x > right) right = x;
    }
    if (right < 0 || left > width || bottom < 0 || top > height) continue;
    ++faces;
    const first = Math.max(0, Math.ceil(top - 0.5)), last = Math.min(height - 1, Math.ceil(bottom - 0.5) - 1);
    for (let row = first; row <= last; ++row) {
      const middle = row + 0.5;
      let from = Infinity, to = -Infinity;  // a reflex corner is filled as if it were straight
      for (let i = 0, j = n - 1; i < n; j = i++) {
        if ((Y[i] <= middle) === (Y[j] <= middle)) continue;
        const x = X[i] + ((middle - Y[i]) / (Y[j] - Y[i])) * (X[j] - X[i]);
        if (x < from) from = x;
        if (x > to) to = x;
      }
      const begin = row * width + Math.max(0, Math.ceil(from - 0.5)), end = row * width + Math.min(width, Math.ceil(to - 0.5));
      for (let p = begin; p < end; ++p) pixels[p] = colour;
      if (ids) for (let p = begin; p < end; ++p) ids[p] = f;
      if (end > begin) area += end - begin;
    }
  }
  return {faces, area};
}
