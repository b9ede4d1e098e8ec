// The last ten minutes of one signal as a strip.
import { figureText } from "./figures.js";
import { texts } from "./texts.js";

export const kHistoryMs = 600000;

export class History {
  #points = []; // {at: ms, value}, oldest first

  add(at, value) {
    this.#points.push({ at, value });
    while (this.#points[0].at < at - kHistoryMs) this.#points.shift();
  }
  get points() {
    return this.#points;
  }
}

export function drawChart(canvas, history, name, unit, now) {
  const scale = window.devicePixelRatio || 1;
  const width = (canvas.width = canvas.clientWidth * scale);
  const height = (canvas.height = canvas.clientHeight * scale);
  const points = history.points.filter((p) => p.value !== null);
  if (points.length === 0) {
    canvas.setAttribute("aria-label", texts.chartEmpty(name));
    return;
  }
  const values = points.map((p) => p.value);
  const low = Math.min(...values), high = Math.max(...values), span = high - low || 1;
  canvas.setAttribute("aria-label", texts.chart(name, figureText(low), figureText(high), unit));
  const brush = canvas.getContext("2d");
  const style = getComputedStyle(canvas);
  const line = 16 * scale;
  const y = (value) => height - line - ((value - low) / span) * (height - 2 * line);
  brush.strokeStyle = style.color;
  brush.lineWidth = 2 * scale;
  brush.beginPath();
  let isDown = false;
  for (const { at, value } of history.points) {
    const x = width * (1 + (at - now) / kHistoryMs);
    if (value === null) isDown = false;
    else if (isDown) brush.lineTo(x, y(value));
    else brush.moveTo(x, y(value));
    isDown = value !== null;
  }
  brush.stroke();
  brush.fillStyle = getComputedStyle(document.body).color;
  brush.font = `${12 * scale}px system-ui, sans-serif`;
  brush.fillText(`${figureText(high)} ${unit}`, 4 * scale, line - 3 * scale);
  brush.fillText(`${figureText(low)} ${unit}`, 4 * scale, height - 4 * scale);
}
