// SPDX-License-Identifier: Apache-2.0
// The grid of a chart with the labels of its axes.
import { unitSymbol } from "./amounts.js";
import { drawn } from "./shapes.js";

const kEndPx = 40;  // width of the label at the end of the times

export class Grid {
  #key = "";

  constructor() {
    this.svg = drawn("svg", { class: "grid", "aria-hidden": true });
  }

  // `axes`: {axis, unit, kind, x}, with labels of the class `kind` at x; the first one has lines. `times`: {x, text} of
  // each tick. `end`: label at the right end. The same is not drawn again.
  draw({ width, height }, axes, times, end) {
    const shapes = [];
    const line = (ends) => shapes.push(["line", ends]);
    const label = (x, y, anchor, text, kind = "") =>
      shapes.push(["text", { x, y, "text-anchor": anchor, class: kind }, text]);
    axes.forEach(({ axis, unit, kind, x }, n) => {
      const anchor = x < 0 ? "end" : "start";
      for (const { y, text } of axis?.ticks ?? []) {
        if (n === 0) line({ x1: 0, x2: width, y1: y, y2: y });
        label(x, y + 4, anchor, text, kind);
      }
      if (axis) label(x, -8, anchor, unitSymbol(unit), kind);
    });
    for (const { x, text } of times) {
      const at = Math.round(x);
      line({ x1: at, x2: at, y1: 0, y2: height });
      if (at < width - kEndPx) label(at, height + 18, "middle", text);
    }
    label(width, height + 18, "end", end);
    const key = JSON.stringify(shapes);
    if (key === this.#key) return;
    this.#key = key;
    this.svg.replaceChildren(...shapes.map(([tag, attributes, ...content]) => drawn(tag, attributes, ...content)));
  }
}
