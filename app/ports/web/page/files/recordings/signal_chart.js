// SPDX-License-Identifier: Apache-2.0
// Chart of a signal over an event, whose cursor is the moment of the picture that is shown.
import { amountText, decimalText, figureText, withUnit } from "../elements/amounts.js";
import { secondTicks, ValueAxis } from "../elements/axis.js";
import { freshBrush, strokeCurve, valuesOf } from "../elements/curve.js";
import { element, setText } from "../elements/elements.js";
import { Grid } from "../elements/grid.js";
import { drawn, place } from "../elements/shapes.js";
import { texts } from "../texts.js";

const kAxisPx = 56;  // width of the labels of the axis
const kMarginPx = 8;
const kLabelPx = 6;
const kRadiusPx = 4;
const kSteps = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 };
const kEnds = { Home: -Infinity, End: Infinity };
const kLargeStep = 10;

// The step that has the moment.
const stepAt = (points, moment) => points.findLast(({ at }) => at <= moment) ?? points[0];

function amount({ low, high }, unit) {
  return low === high ? amountText(low, unit)
    : withUnit(texts.fromTo(figureText(low), figureText(high)), unit);
}

export class SignalChart {
  #shown = null;  // {points, tried, name, unit, trigger}
  #moment = 0;
  #range = [null, null];
  #axis = null;   // null: no value, or not drawn yet, because the chart is hidden

  // `choose(moment)`: the pointer is at a moment, milliseconds since 1970; `step(by)`: a key moves by so many pictures.
  constructor({ choose, step }) {
    Object.assign(this, { choose, step });
    this.grid = new Grid();
    this.marks = drawn("svg", { class: "marks", "aria-hidden": true });
    this.canvas = element("canvas", { role: "slider", tabIndex: 0 });
    this.cursor = drawn("svg", { class: "cursor", "aria-hidden": true });
    this.plot = element("div", { className: "plot" }, this.grid.svg, this.marks, this.canvas, this.cursor);
    this.plot.style.margin = `0 ${kMarginPx}px 1.75rem ${kAxisPx}px`;
    this.read = element("span", { className: "first" });
    this.other = element("span", { className: "second" });
    this.root = element("div", { className: "chart" }, element("p", { className: "read" }, this.read, this.other),
      this.plot);
    this.plot.addEventListener("pointerdown", (event) => this.#press(event));
    this.plot.addEventListener("pointermove", (event) => event.buttons > 0 && this.#point(event));
    this.canvas.addEventListener("keydown", (event) => this.#key(event));
    new ResizeObserver(() => this.#draw()).observe(this.plot);
  }

  // `points`: {at, low, high} of each step, null: not valid. `tried`: those of another recipe; may be empty.
  show(points, name, unit, trigger, tried) {
    this.#shown = { points, tried, name, unit, trigger, first: points[0].at, last: points.at(-1).at };
    this.#axis = null;
    const values = valuesOf(points);
    this.canvas.setAttribute("aria-label", values.length === 0 ? texts.recordings.chartEmpty(name)
      : texts.recordings.chart(name, figureText(Math.min(...values)), amountText(Math.max(...values), unit)));
    this.#draw();
  }

  // Moves the cursor, also without a signal.
  setMoment(moment) {
    this.#moment = moment;
    this.#showCursor();
  }

  // Shades a range; null: an end of the event.
  setRange(from, to) {
    this.#range = [from, to];
    this.#draw();
  }

  get #width() {
    return this.plot.clientWidth;
  }

  #x(at) {
    const { first, last } = this.#shown;
    return (at - first) / Math.max(1, last - first) * this.#width;
  }

  #draw() {
    if (!this.#shown || this.#width === 0) return;
    const { points, tried, unit, trigger, first, last } = this.#shown;
    const width = this.#width, height = this.plot.clientHeight, values = valuesOf([...points, ...tried]);
    const xOf = (at) => this.#x(at);
    this.#axis = values.length === 0 ? null : new ValueAxis(values, height);
    this.grid.draw({ width, height }, [{ axis: this.#axis, unit, kind: "first", x: -kLabelPx }],
      last > first ? secondTicks(first, last, trigger, xOf) : [], "s");
    const x = xOf(trigger);
    this.marks.replaceChildren(...this.#shade(width, height), drawn("line", { x1: x, x2: x, y1: 0, y2: height }),
      drawn("text", { x, y: -8, "text-anchor": x < width / 2 ? "start" : "end" }, texts.recordings.trigger));
    const brush = freshBrush(this.canvas);
    Object.assign(brush, { lineWidth: 2, lineCap: "round", strokeStyle: getComputedStyle(this.read).color });
    if (this.#axis) strokeCurve(brush, points, this.#axis, xOf, Infinity);
    brush.strokeStyle = getComputedStyle(this.other).color;
    if (this.#axis) strokeCurve(brush, tried, this.#axis, xOf, Infinity);
    this.#showCursor();
  }

  #shade(width, height) {
    const [from, to] = this.#range;
    if (from === null && to === null) return [];
    const left = Math.max(0, from === null ? 0 : this.#x(from));
    const right = Math.min(width, to === null ? width : this.#x(to));
    return [drawn("rect", { x: left, y: 0, width: Math.max(1, right - left), height })];
  }

  #showCursor() {
    if (!this.#shown || this.#width === 0) return;
    const { points, tried, name, unit, trigger, first, last } = this.#shown, point = stepAt(points, this.#moment);
    const seconds = (this.#moment - trigger) / 1000;
    setText(this.read, `${name} ${amount(point, unit)}`);
    const other = stepAt(tried, this.#moment);
    setText(this.other, other ? texts.recordings.replays.tried(amount(other, unit)) : "");
    place(this.canvas, { "aria-valuemin": (first - trigger) / 1000, "aria-valuemax": (last - trigger) / 1000,
      "aria-valuenow": seconds,
      "aria-valuetext": `${texts.recordings.offset(decimalText(seconds, 2))}: ${this.read.textContent}` });
    const x = Math.min(this.#width, Math.max(0, this.#x(this.#moment)));
    this.cursor.replaceChildren(drawn("line", { x1: x, x2: x, y1: 0, y2: this.plot.clientHeight }),
      ...(point.high === null || !this.#axis ? [] : [drawn("circle", { class: "first", r: kRadiusPx, cx: x,
        cy: this.#axis.y(point.high) })]));
  }

  // Follows the pointer until it is released.
  #press(event) {
    if (event.button !== 0 || !this.#shown) return;
    this.plot.setPointerCapture(event.pointerId);
    this.canvas.focus({ preventScroll: true });
    this.#point(event);
  }

  #point({ clientX }) {
    if (!this.#shown) return;
    const { first, last } = this.#shown, box = this.plot.getBoundingClientRect();
    this.choose(first + Math.min(1, Math.max(0, (clientX - box.left) / box.width)) * (last - first));
  }

  #key(event) {
    const by = kEnds[event.key] ?? (kSteps[event.key] ?? 0) * (event.shiftKey ? kLargeStep : 1);
    if (by === 0) return;
    event.preventDefault();
    this.step(by);
  }
}
