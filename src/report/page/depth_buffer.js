// SPDX-License-Identifier: GPL-2.0-or-later
// The face in front at each pixel, of a mesh in space. Depths are in pixels, towards the eye.

const kSameDepth = 1.5;

export class DepthBuffer {
  constructor() {
    this.ids = new Int32Array(0);
    this.depth = new Float32Array(0);
  }
  // Empty, for a picture of that size.
  begin({width, height}) {
    if (this.ids.length !== width * height) {
      this.ids = new Int32Array(width * height);
      this.depth = new Float32Array(width * height);
    }
    this.width = width;
    this.height = height;
    this.ids.fill(-1);
    this.depth.fill(-Infinity);
    return this;
  }
  // Is nothing before a place, within a pixel or two?
  sees(x, y, z) {
    const {width, height, depth} = this, px = Math.floor(x), py = Math.floor(y);
    if (px < 1 || py < 1 || px >= width - 1 || py >= height - 1) return true;  // nobody sees so far out
    const least = z + kSameDepth;
    for (let row = py - 1; row <= py + 1; ++row)
      for (let p = row * width + px - 1, end = p + 3; p < end; ++p) if (depth[p] <= least) return true;
    return false;
  }
  // Which faces are in front anywhere: 1 for each.
  seenFaces(faceCount) {
    const seen = new Uint8Array(faceCount);
    for (const f of this.ids) if (f >= 0) seen[f] = 1;
    return seen;
  }
}
