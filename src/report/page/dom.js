// SPDX-License-Identifier: GPL-2.0-or-later
// Small helpers for the document.

export const byId = (id) => document.getElementById(id);

// element("a", {href: "#", onclick: f}, "text", otherElement, ...)
export function element(tag, properties = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in node && name !== "list") node[name] = value;
    else node.setAttribute(name, value);
  }
  node.append(...children.filter((child) => child !== null));
  return node;
}

// "0.983", "1.2e-5": for people.
export function short(value, digits = 3) {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return value.toExponential(2);
  if (size >= 1000) return value.toFixed(0);
  return size < 0.1 ? String(Number(value.toPrecision(digits))) : value.toFixed(digits);
}

export const percent = (share) => `${(100 * share).toFixed(1)} %`;

// 12 345, with narrow spaces.
export const whole = (count) => String(count).replace(/\B(?=(\d{3})+$)/g, " ");
