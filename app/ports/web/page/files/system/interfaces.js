// SPDX-License-Identifier: Apache-2.0
// Tables of the interfaces, updated while shown: registers, clients, topics.
import { figureText } from "../elements/amounts.js";
import { element, field, setText, table } from "../elements/elements.js";
import { texts } from "../texts.js";

const kAgainMs = 2000;

// One table, whose rows are recreated when their number changes.
class LiveTable {
  #rows = [];

  constructor(title) {
    this.count = element("span", {});
    this.filter = field(texts.filter, { required: false, type: "search" });
    this.filter.querySelector("input").addEventListener("input", () => this.#choose());
    this.place = element("div");
    this.root = element("details", {}, element("summary", {}, title, " ", this.count), this.filter,
      this.place);
  }

  show(rows) {
    setText(this.count, `(${rows.length})`);
    if (!this.root.open || rows.length === 0) return this.place.replaceChildren();
    const names = Object.keys(rows[0]);
    if (!this.place.firstChild || this.#rows.length !== rows.length) this.#begin(names, rows.length);
    rows.forEach((row, n) => names.forEach((name, column) =>
      setText(this.#rows[n].cells[column], figureText(row[name]))));
    this.#choose();
  }

  #begin(names, count) {
    const { root, body } = table(names, this.root.firstChild.textContent);
    this.#rows = Array.from({ length: count }, () => {
      const row = body.insertRow();
      names.forEach(() => row.insertCell());
      return row;
    });
    this.place.replaceChildren(root);
  }

  #choose() {
    const wanted = this.filter.querySelector("input").value.toLowerCase();
    for (const row of this.#rows) row.hidden = !row.textContent.toLowerCase().includes(wanted);
  }
}

export class Interfaces {
  #tables = new Map();
  #again = 0;

  constructor(root) {
    this.said = element("p", { role: "status", className: "wrong" });
    this.opened = element("details", { id: "interfaces" },
      element("summary", {}, texts.interfaces), this.said);
    this.opened.addEventListener("toggle", () => this.#read());
    root.append(this.opened);
  }

  async #read() {
    clearTimeout(this.#again);
    if (!this.opened.open) return;
    const answer = document.hidden ? null : await fetch("api/v1/interfaces").catch(() => null);
    const read = await answer?.json().catch(() => null);
    setText(this.said, read?.error ? texts.refused(read.error) : "");
    if (answer?.ok && read) this.#show(read);
    this.#again = setTimeout(() => this.#read(), kAgainMs);
  }

  #show(interfaces) {
    for (const [kind, tables] of Object.entries(interfaces)) {
      for (const [name, rows] of Object.entries(tables)) this.#table(`${kind}: ${name}`).show(rows);
    }
  }

  #table(title) {
    if (!this.#tables.has(title)) {
      const made = new LiveTable(title);
      made.root.addEventListener("toggle", () => this.#read());
      this.#tables.set(title, made);
      this.opened.append(made.root);
    }
    return this.#tables.get(title);
  }
}

// Versions, and interfaces that accept commands, loaded once.
export async function showAbout(root) {
  const answer = await fetch("api/v1/about").catch(() => null);
  if (!answer?.ok) return;
  const { versions, commanders } = await answer.json();
  const { root: shown, body } = table([texts.program, texts.version], texts.about);
  for (const [name, version] of Object.entries(versions)) {
    body.append(element("tr", {}, element("th", { scope: "row" }, name), element("td", {}, version)));
  }
  root.append(element("details", { id: "about" }, element("summary", {}, texts.about),
    element("p", {}, texts.commanders(commanders)), shown));
}
