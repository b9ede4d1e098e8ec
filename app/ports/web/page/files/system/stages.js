// SPDX-License-Identifier: Apache-2.0
// Processor time of a frame set by stage, compared with its deadline.
import { figureText } from "../elements/amounts.js";
import { Card } from "../elements/card.js";
import { element, setText, table } from "../elements/elements.js";
import { texts } from "../texts.js";

const kColumns = ["cpu_ms", "cpu_p50_ms", "cpu_p99_ms"];

export class Stages {
  #rows = new Map();

  constructor() {
    this.load = element("meter", { min: 0, max: 1, high: 0.8, low: 0.8, optimum: 0 });
    this.load.setAttribute("aria-label", texts.load);
    this.share = element("span", {});
    const { root: shown, body } = table(
      [texts.stage, texts.newest, texts.median, texts.worst], texts.stages);
    this.body = body;
    this.card = new Card("stages", texts.stages);
    this.card.append(element("p", {}, texts.load, " ", this.load, " ", this.share), shown);
    this.root = this.card.root;
  }

  status({ stages = [], system: { load } }) {
    const share = load === null ? figureText(load) : `${(100 * load).toFixed(0)} %`;
    this.card.say(texts.cards.load(share), load > 1);
    if (!this.card.isOpen) return;
    this.load.value = load ?? 0;
    setText(this.share, share);
    for (const stage of stages) {
      const cells = this.#rows.get(stage.name) ?? this.#add(stage.name);
      kColumns.forEach((column, n) => setText(cells[n], figureText(stage[column])));
    }
  }

  #add(name) {
    const cells = kColumns.map(() => element("td", { className: "figure" }));
    this.body.append(element("tr", {}, element("th", { scope: "row" }, name), ...cells));
    this.#rows.set(name, cells);
    return cells;
  }
}
