// SPDX-License-Identifier: GPL-2.0-or-later
// What is known about the element that was clicked.

import {element, short, whole} from "./dom.js";
import {inSpace} from "./mesh.js";
import {kFigures, kUndefined, css} from "./colours.js";

// Interior angles in degrees and lengths of the sides, in space.
export function shapeOf(points) {
  const n = points.length;
  const minus = (a, b) => a.map((v, i) => v - b[i]);
  const length = (v) => Math.hypot(...v);
  const dot = (a, b) => a.reduce((sum, v, i) => sum + v * b[i], 0);
  return {
    angles: points.map((p, i) => {
      const a = minus(points[(i + 1) % n], p), b = minus(points[(i + n - 1) % n], p);
      return (Math.acos(Math.min(1, Math.max(-1, dot(a, b) / (length(a) * length(b))))) * 180) / Math.PI;
    }),
    sides: points.map((p, i) => length(minus(points[(i + 1) % n], p))),
  };
}

const groupName = (group) => group.name ? `“${group.name}”` : `group ${group.tag}`;

export function elementCard(mesh, frame, face, colouring) {
  const nodes = mesh.nodesOf(face), surface = mesh.surfaceOf(face);
  const points = nodes.map((v) => inSpace(mesh, frame, v));
  const shape = shapeOf(points);
  const rows = [["surface", surface.tag]];
  const groups = surface.groups.map((g) => groupName(mesh.groups[g]));
  if (groups.length) rows.push(["physical group", groups.join(", ")]);
  for (const [key, figure] of Object.entries(kFigures)) {
    const value = mesh.figures[key][face];
    rows.push([figure.name, Number.isNaN(value) ? "not defined" : short(value)]);
  }
  rows.push(["angles", shape.angles.map((a) => `${a.toFixed(1)}°`).join("  ")]);
  rows.push(["sides", shape.sides.map((s) => short(s)).join("  ")]);
  const colour = colouring ? css(colouring.colour(mesh.figures[colouring.key][face])) : css(kUndefined);
  const swatch = element("span", {className: "swatch"});
  swatch.style.background = colour;
  const number = (x) => String(Number(x.toPrecision(7)));
  return [
    element("h3", {}, swatch, `${nodes.length === 4 ? "Quad" : "Triangle"} ${mesh.faceTags[face]}`),
    element("dl", {}, ...rows.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, String(value))])),
    element("table", {className: "nodes"}, element("thead", {}, element("tr", {}, ...["node", "x", "y", "z"].map((t) => element("th", {}, t)))),
            element("tbody", {}, ...nodes.map((v, i) => element("tr", {}, element("td", {}, mesh.nodeTags[v] ? String(mesh.nodeTags[v]) : "–"),
                                                               ...points[i].map((x) => element("td", {}, number(x))))))),
  ];
}

export function countsOf(mesh) {
  let quads = 0;
  for (let f = 0; f < mesh.faceCount; ++f) quads += mesh.cornerCount(f) === 4;
  return {quads, triangles: mesh.faceCount - quads};
}

export function summaryLine(mesh) {
  const {quads, triangles} = countsOf(mesh);
  return [[quads, "quad"], [triangles, "triangle"]].filter(([n]) => n).map(([n, what]) => `${whole(n)} ${what}${n === 1 ? "" : "s"}`).join(", ");
}
