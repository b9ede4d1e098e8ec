// SPDX-License-Identifier: Apache-2.0
// Alarms, signals of the regions with their last ten minutes, their limits and outlines.
import { command } from "../appliance/api.js";
import { History } from "../appliance/history.js";
import { chartCanvas, drawChart, scaleOf } from "../elements/chart.js";
import { element, setText, table } from "../elements/elements.js";
import { FigureTable, Keyed } from "../elements/figures.js";
import { Trial } from "../system/trial.js";
import { texts } from "../texts.js";
import { AlarmHistory } from "./alarm_history.js";
import { LimitLines } from "./limit_lines.js";
import { RegionEditor } from "./region_editor.js";

const kFirstSignal = "hot_spot_peak_temperature";

class Alarms {
  #rows = new Map();

  constructor(root) {
    this.said = element("p", { className: "wrong", role: "alert" });
    this.none = element("p", {}, texts.noAlarms);
    const titles = [texts.alarm, texts.state, texts.level, texts.value, texts.acknowledge];
    const { root: scrolled, body } = table(titles, texts.alarms);
    this.table = scrolled;
    this.table.hidden = true;
    this.body = body;
    const all = element("button", { type: "button" }, texts.acknowledgeAll);
    all.addEventListener("click", () => this.#acknowledge(0));
    root.append(element("h3", {}, texts.alarms), this.said, this.none, this.table, all);
  }

  show(alarms) {
    this.none.hidden = alarms.length > 0;
    this.table.hidden = alarms.length === 0;
    alarms.forEach((alarm, index) => {
      const row = this.#rows.get(alarm.name) ?? this.#addRow(alarm.name, index + 1);
      setText(row.state, alarm.state_text);
      setText(row.level, alarm.level_text);
      setText(row.value, alarm.value === null ? "–" : alarm.value.toPrecision(4));
      row.root.classList.toggle("wrong", alarm.level !== 0);
    });
  }

  #addRow(name, number) {
    const cell = (className = "") => element("td", { className });
    const row = { state: cell(), level: cell(), value: cell("figure") };
    const button = element("button", { type: "button" }, texts.acknowledge);
    button.setAttribute("aria-label", `${texts.acknowledge} ${name}`);
    button.addEventListener("click", () => this.#acknowledge(number));
    row.root = element("tr", {}, element("th", { scope: "row" }, name), row.state, row.level,
      row.value, element("td", {}, button));
    this.body.append(row.root);
    this.#rows.set(name, row);
    return row;
  }

  async #acknowledge(number) {
    const why = await command("acknowledge_alarm", { alarm: number });
    setText(this.said, why ? texts.refused(why) : "");
  }
}

class Region {
  #history = null;  // history of the selected signal
  #signals = new Set();

  constructor(name, descriptions, recipe, mayChange) {
    this.name = name;
    this.descriptions = descriptions;
    this.table = new FigureTable(descriptions);
    this.table.root.setAttribute("aria-label", texts.region(name));
    this.choice = element("select", { name: "signal" });
    this.choice.addEventListener("change", () => this.#choose());
    this.canvas = chartCanvas(texts.region(name));
    this.limits = new LimitLines(recipe, mayChange);
    recipe.addEventListener("change", () => this.#isEdited() || this.#choose());
    this.root = element("div", { "data-region": name }, element("h3", {}, texts.region(name)),
      element("label", {}, `${texts.chartOf} `, this.choice),
      element("div", { className: "strip" }, this.canvas, this.limits.svg), this.limits.fields,
      this.table.root);
  }

  // Elements being dragged are not recreated.
  #isEdited() {
    return [this.limits.svg, this.limits.fields].some((part) => part.contains(document.activeElement));
  }

  #choose() {
    if (this.choice.value && this.choice.value !== this.chosen) {
      this.chosen = this.choice.value;
      this.#history = new History({ region: this.name, figure: this.chosen });
    }
    this.limits.choose(this.name, this.choice.value);
  }

  show(region, now) {
    this.table.show(region);
    for (const [name, value] of Object.entries(region)) {
      if (typeof value === "string") continue;
      if (!this.#signals.has(name)) this.#addSignal(name);
    }
    this.#history.add(now, region[this.chosen]);
    if (this.root.offsetParent === null) return; // not shown
    this.#history.refresh(now);
    const scale = this.limits.scale(scaleOf(this.canvas, this.#history, this.limits.values));
    const unit = this.descriptions[this.chosen]?.unit ?? "";
    drawChart(this.canvas, this.#history, this.chosen, unit, now, scale);
    this.limits.draw(scale, this.canvas.clientWidth);
  }

  #addSignal(name) {
    this.#signals.add(name);
    this.choice.append(element("option", { value: name, selected: name === kFirstSignal }, name));
    if (this.choice.value === name) this.#choose();
  }
}

export class Process {
  // `mayChange`: the user may change limits and regions. `onChoice()`: another view is needed.
  constructor(root, faults, recipe, figures, mayChange, onChoice) {
    Object.assign(this, { root, recipe });
    this.alarms = new Alarms(root);
    this.none = element("p", {}, texts.noRegions);
    const list = element("div");
    this.editor = new RegionEditor(this.recipe, faults, mayChange, onChoice);
    this.happened = new AlarmHistory();
    root.append(this.happened.root, this.editor.root, ...(mayChange ? [this.#makeTrial()] : []),
      this.none, list);
    this.regions = new Keyed(list, (name) =>
      new Region(name, figures.regions ?? {}, this.recipe, mayChange));
  }

  #makeTrial() {
    const trial = new Trial("recipe", () => this.recipe.body, () => this.isShown,
      { onTried: () => this.recipe.forget() });
    const forget = element("button", { type: "button" }, texts.process.forget);
    forget.addEventListener("click", () => this.recipe.forget());
    this.recipe.addEventListener("change", () => { forget.disabled = !this.recipe.body; });
    addEventListener("hashchange", () => trial.refresh());
    trial.refresh();
    return element("section", { id: "recipe" }, element("h3", {}, texts.process.changes), trial.head,
      trial.foot, forget);
  }

  get isShown() {
    return !this.root.hidden;
  }
  get views() {
    return this.editor.views;
  }
  picture(message) {
    this.editor.picture(message);
  }

  status(status, now) {
    this.alarms.show(status.alarms ?? []);
    if (this.isShown) this.happened.refresh(status.web.alarm_events);
    const regions = status.regions ?? [];
    this.regions.keep(regions.map(({ name }) => name));
    for (const region of regions) this.regions.get(region.name).show(region, now);
    this.none.hidden = this.regions.size > 0;
  }
}
