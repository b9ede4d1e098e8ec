// SPDX-License-Identifier: Apache-2.0
// A signal of an event, chosen among those that were recorded, as a chart.
import { element, setText } from "../elements/elements.js";
import { titleText } from "../elements/figures.js";
import { texts } from "../texts.js";
import { ask } from "./ask.js";
import { SignalChart } from "./signal_chart.js";

const kFirstFigure = "hot_spot_peak_temperature";

const keyOf = ({ region, figure }) => JSON.stringify([region, figure]);

// Points {at, low, high} of a signal, oldest first.
const pointsOf = ({ times, low, high }) => times
  .map((time, n) => ({ at: Date.parse(time), low: low[n], high: high[n] }))
  .sort((one, other) => one.at - other.at);

export class EventSignals {
  #event = null;
  #signals = new Map();  // {region, figure, unit} by key
  #wanted = "";          // key of the signal that the user chose last, for the next event
  #replay = 0;           // number of the replay whose values are drawn, too; 0: none
  #asked = 0;            // counts requests; only the answer to the newest is shown

  // `figures`: descriptions by kind of component. `moves`: see SignalChart.
  constructor(figures, moves) {
    this.figures = figures;
    this.choice = element("select", { name: "signal" });
    this.choice.addEventListener("change", () => {
      this.#wanted = this.choice.value;
      this.#load();
    });
    this.chart = new SignalChart(moves);
    this.said = element("p", { role: "status" });
    this.shown = element("div", { hidden: true },
      element("p", { className: "buttons" }, element("label", {}, texts.chartOf, " ", this.choice)), this.chart.root);
    this.root = element("div", { className: "signals" }, this.shown, this.said);
  }

  // Null closes it.
  async open(event) {
    this.#event = event;
    this.shown.hidden = true;
    setText(this.said, "");
    const read = event && await this.#ask("signals", {});
    if (!read) return;
    this.#signals = new Map((read.signals ?? []).map((signal) => [keyOf(signal), signal]));
    setText(this.said, read.error ? texts.refused(read.error)
      : this.#signals.size === 0 ? texts.recordings.noSignals : "");
    if (this.#signals.size === 0) return;
    this.#list();
    this.shown.hidden = false;
    await this.#load();
  }

  setMoment(moment) {
    this.chart.setMoment(moment);
  }
  setRange(from, to) {
    this.chart.setRange(from, to);
  }

  // Draws the values that a replay computed, too; 0: none.
  setReplay(number) {
    if (number === this.#replay) return;
    this.#replay = number;
    if (!this.shown.hidden) this.#load();
  }

  #descriptionOf({ region, figure }) {
    return (region ? this.figures.regions : this.figures.machine)?.[figure];
  }

  #list() {
    const all = [...this.#signals], regions = [...new Set(all.map(([, { region }]) => region))];
    this.choice.replaceChildren(...regions.map((name) => element("optgroup",
      { label: name ? texts.region(name) : texts.cards.titles.machine },
      ...all.filter(([, { region }]) => region === name).map(([value, signal]) =>
        element("option", { value }, titleText(signal.figure, this.#descriptionOf(signal)))))));
    this.choice.value = this.#first();
  }

  // The signal that was chosen in the event before; else that of the alarm. In events of an earlier version the cause
  // begins with it.
  #first() {
    const { alarm, cause } = this.#event, all = [...this.#signals];
    if (this.#signals.has(this.#wanted)) return this.#wanted;
    const isOfAlarm = ({ region, figure }) => (alarm ? region === alarm.region && figure === alarm.signal
      : cause.startsWith(`${region}: ${figure} `));
    const [key] = all.find(([, signal]) => isOfAlarm(signal))
      ?? all.find(([, { figure }]) => figure === kFirstFigure) ?? all[0];
    return key;
  }

  async #load() {
    const signal = this.#signals.get(this.choice.value), { region, figure } = signal, event = this.#event;
    const number = this.#replay;
    const read = await this.#ask("signal", { region, figure });
    if (!read) return;
    setText(this.said, read.error ? texts.refused(read.error) : "");
    if (read.error) return;
    const show = (tried) => this.chart.show(pointsOf(read), this.#descriptionOf(signal)?.title || figure, read.unit,
      Date.parse(event.triggered || event.first), tried);
    show([]);
    if (!number || !region) return;
    const asked = this.#asked;
    const tried = await ask("replayed_signal", { number, region, figure },
      () => asked === this.#asked && event === this.#event && number === this.#replay);
    if (tried?.times) show(pointsOf(tried));
  }

  // The answer; null: something else was asked for meanwhile.
  #ask(path, query) {
    const asked = ++this.#asked, event = this.#event;
    return ask(path, { event: event.name, ...query }, () => asked === this.#asked && event === this.#event);
  }
}
