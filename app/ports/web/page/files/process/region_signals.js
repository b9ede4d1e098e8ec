// SPDX-License-Identifier: Apache-2.0
// Signals of one region: the last ten minutes of one or two of them, the limits of the first, the values of all.
import { History } from "../appliance/history.js";
import { Chart } from "../elements/chart.js";
import { element } from "../elements/elements.js";
import { FigureTable, titleText } from "../elements/figures.js";
import { texts } from "../texts.js";
import { LimitLines } from "./limit_lines.js";

const kFirstSignal = "hot_spot_peak_temperature";

const option = (value, text, selected = false) => element("option", { value, selected }, text);

export class RegionSignals {
  #histories = new Map();  // histories of the chosen signals, in the order of the choices
  #signals = new Set();
  #read = null;            // the recipe that the limits are of

  // `descriptions` of the signals; `mayChange`: the user may change limits.
  constructor(name, descriptions, recipe, mayChange) {
    Object.assign(this, { name, descriptions, recipe, mayChange });
    this.table = new FigureTable(descriptions);
    this.table.root.setAttribute("aria-label", texts.region(name));
    this.choice = element("select", { name: "signal", "aria-label": texts.chartOf });
    this.other = element("select", { name: "compared", "aria-label": texts.process.compared },
      option("", texts.process.compare));
    for (const choice of [this.choice, this.other]) choice.addEventListener("change", () => this.#choose());
    this.limits = new LimitLines(recipe, mayChange);
    this.chart = new Chart(texts.region(name), this.limits.svg);
    this.add = element("button", { type: "button", hidden: true }, texts.process.addLimit);
    this.add.addEventListener("click", () => this.#addLimit());
    this.typed = element("details", {}, element("summary", {}, texts.process.typed), this.limits.fields);
    this.all = element("details", { className: "all" }, element("summary", {}, texts.process.allSignals),
      this.table.root);
    this.root = element("div", { "data-region": name }, element("div", { className: "head" },
      element("h3", {}, texts.region(name)), this.choice, this.other, this.add),
      this.chart.root, this.typed, this.all);
  }

  choose(signal) {
    this.choice.value = signal;
    this.#choose();
  }

  // The recipe or its unsent changes differ. Elements in use are recreated only if the recipe was read again.
  update() {
    if (this.recipe.stated !== this.#read || !this.#isEdited()) this.#choose();
  }

  // True: an element is dragged or typed into.
  #isEdited() {
    return [this.limits.svg, this.limits.fields].some((part) => part.contains(document.activeElement));
  }

  #choose() {
    this.#read = this.recipe.stated;
    const chosen = [this.choice.value, this.other.value].filter(Boolean);
    this.#histories = new Map(chosen.map((figure) =>
      [figure, this.#histories.get(figure) ?? new History({ region: this.name, figure })]));
    this.limits.choose(this.name, this.choice.value);
    this.typed.hidden = this.limits.fields.children.length === 0;
    this.add.hidden = !this.typed.hidden || !this.mayChange || !this.choice.value;
  }

  // The signal gets an alarm of its own, whose limits are typed.
  #addLimit() {
    const signal = this.choice.value;
    this.recipe.addAlarm(this.name, signal, this.descriptions[signal]?.unit ?? "");
    this.typed.open = true;
    this.limits.fields.querySelector("input").focus();
  }

  show(region, now) {
    if (this.all.open) this.table.show(region);
    for (const [name, value] of Object.entries(region)) {
      if (typeof value !== "string" && !this.#signals.has(name)) this.#addSignal(name);
    }
    for (const [figure, history] of this.#histories) history.add(now, region[figure]);
    if (this.root.offsetParent === null) return; // not shown
    const series = [...this.#histories].map(([figure, history]) => {
      history.refresh(now);
      const { title, unit = "" } = this.descriptions[figure] ?? {};
      return { history, name: title || figure, unit };
    });
    const axis = this.chart.draw(series, now, this.limits.values, this.limits.held);
    this.limits.draw(axis, this.chart.width);
  }

  #addSignal(name) {
    this.#signals.add(name);
    const text = titleText(name, this.descriptions[name]);
    this.choice.append(option(name, text, name === kFirstSignal));
    this.other.append(option(name, text));
    if (this.choice.value === name) this.#choose();
  }
}
