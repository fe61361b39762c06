// SPDX-License-Identifier: GPL-2.0-or-later
// The page of --film.

import {byId, element, whole} from "./dom.js";
import {readFacts, readNumbers} from "./numbers.js";
import {Camera} from "./camera.js";
import {CanvasView} from "./canvas_view.js";
import {Turning, connectAxes, axisOfKey} from "./turning.js";
import {listenToPane} from "./gestures.js";
import {toggleTheme, onTheme} from "./theme.js";
import {Film, kSteps, kSides} from "./film_data.js";
import {FilmPainter, levelColour, kLevels, kStateWidths} from "./film_painter.js";

const facts = readFacts();
const film = new Film(facts, readNumbers());
const camera = new Camera();
const painter = new FilmPainter(film);
const view = new CanvasView(byId("canvas-film"), camera, painter);
const turning = facts.frame.flat ? null : new Turning(facts.frame.turned, camera, [film], () => view.turned());
let playing = false, speed = 20, owed = 0, last = 0;

function sentence(note) {
  const kind = kSteps[note.kind];
  if (note.kind !== 0) return kind.about ? `${kind.name}: ${kind.about}` : kind.name;
  const sides = note.left === note.right ? `both sides: ${kSides[note.left]}` : `left side: ${kSides[note.left]}, right side: ${kSides[note.right]}`;
  const top = note.swaps === 0 ? "top edge was there" : `top edge recovered by ${note.swaps} swap${note.swaps === 1 ? "" : "s"}`;
  return `quad; ${sides}; ${top}${note.metFront ? "; it meets the front" : ""}`;
}

function show() {
  const {quads, triangles} = film.counts();
  byId("slider").value = String(film.step);
  byId("position").textContent = `step ${whole(film.step)} of ${whole(film.stepCount)}`;
  byId("counts").textContent = `${whole(quads)} quads, ${whole(triangles)} triangles left to the front`;
  const start = film.step === 0;
  byId("what").textContent = film.regions.length === 0 ? "nothing was converted, so there was no front" : start ? "the triangles before the first step" : sentence(film.describe(film.step - 1));
  byId("where").textContent = start || film.regions.length <= 1 ? "" : `surface ${film.describe(film.step - 1).region.surface}:`;
  view.invalidate();
}
function goTo(step) {
  film.goTo(step);
  show();
}
function play(on) {
  playing = on && film.step < film.stepCount;
  byId("play").textContent = playing ? "❚❚ Pause" : "▶ Play";
  byId("play").setAttribute("aria-pressed", String(playing));
  if (!playing) return;
  last = performance.now(), owed = 0;
  requestAnimationFrame(tick);
}
function tick(now) {
  if (!playing) return;
  owed += (speed * Math.min(100, now - last)) / 1000;
  last = now;
  const steps = Math.floor(owed);
  if (steps > 0) {
    owed -= steps;
    goTo(film.step + steps);
    if (byId("follow").checked) follow();
  }
  if (film.step >= film.stepCount) return play(false);
  requestAnimationFrame(tick);
}

// Keeps the base edge in the pane.
function follow() {
  if (film.step === 0) return;
  film.update();
  const [a, b] = film.describe(film.step - 1).base;
  const x = (film.xy[2 * a] + film.xy[2 * b]) / 2, y = (film.xy[2 * a + 1] + film.xy[2 * b + 1]) / 2;
  const px = (x - camera.x) * camera.scale, py = (y - camera.y) * camera.scale;
  if (Math.abs(px) < 0.4 * view.width && Math.abs(py) < 0.4 * view.height) return;
  camera.x = x, camera.y = y;
  camera.changed();
}
function fit() {
  if (turning) camera.home = film.bounds();
  camera.fit(view.width, view.height);
}
function look(angles) {
  turning.look(angles);
  fit();
}

// A quad that is there: to the step that made it. One that is to come: by playing on until the triangle is gone.
function jump(px, py) {
  play(false);
  const f = film.faceAt(...view.toPlane(px, py));
  if (f < 0) return;
  if (film.quadStep[f] >= 0) return goTo(film.quadStep[f] + 1);
  const [x, y] = view.toPlane(px, py);
  while (film.step < film.stepCount) {
    film.forward();
    if (![...film.touched].some((g) => film.corners[4 * g + 3] >= 0)) continue;
    const now = film.faceAt(x, y);
    if (now >= 0 && film.corners[4 * now + 3] >= 0) break;
  }
  show();
}

function drawLegend() {
  const line = (colour, width) => {
    const node = element("span", {className: "line"});
    node.style.background = colour;
    node.style.height = `${width}px`;
    return node;
  };
  byId("legend").replaceChildren(
    element("span", {}, "front, level ", ...Array.from({length: kLevels}, (_, i) => element("span", {className: "level"}, line(levelColour(i), 5), i === kLevels - 1 ? `${i} …` : String(i)))),
    ...["no corner", "a corner at one end", "corners at both ends"].map((what, i) => element("span", {}, line("var(--soft)", kStateWidths[i]), what)),
    element("span", {}, line("var(--curve)", 3.5), "base edge of the step"));
}

function connectFilm() {
  byId("slider").max = String(film.stepCount);
  byId("slider").oninput = (event) => { play(false); goTo(Number(event.target.value)); };
  byId("play").onclick = () => {
    if (!playing && film.step === film.stepCount) goTo(0);
    play(!playing);
  };
  byId("back").onclick = () => { play(false); goTo(film.step - 1); };
  byId("next").onclick = () => { play(false); goTo(film.step + 1); };
  byId("speed").onchange = (event) => { speed = Number(event.target.value); };
  byId("fit").onclick = fit;
  byId("zoom-in").onclick = () => camera.zoom(1.5);
  byId("zoom-out").onclick = () => camera.zoom(1 / 1.5);
  byId("theme").onclick = toggleTheme;
  if (turning) connectAxes(turning, look);
  listenToPane(view, {click: jump, turning, keepArrows: true});
  document.addEventListener("keydown", onFilmKey);
  onTheme(() => { drawLegend(); view.invalidate(); });
}
function onFilmKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest?.("select, textarea")) return;
  if (event.key === " " && event.target.closest?.("button, input[type=checkbox]")) return;  // they know what to do
  const jumpBy = (steps) => () => { play(false); goTo(film.step + steps); };
  const actions = {
    " ": () => byId("play").click(), ArrowRight: jumpBy(1), ArrowLeft: jumpBy(-1), PageDown: jumpBy(100), PageUp: jumpBy(-100),
    Home: jumpBy(-Infinity), End: jumpBy(Infinity), "+": () => camera.zoom(1.5), "=": () => camera.zoom(1.5),
    "-": () => camera.zoom(1 / 1.5), 0: fit, d: toggleTheme,
  };
  const angles = turning && axisOfKey(event.key);
  const action = angles ? () => look(angles) : actions[event.key];
  if (!action) return;
  event.preventDefault();
  action();
}

connectFilm();
drawLegend();
byId("subtitle").textContent = `${facts.input} → ${facts.output}`;
byId("command").textContent = facts.command;
byId("version").textContent = `qmorph ${facts.version}`;
if (film.regions.length > 0) camera.home = film.bounds();
// About half a minute for all of it, in round numbers.
const speeds = [...byId("speed").options].map((option) => Number(option.value));
speed = speeds.find((s) => s >= film.stepCount / 30) ?? speeds.at(-1);
byId("speed").value = String(speed);
fit();
goTo(0);
let fittedSize = [0, 0];
new ResizeObserver(() => {
  if (Math.abs(view.width - fittedSize[0]) < 1 && Math.abs(view.height - fittedSize[1]) < 1) return;
  fittedSize = [view.width, view.height];
  if (camera.scale === camera.fitted) fit();
}).observe(byId("canvas-film"));

window.qmorph = {facts, film, camera, turning, view, painter, goTo, play, fit};
