// SPDX-License-Identifier: Apache-2.0
// Alarms, and the regions with their signals, limits and outlines.
import { command } from "../appliance/api.js";
import { amountText } from "../elements/amounts.js";
import { element, setText, table } from "../elements/elements.js";
import { Keyed } from "../elements/figures.js";
import { Trial } from "../system/trial.js";
import { texts } from "../texts.js";
import { AlarmHistory } from "./alarm_history.js";
import { RegionEditor } from "./region_editor.js";
import { RegionSignals } from "./region_signals.js";

class Alarms {
  #rows = new Map();

  // `descriptions` of the signals.
  constructor(root, descriptions) {
    this.descriptions = descriptions;
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
      setText(row.value, amountText(alarm.value, this.descriptions[alarm.signal_text]?.unit ?? ""));
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

export class Process {
  // `mayChange`: the user may change limits and regions. `onChoice()`: another view is needed.
  constructor(root, faults, recipe, figures, mayChange, onChoice) {
    Object.assign(this, { root, recipe });
    this.alarms = new Alarms(root, figures.regions ?? {});
    this.none = element("p", {}, texts.noRegions);
    const list = element("div");
    this.editor = new RegionEditor(this.recipe, faults, mayChange, onChoice);
    this.happened = new AlarmHistory();
    root.append(this.happened.root, this.editor.root, ...(mayChange ? [this.#makeTrial()] : []),
      this.none, list);
    this.regions = new Keyed(list, (name) =>
      new RegionSignals(name, figures.regions ?? {}, this.recipe, mayChange));
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
