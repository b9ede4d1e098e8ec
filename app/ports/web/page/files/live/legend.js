// SPDX-License-Identifier: Apache-2.0
// Meaning of the colours of one-channel cameras, changed by users who may command, for all users.
import { NewestCommand } from "../appliance/newest_command.js";
import { amountText, unitSymbol } from "../elements/amounts.js";
import { element, setText } from "../elements/elements.js";
import { texts } from "../texts.js";

const kSettleMs = 1000; // same as for a pointed view

// Legend of one camera of a view.
class SourceLegend {
  #changed = -Infinity; // time of performance.now()

  // `change(command, what)` is called for a choice; null: not permitted.
  constructor({ camera, unit }, maps, change) {
    Object.assign(this, { camera, unit, maps, change });
    this.first = element("span");
    this.ramp = element("span", { className: "ramp" });
    this.last = element("span");
    this.root = element("div", {}, element("p", { className: "legend" }, this.first, this.ramp, this.last));
    if (change) this.root.append(this.#makeForm());
  }

  #makeForm() {
    this.map = element("select", { name: "colour_map" },
      ...this.maps.map(({ name }) => element("option", { value: name }, name)));
    this.map.addEventListener("change", () => this.#give("set_colour_map",
      { colour_map: this.map.selectedIndex }));
    this.ends = ["first", "last"].map((name) => {
      const input = element("input", { type: "number", step: "any", name });
      input.addEventListener("change", () => this.#spread());
      return input;
    });
    this.form = element("details", { className: "colours" },
      element("summary", {}, texts.coloursOf(this.camera)),
      element("label", {}, texts.colourMap, " ", this.map), " ",
      element("label", {}, texts.firstColour(unitSymbol(this.unit)), " ", this.ends[0]), " ",
      element("label", {}, texts.lastColour(unitSymbol(this.unit)), " ", this.ends[1]));
    return this.form;
  }

  #spread() {
    const [first, last] = this.ends.map(({ valueAsNumber }) => valueAsNumber);
    if (Number.isFinite(first) && Number.isFinite(last)) this.#give("set_colour_range", { first, last });
  }

  #give(command, what) {
    this.#changed = performance.now();
    this.change(command, what);
  }

  // Colours of the displayed picture.
  follow({ colour_map: name, range }) {
    const { stops } = this.maps.find((map) => map.name === name);
    this.shown = { camera: this.camera, unit: this.unit, range, stops };
    setText(this.first, `${this.camera} ${amountText(range[0], this.unit)}`);
    setText(this.last, amountText(range[1], this.unit));
    if (this.ramp.dataset.map !== name) {
      this.ramp.dataset.map = name;
      this.ramp.style.background = `linear-gradient(to right, ${stops.join(", ")})`;
    }
    const isBusy = this.form?.contains(document.activeElement) && this.form.open;
    if (!this.form || isBusy || performance.now() - this.#changed < kSettleMs) return;
    this.map.value = name;
    this.ends.forEach((input, n) => { input.value = range[n]; });
  }
}

export class Legend {
  // A view and colour maps from /api/v1/views; `say(what)`: reason of a refused change; empty: accepted.
  constructor({ index, sources }, maps, mayCommand, say) {
    const commands = sources.map(() => ({}));
    const change = (source) => (name, what) => {
      commands[source][name] ??= new NewestCommand(name, (why) => say(why ? texts.refused(why) : ""));
      commands[source][name].send({ view: index, source, ...what });
    };
    this.sources = sources.map((source, n) => new SourceLegend(source, maps, mayCommand ? change(n) : null));
    this.root = element("div");
  }

  // `colours` in the displayed picture, by source; null: the camera's own.
  follow(colours) {
    this.sources.forEach((source, n) => {
      if (!colours[n]) return source.root.remove();
      source.follow(colours[n]);
      if (!source.root.isConnected) this.root.append(source.root);
    });
  }

  // {camera, unit, range, stops} of each coloured camera in the displayed picture.
  get shown() {
    return this.sources.filter(({ root }) => root.parentNode).map(({ shown }) => shown);
  }
}
