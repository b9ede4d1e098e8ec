// The last ten minutes of one signal as a strip.
import { figureText } from "./figures.js";
import { texts } from "./texts.js";

export const kHistoryMs = 600000;
const kLinePx = 16;  // of text

// Of as many values as the appliance reports in that time, four a second, and some more; takes its memory
// at once.
export class History {
  static #most = 3000;
  #at = new Float64Array(History.#most); // ms; a ring, as the values are
  #values = new Float64Array(History.#most); // NaN: not measured
  #oldest = 0;
  #count = 0;

  // `value` null: not measured.
  add(at, value) {
    if (this.#count === History.#most) this.#forgetOldest();
    const place = (this.#oldest + this.#count) % History.#most;
    this.#at[place] = at;
    this.#values[place] = value ?? NaN;
    ++this.#count;
    while (this.#at[this.#oldest] < at - kHistoryMs) this.#forgetOldest();
  }

  #forgetOldest() {
    this.#oldest = (this.#oldest + 1) % History.#most;
    --this.#count;
  }

  // {at, value or null}, oldest first.
  get points() {
    return Array.from({ length: this.#count }, (_, index) => {
      const place = (this.#oldest + index) % History.#most, value = this.#values[place];
      return { at: this.#at[place], value: Number.isNaN(value) ? null : value };
    });
  }
}

// Where values stand in a chart: shares of its height from its top, with room for a line of text
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

// Of what was measured, and `more` values that are to be seen; null: nothing was measured.
export function scaleOf(canvas, history, more = []) {
  const measured = history.points.map(({ value }) => value).filter((value) => value !== null);
  return measured.length === 0 && more.length === 0 ? null
    : new Scale([...measured, ...more], canvas.clientHeight);
}

export function drawChart(canvas, history, name, unit, now, scale = scaleOf(canvas, history)) {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = canvas.clientWidth * ratio;
  canvas.height = canvas.clientHeight * ratio;
  const values = history.points.map(({ value }) => value).filter((value) => value !== null);
  canvas.setAttribute("aria-label", values.length === 0 ? texts.chartEmpty(name)
    : texts.chart(name, figureText(Math.min(...values)), figureText(Math.max(...values)), unit));
  if (!scale) return;
  const brush = canvas.getContext("2d");
  brush.scale(ratio, ratio);
  const style = getComputedStyle(canvas);
  brush.strokeStyle = style.color;
  brush.lineWidth = 2;
  brush.beginPath();
  let isDown = false;
  for (const { at, value } of history.points) {
    const x = canvas.clientWidth * (1 + (at - now) / kHistoryMs);
    if (value === null) isDown = false;
    else if (isDown) brush.lineTo(x, scale.y(value));
    else brush.moveTo(x, scale.y(value));
    isDown = value !== null;
  }
  brush.stroke();
  brush.fillStyle = getComputedStyle(document.body).color;
  brush.font = "12px system-ui, sans-serif";
  brush.fillText(`${figureText(scale.high)} ${unit}`, 4, kLinePx - 3);
  brush.fillText(`${figureText(scale.low)} ${unit}`, 4, scale.height - 4);
}
