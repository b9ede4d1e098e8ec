// SPDX-License-Identifier: Apache-2.0
// Digits and units of all figures on the page. Identifiers of units are those of the interface, registers and
// recipes.
const kDecimals = [[1000, 0], [10, 1], [1, 2], [0.1, 3]];  // least magnitude, decimals
const kMostDecimals = 4;
const forms = new Map();  // by decimals

// In the page's language, which does not change while it is open.
export function decimalText(value, decimals) {
  if (!forms.has(decimals)) {
    forms.set(decimals, new Intl.NumberFormat(document.documentElement.lang, {
      minimumFractionDigits: decimals, maximumFractionDigits: decimals, useGrouping: false }));
  }
  return forms.get(decimals).format(value);
}

export function unitSymbol(unit) {
  return unit.replace("degC", "°C").replace("deg", "°").replace("mm2", "mm²").replace("/s/s", "/s²");
}

// Three to four significant digits, at most four decimals; whole numbers without decimals.
function numberText(value) {
  if (Number.isInteger(value)) return String(value);
  const [, decimals] = kDecimals.find(([least]) => Math.abs(value) >= least) ?? [0, kMostDecimals];
  return Number(value.toFixed(decimals)) === 0 ? "0" : decimalText(value, decimals);
}

// `words`: text of a code.
export function figureText(value, words) {
  if (words !== undefined) return words;
  if (value === null || value === undefined) return "–";
  return typeof value === "number" ? numberText(value) : String(value);
}

// A unit behind its number: only the sign of an angle has no space before it.
export function withUnit(text, unit) {
  const symbol = unitSymbol(unit), isAngle = /^°(?!C)/.test(symbol);
  return symbol === "" ? text : `${text}${isAngle ? "" : " "}${symbol}`;
}

export function amountText(value, unit) {
  return value === null || value === undefined ? figureText(value) : withUnit(figureText(value), unit);
}
