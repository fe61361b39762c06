// SPDX-License-Identifier: GPL-2.0-or-later
// Hands on a pane: drag, wheel, two fingers, click, and keys while it has the focus.

const kClickPixels = 5;
const kWheelZoom = 1.0015;  // for a unit of deltaY
const kPanStep = 60, kTurnStep = 20;

// actions: {click(x, y), turning (turning.js; null for what is flat), keepArrows}. What is in space is turned by a drag and
// moved by one with shift, or with another button; what is flat is moved.
export function listenToPane(view, actions) {
  const {canvas, camera} = view, {turning} = actions;
  const pointers = new Map();
  let travelled = 0, turns = false;

  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const fromMiddle = ([x, y]) => [x - view.width / 2, y - view.height / 2];
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return {distance: Math.hypot(a[0] - b[0], a[1] - b[1]), middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]};
  };

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    canvas.focus({preventScroll: true});
    if (pointers.size === 0) {
      travelled = 0;
      turns = Boolean(turning) && !event.shiftKey && event.button === 0;
      if (turns) turning.begin();
    }
    pointers.set(event.pointerId, place(event));
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const now = place(event), dx = now[0] - before[0], dy = now[1] - before[1];
    travelled += Math.hypot(dx, dy);
    if (pointers.size === 1) {
      pointers.set(event.pointerId, now);
      if (travelled <= kClickPixels) return;
      if (turns) turning.turn(dx, dy);
      else camera.pan(dx, dy);
    } else if (pointers.size === 2) {
      const old = spread();
      pointers.set(event.pointerId, now);
      const next = spread();
      camera.pan(next.middle[0] - old.middle[0], next.middle[1] - old.middle[1]);
      if (old.distance > 0) camera.zoom(next.distance / old.distance, ...fromMiddle(next.middle));
    }
  });
  const release = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    if (event.type === "pointerup" && pointers.size === 0 && travelled <= kClickPixels) actions.click(...place(event));
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  if (turning) canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 20 : 1;  // some browsers count lines
    camera.zoom(kWheelZoom ** (-event.deltaY * lines), ...fromMiddle(place(event)));
  }, {passive: false});
  canvas.addEventListener("dblclick", (event) => camera.zoom(2, ...fromMiddle(place(event))));
  canvas.addEventListener("keydown", (event) => {
    const steps = {ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key];
    if (!steps || event.ctrlKey || event.metaKey || event.altKey || actions.keepArrows) return;
    event.preventDefault();
    if (!turning || event.shiftKey) return camera.pan(kPanStep * steps[0], kPanStep * steps[1]);
    turning.begin();
    turning.turn(-kTurnStep * steps[0], -kTurnStep * steps[1]);
  });
}
