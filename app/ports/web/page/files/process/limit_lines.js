// SPDX-License-Identifier: Apache-2.0
// Limits of alarms as lines over a chart, dragged or moved by keys, and typed below it.
import { element } from "../elements/elements.js";
import { figureText } from "../elements/figures.js";
import { drawn, followDrag, kKeys, place } from "../elements/shapes.js";
import { texts } from "../texts.js";

export const kLimits = ["low_alarm", "low_warning", "high_warning", "high_alarm"];
const kSteps = 200;  // steps of a key or a dragged pixel per height of the chart
const kLargeStep = 10;

// A round step for a range: 1, 2 or 5 times a power of ten.
function stepOf(span) {
  const raw = span / kSteps, power = 10 ** Math.floor(Math.log10(raw));
  return [1, 2, 5, 10].find((one) => one * power >= raw) * power;
}

const rounded = (value, step) => Number((Math.round(value / step) * step).toPrecision(10));

export class LimitLines {
  #lines = new Map();  // lines by alarm and limit
  #held = null;        // scale during a drag

  constructor(recipe, mayChange) {
    this.recipe = recipe;
    this.mayChange = mayChange;
    this.svg = drawn("svg", { role: "group", "aria-label": texts.process.limits });
    this.fields = element("div", { className: "limits" });
  }

  // Limits of a region's signal.
  choose(region, signal) {
    this.alarms = this.recipe.alarmsOf(region, signal);
    this.svg.replaceChildren();
    this.#lines.clear();
    this.fields.replaceChildren(...this.alarms.map((alarm) => this.#fieldsOf(alarm)));
  }

  #fieldsOf(alarm) {
    const names = [...kLimits, "hysteresis"];
    return element("fieldset", {}, element("legend", {}, texts.process.limitsOf(alarm.alarm, alarm.unit)),
      ...names.map((name) => {
        const input = element("input", { type: "number", step: "any", name,
          value: this.recipe.limit(alarm, name) ?? "", readOnly: !this.mayChange });
        input.addEventListener("change", () => {
          if (!input.validity.badInput) {
            this.recipe.setLimit(alarm, name, input.value === "" ? null : Number(input.value));
          }
        });
        return element("label", {}, texts.process[name], " ", input);
      }));
  }

  // Values that a chart must include.
  get values() {
    return (this.alarms ?? []).flatMap((alarm) => kLimits.map((name) => this.recipe.limit(alarm, name)))
      .filter((value) => value !== null);
  }

  scale(measured) {
    return this.#held ?? measured;
  }

  draw(scale, width) {
    if (!scale) return;
    place(this.svg, { viewBox: `0 0 ${width} ${scale.height}` });
    for (const alarm of this.alarms ?? []) {
      for (const name of kLimits) this.#drawOne(alarm, name, scale, width);
    }
    this.drawn = scale;
  }

  #drawOne(alarm, name, scale, width) {
    const value = this.recipe.limit(alarm, name), key = `${alarm.alarm} ${name}`;
    const shapes = this.#lines.get(key) ?? this.#add(alarm, name, key);
    place(shapes.root, { visibility: value === null ? "hidden" : "visible" });
    if (value === null) return;
    const back = this.recipe.limit(alarm, "hysteresis") * (name.startsWith("low") ? 1 : -1);
    const y = scale.y(value), end = scale.y(value + back);
    place(shapes.band, { x: 0, width, y: Math.min(y, end), height: Math.abs(end - y) });
    for (const line of [shapes.line, shapes.grip]) place(line, { x1: 0, x2: width, y1: y, y2: y });
    place(shapes.text, { x: width - 4, y: y - 3 });
    const words = `${texts.process[name]} ${figureText(value)} ${alarm.unit}`;
    if (shapes.text.textContent !== words) shapes.text.textContent = words;
    place(shapes.root, { "aria-valuenow": value, "aria-valuetext": words,
      "aria-valuemin": Math.min(scale.low, value), "aria-valuemax": Math.max(scale.high, value) });
  }

  #add(alarm, name, key) {
    const shapes = { band: drawn("rect"), line: drawn("line"), grip: drawn("line", { class: "grip" }),
      text: drawn("text", { "text-anchor": "end" }) };
    shapes.root = drawn("g", { class: `limit ${name.endsWith("alarm") ? "alarm" : "warning"}`,
      "data-limit": key, "aria-label": texts.process.limitOf(texts.process[name], alarm.alarm),
      ...(this.mayChange ? { role: "slider", tabindex: 0, "aria-orientation": "vertical" }
        : { role: "img" }) }, ...Object.values(shapes));
    if (this.mayChange) {
      shapes.grip.addEventListener("pointerdown", (event) => this.#drag(event, shapes, alarm, name));
      shapes.root.addEventListener("keydown", (event) => this.#press(event, alarm, name));
    }
    this.svg.append(shapes.root);
    this.#lines.set(key, shapes);
    return shapes;
  }

  #set(alarm, name, value) {
    this.recipe.setLimit(alarm, name, value);
    const fields = this.fields.children[this.alarms.indexOf(alarm)];
    fields.querySelector(`[name=${name}]`).value = value;
    this.draw(this.drawn, this.svg.clientWidth);
  }

  // The scale is fixed meanwhile; otherwise the line would run away from the pointer.
  #drag(event, { grip, root }, alarm, name) {
    if (event.button !== 0 || !this.drawn) return;
    root.focus();
    const scale = this.#held = this.drawn, before = this.recipe.limit(alarm, name);
    const offset = scale.y(before) - this.#yOf(event), step = stepOf(scale.span);
    followDrag(grip, event,
      (moved) => this.#set(alarm, name, rounded(scale.value(this.#yOf(moved) + offset), step)),
      (ended, isDone) => {
        this.#held = null;
        if (!isDone) this.#set(alarm, name, before);
      });
  }

  #yOf({ clientY }) {
    return clientY - this.svg.getBoundingClientRect().top;
  }

  #press(event, alarm, name) {
    const [right, down] = kKeys[event.key] ?? [];
    if (right === undefined || !this.drawn) return;
    event.preventDefault();
    const step = stepOf(this.drawn.span) * (event.shiftKey ? kLargeStep : 1);
    this.#set(alarm, name, rounded(this.recipe.limit(alarm, name) + (right - down) * step, step));
  }
}
