// SPDX-License-Identifier: GPL-2.0-or-later
// Histograms as SVG: bars for after, in the colours of the scale, a line for before.

import {element, short, whole} from "./dom.js";
import {kFigures, css} from "./colours.js";

const kBins = 40, kWidth = 320, kHeight = 120, kFoot = 22;
const svg = (tag, attributes, ...children) => {
  const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children);
  return node;
};

// Shares of the values in each bin; `count` of them have a figure.
export function histogram(values, colouring) {
  const bins = new Float64Array(kBins);
  let count = 0;
  for (const value of values) {
    if (Number.isNaN(value)) continue;
    const t = colouring.position(value);
    ++bins[Math.min(kBins - 1, Math.max(0, Math.floor(t * kBins)))];
    ++count;
  }
  return {bins: bins.map((n) => (count ? n / count : 0)), count};
}

function summary(values) {
  let least = Infinity, most = -Infinity, sum = 0, count = 0;
  for (const v of values) {
    if (Number.isNaN(v)) continue;
    least = Math.min(least, v), most = Math.max(most, v), sum += v, ++count;
  }
  return {least, most, mean: sum / count, count};
}

export function drawHistogram(key, colouring, before, after) {
  const figure = kFigures[key];
  const shares = {before: histogram(before.figures[key], colouring), after: histogram(after.figures[key], colouring)};
  const highest = Math.max(...shares.before.bins, ...shares.after.bins, 1e-9);
  // Square roots: a few bad elements among many good ones can still be seen.
  const y = (share) => kHeight * (1 - Math.sqrt(share / highest));
  const chart = svg("svg", {viewBox: `-1 -4 ${kWidth + 2} ${kHeight + kFoot + 4}`, role: "img", "aria-label": `${figure.name}: histogram before and after`});
  const wide = kWidth / kBins;
  shares.after.bins.forEach((share, i) => {
    if (share === 0) return;
    const middle = colouring.value((i + 0.5) / kBins);
    const bar = svg("rect", {x: i * wide, y: y(share), width: wide - 0.6, height: kHeight - y(share), class: "bar"});
    bar.style.fill = css(colouring.colour(middle));
    bar.append(svg("title", {}, `around ${short(middle)}: ${(100 * share).toFixed(2)} % after, ${(100 * shares.before.bins[i]).toFixed(2)} % before`));
    chart.append(bar);
  });
  if (shares.before.count > 0) {
    let path = `M0 ${kHeight}`;
    shares.before.bins.forEach((share, i) => { path += `L${(i * wide).toFixed(1)} ${y(share).toFixed(1)}H${((i + 1) * wide).toFixed(1)}`; });
    chart.append(svg("path", {d: `${path}L${kWidth} ${kHeight}`, class: "before-line"}));
  }
  chart.append(svg("line", {x1: 0, y1: kHeight, x2: kWidth, y2: kHeight, class: "axis"}));
  for (const t of [0, 0.25, 0.5, 0.75, 1]) {
    const label = svg("text", {x: t * kWidth, y: kHeight + 16, "text-anchor": t === 0 ? "start" : t === 1 ? "end" : "middle"});
    label.textContent = short(colouring.value(t), 2);
    chart.append(label);
  }
  const line = (name, mesh) => {
    const s = summary(mesh.figures[key]);
    return s.count ? `${name}: min ${short(s.least)}, mean ${short(s.mean)}${figure.logarithmic ? `, max ${short(s.most)}` : ""} (${whole(s.count)})`
                   : `${name}: not defined for triangles`;
  };
  return element("figure", {className: "histogram"}, element("figcaption", {title: figure.about}, figure.name), chart,
                 element("p", {className: "small"}, element("span", {className: "swatch-after"}), line("after", after)),
                 element("p", {className: "small"}, element("span", {className: "swatch-before"}), line("before", before)));
}
