// Alarms, signals of the regions and their last ten minutes.
import { command } from "./api.js";
import { drawChart, History } from "./chart.js";
import { element, setText, table } from "./elements.js";
import { FigureTable, Keyed } from "./figures.js";
import { texts } from "./texts.js";

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
  #histories = new Map();

  constructor(name, descriptions) {
    this.descriptions = descriptions;
    this.table = new FigureTable(descriptions);
    this.table.root.setAttribute("aria-label", texts.region(name));
    this.choice = element("select");
    this.canvas = element("canvas", { className: "chart", role: "img" });
    this.root = element("div", {}, element("h3", {}, texts.region(name)),
      element("label", {}, `${texts.chartOf} `, this.choice), this.canvas, this.table.root);
  }

  show(region, now) {
    this.table.show(region);
    for (const [name, value] of Object.entries(region)) {
      if (typeof value === "string") continue;
      if (!this.#histories.has(name)) this.#addSignal(name);
      this.#histories.get(name).add(now, value);
    }
    const name = this.choice.value;
    if (this.root.offsetParent === null) return; // not shown
    drawChart(this.canvas, this.#histories.get(name), name,
      this.descriptions[name]?.unit ?? "", now);
  }

  #addSignal(name) {
    this.#histories.set(name, new History());
    this.choice.append(element("option", { value: name, selected: name === kFirstSignal }, name));
  }
}

export class Process {
  constructor(root, figures) {
    this.alarms = new Alarms(root);
    this.none = element("p", {}, texts.noRegions);
    const list = element("div");
    root.append(this.none, list);
    this.regions = new Keyed(list, (name) => new Region(name, figures.regions ?? {}));
  }

  status(status, now) {
    this.alarms.show(status.alarms ?? []);
    for (const region of status.regions ?? []) this.regions.get(region.name).show(region, now);
    this.none.hidden = this.regions.size > 0;
  }
}
