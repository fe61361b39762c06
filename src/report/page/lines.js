// SPDX-License-Identifier: GPL-2.0-or-later
// Lines and marks on a canvas.

const kLinesInPath = 500;  // a path of many thousand lines takes a hundred times longer than many short paths

// Draws segments [a0, b0, a1, b1, ...] of nodes, those that `wanted` (or null) lets through, in `style`.
export function strokeSegments(ctx, drawable, view, segments, style, width, wanted = null) {
  const {xy} = drawable, {k, ox, oy} = view;
  ctx.strokeStyle = style;
  ctx.lineWidth = width;
  ctx.lineCap = ctx.lineJoin = "round";
  let inPath = 0;
  ctx.beginPath();
  for (let i = 0; i < segments.length; i += 2) {
    const a = segments[i], b = segments[i + 1];
    const ax = k * xy[2 * a] + ox, ay = oy - k * xy[2 * a + 1], bx = k * xy[2 * b] + ox, by = oy - k * xy[2 * b + 1];
    if ((ax < 0 && bx < 0) || (ay < 0 && by < 0) || (ax > view.width && bx > view.width) ||
        (ay > view.height && by > view.height)) continue;
    if (wanted && !wanted(i / 2, (ax + bx) / 2, (ay + by) / 2)) continue;
    ctx.moveTo(ax, ay);
    ctx.lineTo(bx, by);
    if (++inPath === kLinesInPath) {
      ctx.stroke();
      ctx.beginPath();
      inPath = 0;
    }
  }
  ctx.stroke();
}

// Sides of faces as segments, each side once where two faces agree in orientation. `accept(f)` chooses the faces.
export function faceSides(drawable, view, accept) {
  const {xy, corners, faceCount} = drawable, {k, ox, oy, width, height} = view;
  const segments = [];
  for (let f = 0; f < faceCount; ++f) {
    if (!accept(f)) continue;
    const n = corners[4 * f + 3] < 0 ? 3 : 4;
    let left = Infinity, right = -Infinity, top = Infinity, bottom = -Infinity;
    for (let i = 0; i < n; ++i) {
      const v = corners[4 * f + i], x = k * xy[2 * v] + ox, y = oy - k * xy[2 * v + 1];
      left = Math.min(left, x), right = Math.max(right, x), top = Math.min(top, y), bottom = Math.max(bottom, y);
    }
    if (right < 0 || left > width || bottom < 0 || top > height) continue;
    for (let i = 0; i < n; ++i) {
      const a = corners[4 * f + i], b = corners[4 * f + ((i + 1) % n)];
      if (a < b) segments.push(a, b);
    }
  }
  return segments;
}

// A regular polygon as a path; many sides make a disc.
export function polygonPath(ctx, x, y, radius, sides) {
  for (let i = 0; i < sides; ++i) {
    const angle = (2 * Math.PI * i) / sides - Math.PI / 2;
    if (i === 0) ctx.moveTo(x + radius * Math.cos(angle), y + radius * Math.sin(angle));
    else ctx.lineTo(x + radius * Math.cos(angle), y + radius * Math.sin(angle));
  }
  ctx.closePath();
}
