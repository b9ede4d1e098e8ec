// SPDX-License-Identifier: Apache-2.0
// Figures of the interfaces and, updated while shown, their tables: registers, clients, topics.
import { patience } from "../appliance/api.js";
import { figureText } from "../elements/amounts.js";
import { Card } from "../elements/card.js";
import { element, field, setText, table } from "../elements/elements.js";
import { texts } from "../texts.js";
import { Components } from "./components.js";
import { kKindsOfOverview } from "./overview.js";

const kAgainMs = 2000;
// Kinds of the status that other parts of the page show, or that are not a component.
const kElsewhere = new Set(["stamp", "age", "silence", "regions", "alarms", "stages", ...kKindsOfOverview]);

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

  // `isShown()`: its page is open. `mayRead`: the user may read the tables.
  constructor(figures, isShown, mayRead) {
    this.isShown = isShown;
    this.said = element("p", { role: "status", className: "wrong" });
    this.components = new Components(figures);
    this.card = new Card("interfaces", texts.interfaces);
    this.card.append(this.components.root, this.said);
    if (mayRead) this.card.whenOpened(() => this.#read());
    this.root = this.card.root;
  }

  status(status) {
    const { connections, streams } = status.web;
    const isFaulty = status.system.interface_faults !== 0 || status.system.line_faults !== 0;
    this.card.say(isFaulty ? texts.cards.interfaceFault : texts.cards.connected(connections, streams), isFaulty);
    if (!this.card.isOpen) return;
    for (const [kind, part] of Object.entries(status)) {
      if (!kElsewhere.has(kind)) this.components.show(kind, part);
    }
  }

  async #read() {
    clearTimeout(this.#again);
    if (!this.card.isOpen) return;
    const isSeen = this.isShown() && !document.hidden;
    const answer = isSeen ? await fetch("api/v1/interfaces", patience()).catch(() => null) : null;
    const read = await answer?.json().catch(() => null);
    setText(this.said, read?.error ? texts.refused(read.error) : "");
    if (answer?.ok && read) this.#show(read);
    clearTimeout(this.#again); // of a table that was opened meanwhile
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
      this.card.append(made.root);
    }
    return this.#tables.get(title);
  }
}
