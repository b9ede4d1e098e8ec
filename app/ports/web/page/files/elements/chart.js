// SPDX-License-Identifier: Apache-2.0
// The last ten minutes of one figure as a strip.
import { kHistoryMs } from "../appliance/history.js";
import { texts } from "../texts.js";
import { element } from "./elements.js";
import { figureText } from "./figures.js";

const kLinePx = 16;  // height of a text line
const kGapMs = 2000;  // silence that counts as a gap

// Vertical positions of values in a chart: shares of its height from the top, with room for a line of text
// above and below.
export class Scale {
  constructor(values, height) {
    this.low = Math.min(...values);
    this.high = Math.max(...values);
    this.span = this.high - this.low || 1;
    this.height = height;
  }
  y(value) {
    return this.height - kLinePx - (value - this.low) / this.span * (this.height - 2 * kLinePx);
  }
  value(y) {
    return this.low + (this.height - kLinePx - y) / (this.height - 2 * kLinePx) * this.span;
  }
}

const measuredOf = (points) =>
  points.flatMap(({ low, high }) => [low, high]).filter((value) => value !== null);

// Range of the measured values and of `more` values to be visible; null: no measurement.
export function scaleOf(canvas, history, more = []) {
  const measured = measuredOf(history.points);
  return measured.length === 0 && more.length === 0 ? null
    : new Scale([...measured, ...more], canvas.clientHeight);
}

// Canvas of a chart, with its name for screen readers from the beginning.
export const chartCanvas = (name) => element("canvas",
  { className: "chart", role: "img", "aria-label": texts.chartEmpty(name) });

export function drawChart(canvas, history, name, unit, now, scale = scaleOf(canvas, history)) {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = canvas.clientWidth * ratio;
  canvas.height = canvas.clientHeight * ratio;
  const { points } = history, values = measuredOf(points);
  canvas.setAttribute("aria-label", values.length === 0 ? texts.chartEmpty(name)
    : texts.chart(name, figureText(Math.min(...values)), figureText(Math.max(...values)), unit));
  if (!scale) return;
  const brush = canvas.getContext("2d");
  brush.scale(ratio, ratio);
  const style = getComputedStyle(canvas);
  brush.strokeStyle = style.color;
  brush.lineWidth = 2;
  brush.beginPath();
  let before = null;
  for (const point of points.filter(({ at }) => at >= now - kHistoryMs)) {
    const x = canvas.clientWidth * (1 + (point.at - now) / kHistoryMs);
    const isDrawn = before !== null && before.low !== null && point.at - before.at < kGapMs;
    before = point;
    if (point.low === null) continue;
    if (!isDrawn) brush.moveTo(x, scale.y(point.low));
    brush.lineTo(x, scale.y(point.low));
    brush.lineTo(x, scale.y(point.high));
  }
  brush.stroke();
  brush.fillStyle = getComputedStyle(document.body).color;
  brush.font = "12px system-ui, sans-serif";
  brush.fillText(`${figureText(scale.high)} ${unit}`, 4, kLinePx - 3);
  brush.fillText(`${figureText(scale.low)} ${unit}`, 4, scale.height - 4);
}
