// SPDX-License-Identifier: GPL-2.0-or-later
// Lines and marks on a canvas.

const kLinesInPath = 500;  // a path of many thousand lines takes a hundred times longer than many short paths

const kNodes = 2 ** 26;
const kPieces = 8;  // of a segment that is hidden in part

// Draws segments [a0, b0, a1, b1, ...] of nodes in `style`; in space what of them the buffer (or null) sees.
export function strokeSegments(ctx, drawable, view, segments, style, width, buffer = null) {
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
    if (buffer) {
      traceSeen(ctx, buffer, ax, ay, k * drawable.depth[a], bx, by, k * drawable.depth[b]);
    } else {
      ctx.moveTo(ax, ay);
      ctx.lineTo(bx, by);
    }
    if (++inPath === kLinesInPath) {
      ctx.stroke();
      ctx.beginPath();
      inPath = 0;
    }
  }
  ctx.stroke();
}

function traceSeen(ctx, buffer, ax, ay, az, bx, by, bz) {
  const dx = bx - ax, dy = by - ay, dz = bz - az;
  const sees = (t) => buffer.sees(ax + t * dx, ay + t * dy, az + t * dz);
  const trace = (from, to) => {
    ctx.moveTo(ax + from * dx, ay + from * dy);
    ctx.lineTo(ax + to * dx, ay + to * dy);
  };
  const first = sees(0), middle = sees(0.5), last = sees(1);
  if (first && middle && last) return trace(0, 1);
  if (!first && !middle && !last) return;
  for (let i = 0; i < kPieces; ++i) if (sees((i + 0.5) / kPieces)) trace(i / kPieces, (i + 1) / kPieces);
}

// Sides of faces as segments, each side once where two faces agree in orientation. `accept(f)` chooses the faces.
// `once` (or null), a set: each side once, whatever the faces' orientations, of all calls with that set.
export function faceSides(drawable, view, accept, once = null) {
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
      if (!once) {
        if (a < b) segments.push(a, b);
        continue;
      }
      const key = Math.min(a, b) * kNodes + Math.max(a, b);
      if (once.has(key)) continue;
      once.add(key);
      segments.push(a, b);
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
