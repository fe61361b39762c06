// SPDX-License-Identifier: GPL-2.0-or-later
// The page of --report.

import {byId, element, short} from "./dom.js";
import {readFacts, readNumbers} from "./numbers.js";
import {Mesh, joined, normalOf} from "./mesh.js";
import {kNone} from "./picking.js";
import {Turning, anglesFrom, connectAxes, axisOfKey} from "./turning.js";
import {Colouring, kFigures, kInverted, kUndefined, css, onScale, quantile, useScale} from "./colours.js";
import {Camera} from "./camera.js";
import {CanvasView} from "./canvas_view.js";
import {ReportPainter, kMarks, groupColour} from "./report_painter.js";
import {listenToPane} from "./gestures.js";
import {drawHistogram} from "./histograms.js";
import {stageTable, surfaceTable, poorTable, optionList, chips} from "./tables.js";
import {elementCard, summaryLine, countsOf} from "./element_card.js";
import {toggleTheme, onTheme} from "./theme.js";

const kWorst = 10, kBlinkMs = 900;

const facts = readFacts();
const array = readNumbers();
useScale(facts.scale);
const meshes = Object.fromEntries(["before", "after"].map((side) =>
  [side, new Mesh(facts.meshes[side], array, facts.frame, facts.figure_steps)]));
const camera = new Camera();
const settings = {colouring: null, sides: true, irregular: true, boundary: true, groups: new Set(), selected: kNone, selectedMesh: null};
const panes = Object.fromEntries(Object.entries(meshes).map(([side, mesh]) => {
  const painter = new ReportPainter(mesh, settings);
  return [side, {mesh, painter, node: byId(`pane-${side}`), view: new CanvasView(byId(`canvas-${side}`), camera, painter)}];
}));
let mode = "", blinking = 0, worstAt = -1, worst = [];
const turning = facts.frame.flat ? null : new Turning(facts.frame.turned, camera, Object.values(meshes), () => {
  for (const pane of Object.values(panes)) pane.view.turned();
});

const firstShown = () => Object.values(panes).find((pane) => !pane.node.hidden);
const repaint = () => { for (const pane of Object.values(panes)) pane.view.invalidate(); };
const repaintFaces = () => { for (const pane of Object.values(panes)) pane.painter.refresh(); repaint(); };

// --- which panes ----------------------------------------------------------------------------------------

function showOnly(side) {
  for (const [name, pane] of Object.entries(panes)) pane.node.hidden = side !== "both" && name !== side;
}
function setMode(next) {
  clearInterval(blinking);
  mode = next;
  byId("panes").dataset.mode = mode;
  for (const button of byId("modes").children) button.setAttribute("aria-pressed", String(button.value === mode));
  if (mode !== "blink") return showOnly(mode);
  let side = "after";
  showOnly(side);
  blinking = setInterval(() => showOnly(side = side === "after" ? "before" : "after"), kBlinkMs);
}

// --- colours ----------------------------------------------------------------------------------------------

// Fixed for figures between 0 and 1, so that pages can be compared; sizes by what there is, both sides together.
function rangeOf(key) {
  if (!kFigures[key].logarithmic) return [0, 1];
  const all = Float32Array.from([...meshes.before.figures[key], ...meshes.after.figures[key]]).sort();
  const low = quantile(all, 0.002), high = quantile(all, 0.998);
  return high > 1.02 * low && low > 0 ? [low, high] : [low / 1.1 || 0.5, high * 1.1 || 1];
}
const colourings = Object.fromEntries(Object.keys(kFigures).map((key) => [key, new Colouring(key, rangeOf(key))]));

function setColouring(key) {
  settings.colouring = colourings[key] ?? null;
  byId("colour").value = key;
  drawLegend();
  listWorst();
  if (settings.selected !== kNone) showCard();
  repaintFaces();
}

function drawLegend() {
  const legend = byId("legend"), colouring = settings.colouring;
  legend.replaceChildren();
  if (colouring) {
    const bar = element("span", {className: "bar"});
    bar.style.background = `linear-gradient(90deg, ${Array.from({length: 17}, (_, i) => css(onScale(i / 16))).join(", ")})`;
    legend.append(element("span", {className: "scale"}, short(colouring.value(0), 2), bar, short(colouring.value(1), 2)),
                  element("span", {title: kFigures[colouring.key].about}, kFigures[colouring.key].name));
    const entry = (colour, what) => {
      const box = element("span", {className: "swatch"});
      box.style.background = css(colour);
      legend.append(element("span", {}, box, what));
    };
    if (!kFigures[colouring.key].logarithmic) entry(kInverted, "0 or less");
    if (colouring.key === "eta") entry(kUndefined, "triangles have none");
  }
  if (settings.irregular) for (const [kind, what] of [["3", "3 edges"], ["5", "5 edges"], ["0", "other valence"]]) legend.append(element("span", {}, markIcon(kMarks[kind]), what));
}

function markIcon({sides, colour, size}) {
  const points = Array.from({length: sides}, (_, i) => {
    const t = (2 * Math.PI * i) / sides - Math.PI / 2;
    return `${(8 + 6 * size * Math.cos(t)).toFixed(1)},${(8 + 6 * size * Math.sin(t)).toFixed(1)}`;
  });
  const icon = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  icon.setAttribute("viewBox", "0 0 16 16");
  icon.setAttribute("class", "mark");
  icon.innerHTML = `<polygon points="${points.join(" ")}" fill="${colour}" stroke="#fff"/>`;
  return icon;
}

// --- elements ---------------------------------------------------------------------------------------------

function showCard() {
  byId("card").replaceChildren(...elementCard(settings.selectedMesh, facts.frame, settings.selected, settings.colouring));
  byId("card").classList.remove("hint");
}
function select(mesh, face) {
  settings.selected = face;
  settings.selectedMesh = mesh;
  if (face === kNone) {
    byId("card").replaceChildren("Click an element to read its figures and tags.");
    byId("card").classList.add("hint");
  } else {
    showCard();
  }
  for (const pane of Object.values(panes)) pane.view.request();
}
// From the side on which the face is in front, if there is one.
function lookAt(mesh, face) {
  const nodes = mesh.nodesOf(face), isInFront = () => {
    mesh.update();
    const middle = [0, 1].map((k) => nodes.reduce((sum, v) => sum + mesh.xy[2 * v + k], 0) / nodes.length);
    return mesh.faceAt(...middle) === face;
  };
  const before = turning.angles, normal = normalOf(mesh, face);
  for (const sign of [0, 1, -1]) {
    if (sign !== 0) turning.look(anglesFrom(normal.map((x) => sign * x)));
    if (isInFront()) return;
  }
  turning.look(before);
}
function zoomTo(mesh, face) {
  if (turning) lookAt(mesh, face);
  const box = mesh.faceBounds(face), size = 4 * Math.max(box[2] - box[0], box[3] - box[1]);
  const pane = firstShown().view;
  camera.show([box[0] - size, box[1] - size, box[2] + size, box[3] + size], pane.width, pane.height, 0);
  select(mesh, face);
}

function listWorst() {
  const key = settings.colouring?.key ?? "scaled_jacobian", mesh = meshes.after, values = mesh.figures[key];
  const faces = Array.from(values.keys()).filter((f) => !Number.isNaN(values[f]) && mesh.shown[f]);
  // Ten times the least is cheaper than to sort all.
  worst = [];
  const taken = new Set();
  for (let i = 0; i < Math.min(kWorst, faces.length); ++i) {
    let least = -1;
    for (const f of faces) if (!taken.has(f) && (least < 0 || values[f] < values[least])) least = f;
    taken.add(least);
    worst.push(least);
  }
  worstAt = -1;
  byId("worst-title").textContent = key === "size" ? "Smallest ten elements" : `Worst ten by ${kFigures[key].name}`;
  byId("worst").replaceChildren(...worst.map((f, i) => element("li", {}, element("a", {href: `#element-${mesh.faceTags[f]}`, onclick: (event) => {
    event.preventDefault();
    goToWorst(i);
  }}, `${mesh.cornerCount(f) === 4 ? "quad" : "triangle"} ${mesh.faceTags[f]}`), ` ${short(values[f])}`)));
}
function goToWorst(i) {
  worstAt = (i + worst.length) % worst.length;
  if (mode === "before") setMode("after");
  zoomTo(meshes.after, worst[worstAt]);
}

// --- surfaces and groups --------------------------------------------------------------------------------------

function applyShown() {
  const off = new Set([...byId("surfaces").querySelectorAll("input")].filter((box) => !box.checked).map((box) => Number(box.value)));
  for (const pane of Object.values(panes)) {
    for (const surface of pane.mesh.surfaces) pane.mesh.shown.fill(off.has(surface.tag) ? 0 : 1, surface.first, surface.first + surface.count);
    pane.painter.noteShown();
  }
  listWorst();
  repaint();
}
function checkbox(label, checked, value, onchange) {
  return element("label", {}, element("input", {type: "checkbox", checked, value, onchange}), label);
}
function listLayers() {
  const mesh = meshes.after;
  byId("surfaces").replaceChildren(...mesh.surfaces.map((s) => checkbox(`surface ${s.tag}`, true, String(s.tag), applyShown)));
  byId("groups").replaceChildren(...mesh.groups.map((group, index) => {
    const name = `${group.name || group.tag}`, kind = ["points", "curves", "surfaces", "volumes"][group.dim];
    if (group.dim === 2)
      return checkbox(`${name} (${kind})`, true, String(index), (event) => {
        const tags = new Set(mesh.surfaces.filter((s) => s.groups.includes(index)).map((s) => s.tag));
        for (const box of byId("surfaces").querySelectorAll("input")) if (tags.has(Number(box.value))) box.checked = event.target.checked;
        applyShown();
      });
    if (group.dim !== 1) return null;
    const label = checkbox(`${name} (${kind})`, false, String(index), (event) => {
      if (event.target.checked) settings.groups.add(index);
      else settings.groups.delete(index);
      repaint();
    });
    const swatch = element("span", {className: "swatch"});
    swatch.style.background = groupColour(index);
    label.append(" ", swatch);
    return label;
  }).filter((label) => label));
  byId("groups-title").hidden = byId("groups").children.length === 0;
}

// --- view ---------------------------------------------------------------------------------------------------------

function setHome() {
  camera.home = joined(meshes.before.bounds(), meshes.after.bounds());
}
function fit() {
  if (turning) setHome();
  const pane = firstShown().view;
  camera.fit(pane.width, pane.height);
}
function look(angles) {
  turning.look(angles);
  fit();
}

function connectControls() {
  for (const button of byId("modes").children) button.onclick = () => setMode(button.value);
  byId("colour").append(...Object.entries(kFigures).map(([key, figure]) => element("option", {value: key}, figure.name)),
                        element("option", {value: "none"}, "one colour"));
  byId("colour").onchange = (event) => setColouring(event.target.value);
  for (const key of ["sides", "irregular", "boundary"])
    byId(`show-${key}`).onchange = (event) => {
      settings[key] = event.target.checked;
      drawLegend();
      repaint();
    };
  byId("fit").onclick = fit;
  byId("zoom-in").onclick = () => camera.zoom(1.5);
  byId("zoom-out").onclick = () => camera.zoom(1 / 1.5);
  byId("theme").onclick = toggleTheme;
  if (turning) connectAxes(turning, look);
  byId("copy").onclick = () => navigator.clipboard?.writeText(facts.command).then(() => { byId("copy").textContent = "copied"; });
  for (const pane of Object.values(panes))
    listenToPane(pane.view, {turning, click: (x, y) => select(pane.mesh, pane.mesh.faceAt(...pane.view.toPlane(x, y)))});
  document.addEventListener("keydown", onKey);
  onTheme(repaintFaces);
}

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest?.("select, input[type=range], textarea")) return;
  const toggle = (id) => byId(id).click();
  const modes = ["before", "after", "both", "blink"], colours = [...Object.keys(kFigures), "none"];
  const actions = {
    "+": () => camera.zoom(1.5), "=": () => camera.zoom(1.5), "-": () => camera.zoom(1 / 1.5), 0: fit, f: fit,
    1: () => setMode("before"), 2: () => setMode("after"), 3: () => setMode("both"), 4: () => setMode("blink"),
    b: () => setMode(modes[(modes.indexOf(mode) + 1) % modes.length]),
    c: () => setColouring(colours[(colours.indexOf(byId("colour").value) + 1) % colours.length]),
    e: () => toggle("show-sides"), i: () => toggle("show-irregular"), o: () => toggle("show-boundary"), d: toggleTheme,
    n: () => goToWorst(worstAt + 1), p: () => goToWorst(worstAt - 1), Escape: () => select(null, kNone),
  };
  const angles = turning && axisOfKey(event.key);
  if (angles) look(angles);
  else actions[event.key]?.();
}

function fillPage() {
  const stats = facts.stats;
  byId("subtitle").textContent = `${stats.input} → ${stats.output}`;
  byId("chips").replaceChildren(...chips(stats, countsOf(meshes.after)));
  byId("histograms").replaceChildren(...Object.keys(kFigures).map((key) => drawHistogram(key, colourings[key], meshes.before, meshes.after)));
  byId("stages").replaceChildren(stats.stages.length ? stageTable(stats.stages) : "No surface was converted.");
  byId("surface-table").replaceChildren(surfaceTable(stats.surfaces));
  byId("poor-box").hidden = Object.keys(stats.poor_quads).length === 0;
  byId("poor").replaceChildren(poorTable(stats.surfaces));
  byId("options").replaceChildren(optionList(stats.arguments));
  byId("command").textContent = facts.command;
  byId("version").textContent = `qmorph ${facts.version}`;
  for (const [side, pane] of Object.entries(panes)) byId(`caption-${side}`).textContent = `${side}: ${summaryLine(pane.mesh)}`;
  const warnings = [...stats.warnings, ...stats.surfaces.flatMap((s) => s.warnings.map((w) => `surface ${s.tag}: ${w}`))];
  byId("warnings").replaceChildren(...warnings.map((w) => element("li", {}, w)));
  byId("warnings").hidden = warnings.length === 0;
}

connectControls();
fillPage();
listLayers();
setMode("after");
setHome();
fit();
setColouring("scaled_jacobian");
select(null, kNone);
let fitted = [0, 0];
new ResizeObserver(() => {  // the first layout, a phone that is turned, two panes instead of one
  const {width, height} = firstShown().view;
  if (Math.abs(width - fitted[0]) < 1 && Math.abs(height - fitted[1]) < 1) return;
  const untouched = camera.scale === camera.fitted;
  fitted = [width, height];
  if (untouched) fit();
  else repaint();
}).observe(byId("panes"));

// For the console, and for tests.
window.qmorph = {facts, meshes, panes, camera, turning, settings, colourings, setMode, setColouring, zoomTo, select, goToWorst, fit};
