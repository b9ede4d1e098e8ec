// SPDX-License-Identifier: Apache-2.0
// The regions that an event was measured by, over its pictures.
import { element, setText } from "../elements/elements.js";
import { drawn, place, pointsText } from "../elements/shapes.js";
import { texts } from "../texts.js";
import { ask } from "./ask.js";

const kTextPx = 14;

export class EventRegions {
  #event = null;
  #changes = [];         // {at, recipe}, the oldest first
  #recipes = new Map();  // regions by number of the recipe
  #shown = null;         // {camera, moment, part}

  constructor() {
    this.svg = drawn("svg", { class: "outlines", "aria-hidden": true });
    this.choice = element("input", { type: "checkbox", checked: true });
    this.choice.addEventListener("change", () => this.#draw());
    this.label = element("label", { hidden: true }, this.choice, " ", texts.process.regions);
    this.said = element("p", { className: "quiet", role: "status" });
    new ResizeObserver(() => this.#draw()).observe(this.svg);
  }

  // Null closes it.
  async open(event) {
    this.#event = event;
    this.#shown = null;
    this.#changes = [];
    this.label.hidden = true;
    setText(this.said, "");
    this.svg.replaceChildren();
    const read = event && await ask("regions", { event: event.name }, () => event === this.#event);
    if (!read) return;
    if (read.error) return setText(this.said, texts.recordings.noRegions(read.error));
    this.#changes = read.changes.map(({ time, recipe }) => ({ at: Date.parse(time), recipe }));
    this.#recipes = new Map(read.recipes.map(({ number, regions }) => [number, regions]));
    this.#draw();
  }

  // Draws them over a picture: the part {x, y, width, height} of the camera's, at a moment.
  show(camera, moment, part) {
    this.#shown = { camera, moment, part };
    this.#draw();
  }

  // Regions that were measured in the shown camera at the shown moment.
  get #regions() {
    if (!this.#shown) return [];
    const { camera, moment } = this.#shown;
    const { recipe } = this.#changes.findLast(({ at }) => at <= moment) ?? this.#changes[0] ?? {};
    return (this.#recipes.get(recipe) ?? []).filter((region) => region.camera === camera);
  }

  #draw() {
    const regions = this.#regions;
    this.label.hidden = regions.length === 0;
    if (!this.#shown) return;
    const { x, y, width, height } = this.#shown.part, scale = width / (this.svg.clientWidth || width);
    place(this.svg, { viewBox: `${x - 0.5} ${y - 0.5} ${width} ${height}` });
    this.svg.replaceChildren(...(this.choice.checked ? regions : []).flatMap(({ name, lines }) => {
      const [u, v] = lines[0]?.[0] ?? [0, 0];
      const isLeft = u < x + width / 2;
      const text = drawn("text", { x: u + (isLeft ? 6 : -6) * scale, y: v + 16 * scale,
        "text-anchor": isLeft ? "start" : "end", "font-size": kTextPx * scale }, name);
      return [...lines.map((line) => drawn("polyline", { points: pointsText(line) })), text];
    }));
  }
}
