// SPDX-License-Identifier: Apache-2.0
// Limits of alarms in a chart, as lines that are dragged or moved by keys, with the ranges beyond them shaded; and
// typed below it.
import { amountText, figureText, unitSymbol } from "../elements/amounts.js";
import { rounded, roundStep } from "../elements/axis.js";
import { element, setText } from "../elements/elements.js";
import { drawn, followDrag, kKeys, place } from "../elements/shapes.js";
import { texts } from "../texts.js";

export const kLimits = ["low_alarm", "low_warning", "high_warning", "high_alarm"];
const kSteps = 200;  // steps of a key or a dragged pixel per height of the chart
const kLargeStep = 10;
const kTextPx = 13;  // least distance of two labels
const kOuter = { low_warning: "low_alarm", high_warning: "high_alarm" };

const stepOf = (span) => roundStep(span / kSteps);

// A rectangle between two heights, as far as it is in the plot.
function rectangle({ height }, width, ...ends) {
  const [top, bottom] = ends.map((y) => Math.min(height, Math.max(0, y))).sort((one, other) => one - other);
  return { x: 0, width, y: top, height: bottom - top };
}

// Places labels of limits right of the plot, one below the other.
function spread(labels, width) {
  let free = -Infinity;
  for (const { text, y } of labels.sort((one, other) => one.y - other.y)) {
    const at = Math.max(y, free);
    place(text, { x: width + 6, y: at + 4 });
    free = at + kTextPx;
  }
}

export class LimitLines {
  #lines = new Map();  // lines by alarm and limit
  #held = null;        // scale during a drag

  constructor(recipe, mayChange) {
    this.recipe = recipe;
    this.mayChange = mayChange;
    this.svg = drawn("svg", { role: "group", "aria-label": texts.process.limits });
    this.fields = element("div", { className: "limits" });
  }

  // Limits of a region's signal. A line that is dragged is removed, and its drag ends without an event.
  choose(region, signal) {
    this.#held = null;
    this.alarms = this.recipe.alarmsOf(region, signal);
    this.svg.replaceChildren();
    this.#lines.clear();
    this.fields.replaceChildren(...this.alarms.map((alarm) => this.#fieldsOf(alarm)));
  }

  #fieldsOf(alarm) {
    const names = [...kLimits, "hysteresis"];
    return element("fieldset", {}, element("legend", {}, texts.process.limitsOf(alarm.alarm, unitSymbol(alarm.unit))),
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

  // Values that the chart includes.
  get values() {
    return (this.alarms ?? []).flatMap((alarm) => kLimits.map((name) => this.recipe.limit(alarm, name)))
      .filter((value) => value !== null);
  }

  // The chart's axis during a drag, in which it stays; null: none is dragged.
  get held() {
    return this.#held;
  }

  draw(axis, width) {
    if (!axis) return;
    place(this.svg, { viewBox: `0 0 ${width} ${axis.height}` });
    const labels = (this.alarms ?? []).flatMap((alarm) =>
      kLimits.flatMap((name) => this.#drawOne(alarm, name, axis, width) ?? []));
    spread(labels, width);
    this.drawn = axis;
  }

  // Returns the label and its place; nothing without a limit.
  #drawOne(alarm, name, axis, width) {
    const value = this.recipe.limit(alarm, name), key = `${alarm.alarm} ${name}`;
    const shapes = this.#lines.get(key) ?? this.#add(alarm, name, key);
    place(shapes.root, { visibility: value === null ? "hidden" : "visible" });
    if (value === null) return null;
    const isLow = name.startsWith("low"), y = axis.y(value), edge = isLow ? axis.height : 0;
    const outer = kOuter[name] ? this.recipe.limit(alarm, kOuter[name]) : null;
    const back = this.recipe.limit(alarm, "hysteresis") * (isLow ? 1 : -1);
    place(shapes.band, rectangle(axis, width, y, outer === null ? edge : axis.y(outer)));
    place(shapes.back, rectangle(axis, width, y, axis.y(value + back)));
    for (const line of [shapes.line, shapes.grip]) place(line, { x1: 0, x2: width, y1: y, y2: y });
    const words = `${texts.process[name]} ${amountText(value, alarm.unit)}`;
    setText(shapes.text, figureText(value));
    setText(shapes.title, words);
    place(shapes.root, { "aria-valuenow": value, "aria-valuetext": words,
      "aria-valuemin": Math.min(axis.low, value), "aria-valuemax": Math.max(axis.high, value) });
    return { text: shapes.text, y };
  }

  #add(alarm, name, key) {
    const shapes = { title: drawn("title"), band: drawn("rect", { class: "band" }), back: drawn("rect"),
      line: drawn("line"), grip: drawn("line", { class: "grip" }), text: drawn("text") };
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
