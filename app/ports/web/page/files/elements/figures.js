// SPDX-License-Identifier: Apache-2.0
// Tables of figures that are updated in place.
import { texts } from "../texts.js";
import { figureText, unitSymbol } from "./amounts.js";
import { element, setText, table } from "./elements.js";

// The title of a figure with its identifier beside it; without a title only that.
export const titled = (name, { title } = {}) =>
  (title ? [title, " ", element("code", { className: "quiet" }, name)] : [name]);

// The same as one text.
export const titleText = (name, { title } = {}) => (title ? `${title} (${name})` : name);

// Table of one component: {name: value}, with texts of codes as {name_text: text}.
export class FigureTable {
  #rows = new Map();

  constructor(descriptions) {
    this.descriptions = descriptions;
    const { root, body } = table([texts.signal, texts.value, texts.unit, texts.meaning]);
    root.classList.add("figures");
    this.root = root;
    this.body = body;
  }

  show(component) {
    for (const [name, value] of Object.entries(component)) {
      if (name === "name" || name.endsWith("_text")) continue;
      const row = this.#rows.get(name) ?? this.#addRow(name);
      setText(row, figureText(value, component[`${name}_text`]));
    }
  }

  #addRow(name) {
    const about = this.descriptions[name] ?? {};
    const value = element("td", { className: "figure" });
    this.body.append(element("tr", {}, element("th", { scope: "row" }, ...titled(name, about)), value,
      element("td", {}, unitSymbol(about.unit ?? "")), element("td", {}, about.description ?? "")));
    this.#rows.set(name, value);
    return value;
  }
}

// Creates an element once for each name, in `root`.
export class Keyed {
  #made = new Map();

  constructor(root, make) {
    this.root = root;
    this.make = make;
  }
  get(name) {
    if (!this.#made.has(name)) {
      const made = this.make(name);
      this.#made.set(name, made);
      this.root.append(made.root);
    }
    return this.#made.get(name);
  }
  // Removes the others.
  keep(names) {
    for (const [name, made] of this.#made) {
      if (names.includes(name)) continue;
      made.root.remove();
      this.#made.delete(name);
    }
  }
  get size() {
    return this.#made.size;
  }
}
