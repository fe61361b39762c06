// SPDX-License-Identifier: GPL-2.0-or-later
// The tables under the panes.

import {element, short, percent, whole} from "./dom.js";

function table(head, rows) {
  const classOf = (i) => (i === 0 ? "name" : head[i] === "outcome" ? "words" : "");
  const cells = (tag, list) => list.map((text, i) => element(tag, {className: classOf(i)}, String(text)));
  return element("div", {className: "scroller"}, element("table", {}, element("thead", {}, element("tr", {}, ...cells("th", head))),
                 element("tbody", {}, ...rows.map((row) => element("tr", {}, ...cells("td", row))))));
}

export function stageTable(stages) {
  return table(["stage", "seconds", "quads", "triangles", "inverted", "min SJ", "mean SJ", "irregular"], stages.map((s) => {
    const sj = s.scaled_jacobian;
    return [s.stage, s.seconds.toFixed(3), whole(s.quads), whole(s.triangles), s.inverted, sj ? short(sj.min) : "–",
            sj ? short(sj.mean) : "–", s.quads ? percent(s.irregular_share) : "–"];
  }));
}

export function surfaceTable(surfaces) {
  return table(["surface", "outcome", "before", "after", "min SJ", "mean SJ", "irregular"], surfaces.map((s) => {
    const sj = s.quality?.scaled_jacobian;
    const elements = ({triangles, quads}) => [[quads, "quad"], [triangles, "triangle"]].filter(([n]) => n > 0)
        .map(([n, what]) => `${whole(n)} ${what}${n === 1 ? "" : "s"}`).join(", ") || "none";
    return [s.name ? `${s.tag} “${s.name}”` : s.tag, s.outcome + (s.reason ? `: ${s.reason}` : ""), elements(s.before), elements(s.after),
            sj ? short(sj.min) : "–", sj ? short(sj.mean) : "–", s.quality ? percent(s.quality.irregular_share) : "–"];
  }));
}

// Quads under 0.3, worst first, and why each of them is so.
export function poorTable(surfaces) {
  const most = 200;
  const quads = surfaces.flatMap((s) => (s.poor_quads || []).map((quad) => ({surface: s.tag, ...quad})));
  quads.sort((a, b) => a.scaled_jacobian - b.scaled_jacobian);
  return table(["surface", "scaled Jacobian", "forced by", "at"], quads.slice(0, most).map((q) =>
    [q.surface, short(q.scaled_jacobian), q.because, q.where.map((x) => short(x, 4)).join(", ")]));
}

// The options that were given, one a line, and the command as it was.
export function optionList(args) {
  const rows = [];
  for (let i = 0; i < args.length; ++i) {
    if (!args[i].startsWith("-") || args[i] === "-") rows.push(["file", args[i]]);
    else if (i + 1 < args.length && !args[i + 1].startsWith("--")) rows.push([args[i], args[i + 1].startsWith("-") && isNaN(args[i + 1]) ? "" : args[++i]]);
    else rows.push([args[i], ""]);
  }
  return element("dl", {className: "options"}, ...rows.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]));
}

// `quads` and `triangles`: of the whole mesh; the other figures are those of the surfaces that are quads now.
export function chips(stats, {quads, triangles}) {
  const total = stats.total, sj = total.scaled_jacobian;
  const list = [[whole(quads), quads === 1 ? "quad" : "quads"], [whole(triangles), triangles === 1 ? "triangle" : "triangles"]];
  if (total.inverted) list.push([total.inverted, "inverted"]);
  if (sj) list.push([short(sj.min), "smallest scaled Jacobian"], [short(sj.mean), "mean scaled Jacobian"]);
  list.push([percent(total.irregular_share), "irregular nodes"]);
  if (stats.layer_quads) list.push([whole(stats.layer_quads), stats.layer_quads === 1 ? "quad of layers" : "quads of layers"]);
  const {along, across} = stats.directed_size_ratio ?? {};
  if (along?.median)
    list.push([`${short(along.median, 2)} × ${short(across.median, 2)}`, "lengths over the triangles’, along and across"]);
  if (stats.size_ratio?.median) list.push([short(stats.size_ratio.median, 2), "edge length over the input's"]);
  if (stats.in_space) list.push([short(stats.in_space.distance.centre.mean, 3), "edges from the centres to the surface"],
                                [`${short(stats.in_space.warpage_deg.p99, 1)}°`, "warpage of 99 %"]);
  list.push([`${stats.seconds.total.toFixed(2)} s`, "in all"]);
  return list.map(([value, what]) => element("li", {}, element("b", {}, value), " ", what));
}
