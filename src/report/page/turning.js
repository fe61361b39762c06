// SPDX-License-Identifier: GPL-2.0-or-later
// How meshes in space are turned: about their upward axis, then about the screen's horizontal one.

import {byId} from "./dom.js";

const kRadiansToPixel = 0.01;
const kWhole = 1.5;  // times as near as where all of it is seen
// The eye on an axis of the model, x, y or z; the frame of a mesh in space has x, z, -y.
const kAxes = {x: [-Math.PI / 2, 0], y: [Math.PI, 0], z: [0, Math.PI / 2]};
const kOtherSide = {x: [Math.PI / 2, 0], y: [0, 0], z: [0, -Math.PI / 2]};

export class Turning {
  // `drawables` have project(rows) and depthAt(x, y); `changed` is called when they are to be painted anew.
  constructor(home, camera, drawables, changed) {
    this.home = home;
    this.angles = home;
    this.camera = camera;
    this.drawables = drawables;
    this.changed = changed;
    this.pivot = [0, 0, 0];
    this.apply();
  }
  // To the right, upwards and towards the eye, in the frame.
  get rows() {
    const [a, b] = this.angles, [ca, sa, cb, sb] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b)];
    return [ca, 0, sa, sa * sb, cb, -ca * sb, -sa * cb, sb, ca * cb];
  }
  apply() {
    for (const drawable of this.drawables) drawable.project(this.rows);
    this.changed();
  }
  // A hand takes hold. Of a mesh that is seen whole the middle stays where it is, else what is in the middle of the pane.
  begin() {
    const {x, y, scale, fitted} = this.camera, m = this.rows;
    this.pivot = [0, 0, 0];
    if (scale < kWhole * fitted) return;
    const z = this.drawables[0].depthAt(x, y) ?? 0;
    this.pivot = [0, 1, 2].map((i) => m[i] * x + m[3 + i] * y + m[6 + i] * z);
  }
  turn(dx, dy) {
    const [a, b] = this.angles;
    this.look([a + kRadiansToPixel * dx, Math.min(Math.PI / 2, Math.max(-Math.PI / 2, b + kRadiansToPixel * dy))]);
  }
  look(angles) {
    const [px, py, pz] = this.pivot, before = this.rows;
    this.angles = angles;
    const after = this.rows, {camera} = this;
    camera.x += (after[0] - before[0]) * px + (after[1] - before[1]) * py + (after[2] - before[2]) * pz;
    camera.y += (after[3] - before[3]) * px + (after[4] - before[4]) * py + (after[5] - before[5]) * pz;
    this.apply();
  }
}

// The angles for an eye in a direction of the frame.
export function anglesFrom([x, y, z]) {
  const height = y / Math.hypot(x, y, z);
  return [Math.abs(height) > 0.9999 ? 0 : Math.atan2(-x, z), Math.asin(Math.min(1, Math.max(-1, height)))];
}

// Buttons and keys for the axes; `look` takes the angles.
export function connectAxes(turning, look) {
  byId("turn").hidden = false;
  for (const hint of document.querySelectorAll(".turn-hint")) hint.hidden = false;
  for (const hint of document.querySelectorAll(".pan-hint")) hint.hidden = true;
  for (const button of byId("turn").children)
    button.onclick = (event) => look(button.value === "home" ? turning.home : (event.shiftKey ? kOtherSide : kAxes)[button.value]);
}
// For a key, what to do about it; or undefined.
export function axisOfKey(key) {
  return key === key.toLowerCase() ? kAxes[key] : kOtherSide[key.toLowerCase()];
}
