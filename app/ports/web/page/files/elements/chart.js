// SPDX-License-Identifier: Apache-2.0
// Chart of the last ten minutes of one or two figures over local time, with the values at the pointer. With axis.js
// and curve.js it has 12 kB; dygraph.min.js of libjs-dygraphs 2.2.1 has 131 kB, without limits that are dragged.
import { kHistoryMs } from "../appliance/history.js";
import { texts } from "../texts.js";
import { amountText, figureText, withUnit } from "./amounts.js";
import { timeTicks, ValueAxis } from "./axis.js";
import { secondText, wallTime } from "./clock.js";
import { freshBrush, pointAt, pointsOf, recentX, strokeCurve, valuesOf } from "./curve.js";
import { element, setText } from "./elements.js";
import { Grid } from "./grid.js";
import { drawn, place } from "./shapes.js";

const kAxisPx = 56;    // width of the labels of an axis, or of limits
const kMarginPx = 8;   // the same without labels
const kLabelPx = 6;    // distance of labels from the plot
const kStepMs = 1000, kLargeStepMs = 10000;  // step of a key
const kRadiusPx = 4;
const kBeyond = 0.08;  // room beyond limits, where ranges are shaded; share of the values' range
const kSeries = ["first", "second"];  // their classes
const kSteps = { ArrowLeft: 1, ArrowDown: 1, ArrowRight: -1, ArrowUp: -1 };
const kEnds = { Home: kHistoryMs, End: 0, Escape: null };

const axisOf = (values, height) => (values.length === 0 ? null : new ValueAxis(values, height));

// Values that make room beyond limits.
function beyond(limits, measured) {
  const all = [...limits, ...measured], room = kBeyond * (Math.max(...all) - Math.min(...all));
  return limits.length === 0 ? [] : [Math.min(...limits) - room, Math.max(...limits) + room];
}

function amount(point, unit) {
  if (!point) return figureText(null);
  const [low, high] = [point.low, point.high].map((value) => figureText(value));
  return withUnit(low === high ? low : texts.fromTo(low, high), unit);
}

export class Chart {
  #age = null;     // age of the moment at the pointer, ms; null: the newest values are stated
  #shown = null;   // {series, now, width}

  // `name`: for screen readers. `layers`: shapes between the grid and the curves.
  constructor(name, ...layers) {
    this.grid = new Grid();
    this.canvas = element("canvas", { role: "slider", tabIndex: 0, "aria-label": texts.chartEmpty(name),
      "aria-valuemin": -kHistoryMs / 1000, "aria-valuemax": 0, "aria-valuenow": 0 });
    this.cursor = drawn("svg", { class: "cursor", "aria-hidden": true });
    this.plot = element("div", { className: "plot" }, this.grid.svg, ...layers, this.canvas, this.cursor);
    this.when = element("span", { className: "quiet" });
    this.read = kSeries.map((className) => element("span", { className }));
    this.root = element("div", { className: "chart" },
      element("p", { className: "read" }, ...this.read, this.when), this.plot);
    this.plot.addEventListener("pointerdown", (event) => this.#press(event));
    this.plot.addEventListener("pointermove", (event) => this.#point(event));
    this.plot.addEventListener("mousedown", (event) => event.preventDefault()); // would take the focus away again
    this.plot.addEventListener("pointerleave", ({ pointerType }) => {
      if (pointerType === "mouse") this.#setAge(null);
    });
    this.canvas.addEventListener("keydown", (event) => this.#key(event));
    this.plot.addEventListener("focusout", ({ relatedTarget }) => {
      if (!this.plot.contains(relatedTarget)) this.#setAge(null);
    });
  }

  // `series`: {history, name, unit} of one or two figures. `limits`: values of the first one to be included in its
  // axis; `held`: an axis to be kept. Returns the first one's axis; null: nothing to show.
  draw(series, now, limits = [], held = null) {
    const plotted = series.map((one) => ({ ...one, points: pointsOf(one.history, now) }));
    const values = plotted.map(({ points }) => valuesOf(points));
    const isShared = plotted.length > 1 && plotted[0].unit === plotted[1].unit;
    this.#makeRoom(limits.length > 0, plotted.length > 1 && !isShared);
    const height = this.plot.clientHeight;
    const first = held ?? axisOf([...values[0], ...beyond(limits, values[0]), ...(isShared ? values[1] : [])], height);
    plotted.forEach((one, n) => { one.axis = n === 0 || isShared ? first : axisOf(values[n], height); });
    this.#shown = { series: plotted, now, width: this.plot.clientWidth, height };
    this.#drawGrid(isShared ? plotted.slice(0, 1) : plotted);
    this.#drawCurves();
    this.#describe(plotted[0], values[0]);
    this.#showValues();
    return first;
  }

  get width() {
    return this.#shown.width;
  }

  // The right margin has the labels of limits, then those of the second axis.
  #makeRoom(hasLimits, hasSecond) {
    this.second = hasLimits ? kAxisPx : 0; // distance of the second axis from the plot
    const margin = this.second + (hasSecond ? kAxisPx : 0) || kMarginPx;
    this.plot.style.marginRight = `${margin}px`;
    this.plot.style.marginLeft = `${kAxisPx}px`;
  }

  #drawGrid(series) {
    const { now, width } = this.#shown;
    const axes = series.map(({ axis, unit }, n) =>
      ({ axis, unit, kind: kSeries[n], x: n === 0 ? -kLabelPx : width + this.second + kLabelPx }));
    this.grid.draw(this.#shown, axes, timeTicks(width, kHistoryMs, wallTime(now)), texts.now);
  }

  #drawCurves() {
    const { series, now, width } = this.#shown, brush = freshBrush(this.canvas);
    brush.lineWidth = 2;
    series.forEach(({ points, axis }, n) => {
      if (!axis) return;
      brush.strokeStyle = getComputedStyle(this.read[n]).color;
      strokeCurve(brush, points, axis, recentX(width, now));
    });
  }

  #describe({ name, unit }, values) {
    this.canvas.setAttribute("aria-label", values.length === 0 ? texts.chartEmpty(name)
      : texts.chart(name, figureText(Math.min(...values)), amountText(Math.max(...values), unit)));
  }

  #point({ clientX }) {
    const box = this.plot.getBoundingClientRect();
    const share = Math.min(1, Math.max(0, (clientX - box.left) / box.width));
    this.#setAge((1 - share) * kHistoryMs);
  }

  // Focuses the canvas, which lies behind shapes: the end of the focus ends what a tap shows. Shapes focus themselves.
  #press(event) {
    if (!event.target.closest(".plot [tabindex]")) this.canvas.focus({ preventScroll: true });
    this.#point(event);
  }

  #key(event) {
    const step = (event.shiftKey ? kLargeStepMs : kStepMs) * (kSteps[event.key] ?? 0);
    if (!step && !(event.key in kEnds)) return;
    event.preventDefault();
    this.#setAge(step ? Math.min(kHistoryMs, Math.max(0, (this.#age ?? 0) + step)) : kEnds[event.key]);
  }

  #setAge(age) {
    this.#age = age;
    if (this.#shown) this.#showValues();
  }

  // States the values at the pointer, and marks them in the plot.
  #showValues() {
    const { series, now, width, height } = this.#shown, age = this.#age ?? 0;
    const points = series.map((one) => pointAt(one.points, now - age));
    const when = this.#age === null ? texts.now : secondText(wallTime(now - age));
    setText(this.when, when);
    this.read.forEach((shown, n) => {
      shown.hidden = n >= series.length;
      if (!shown.hidden) setText(shown, `${series[n].name} ${amount(points[n], series[n].unit)}`);
    });
    const stated = this.read.filter(({ hidden }) => !hidden).map(({ textContent }) => textContent);
    place(this.canvas, { "aria-valuenow": Math.round(-age / 1000),
      "aria-valuetext": `${when}: ${stated.join("; ")}` });
    const x = width * (1 - age / kHistoryMs);
    this.cursor.replaceChildren(...(this.#age === null ? [] : [
      drawn("line", { x1: x, x2: x, y1: 0, y2: height }),
      ...points.flatMap((point, n) => (point ? [drawn("circle", { class: kSeries[n], r: kRadiusPx,
        cx: x, cy: series[n].axis.y(point.high) })] : []))]));
  }
}
