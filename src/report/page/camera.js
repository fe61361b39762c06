// SPDX-License-Identifier: GPL-2.0-or-later
// Which part of the plane the panes show; panes share one.

const kLargestZoom = 1e6;

export class Camera {
  constructor() {
    this.x = 0;  // of the middle of a pane
    this.y = 0;
    this.scale = 1;  // CSS pixels for a unit
    this.home = [-1, -1, 1, 1];
    this.listeners = [];
  }
  onChange(listener) { this.listeners.push(listener); }
  changed() { for (const listener of this.listeners) listener(); }

  // Shows a box in a pane of that size.
  show([x0, y0, x1, y1], width, height, margin = 0.06) {
    this.x = (x0 + x1) / 2;
    this.y = (y0 + y1) / 2;
    const room = 1 - 2 * margin;
    this.scale = Math.min((room * width) / Math.max(x1 - x0, 1e-30), (room * height) / Math.max(y1 - y0, 1e-30));
    this.changed();
  }
  fit(width, height) {
    this.show(this.home, width, height);
    this.fitted = this.scale;
  }
  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
    this.changed();
  }
  // Zooms so that the point under (px, py), from the pane's middle, stays there.
  zoom(factor, px = 0, py = 0) {
    const next = Math.min(Math.max(this.scale * factor, this.fitted / 20), this.fitted * kLargestZoom);
    this.x += px / this.scale - px / next;
    this.y -= py / this.scale - py / next;
    this.scale = next;
    this.changed();
  }
}
