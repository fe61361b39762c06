// SPDX-License-Identifier: GPL-2.0-or-later
// The page's facts (JSON) and numbers (base64), which the program has written into it.

export function readFacts() {
  return JSON.parse(document.getElementById("facts").textContent);
}

function decode(text) {
  const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const value = new Uint8Array(128);
  for (let i = 0; i < 64; ++i) value[digits.charCodeAt(i)] = i;
  let length = text.length;
  while (length > 0 && text.charCodeAt(length - 1) === 61) --length;  // "="
  const bytes = new Uint8Array(Math.floor((length * 3) / 4));
  for (let i = 0, at = 0; i < length; i += 4) {
    const word = (value[text.charCodeAt(i)] << 18) | (value[text.charCodeAt(i + 1)] << 12) |
        ((i + 2 < length ? value[text.charCodeAt(i + 2)] : 0) << 6) | (i + 3 < length ? value[text.charCodeAt(i + 3)] : 0);
    bytes[at++] = word >> 16;
    if (at < bytes.length) bytes[at++] = (word >> 8) & 255;
    if (at < bytes.length) bytes[at++] = word & 255;
  }
  return bytes.buffer;
}

// A function from a place {type, at, count} to a typed array.
export function readNumbers() {
  const node = document.getElementById("numbers");
  const buffer = decode(node.textContent.trim());
  node.remove();  // the text is needed no more
  const types = {f32: Float32Array, f64: Float64Array, u32: Uint32Array, u8: Uint8Array, i16: Int16Array};
  return (place) => new types[place.type](buffer, place.at, place.count);
}
