// SPDX-License-Identifier: GPL-2.0-or-later
// Light and dark: the system's wish unless a button says otherwise; paper is always light.

let chosen = null, printing = false;
const listeners = [];
const system = window.matchMedia("(prefers-color-scheme: dark)");

export const isDark = () => !printing && (chosen ?? system.matches);
export const onTheme = (listener) => listeners.push(listener);

function apply() {
  document.documentElement.dataset.theme = isDark() ? "dark" : "light";
  for (const listener of listeners) listener();
}
export function toggleTheme() {
  chosen = !isDark();
  apply();
}
// A colour of the style sheet.
export const themeColour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

system.addEventListener("change", apply);
window.addEventListener("beforeprint", () => { printing = true; apply(); });
window.addEventListener("afterprint", () => { printing = false; apply(); });
apply();
