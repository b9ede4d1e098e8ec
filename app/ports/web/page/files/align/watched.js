// SPDX-License-Identifier: Apache-2.0
// Drift of an alignment, focus and cleanness of the ball, over time.
import { History } from "../appliance/history.js";
import { amountText, figureText } from "../elements/amounts.js";
import { Chart } from "../elements/chart.js";
import { element, setText } from "../elements/elements.js";
import { texts } from "../texts.js";

// Level figure by measured figure.
const kFigures = { drift_error: "alignment", blur: "focus", contamination: "cleanliness" };

export class Watched {
  #camera = "";  // name of the displayed camera
  #histories = {};  // histories of the camera, by figure

  // `descriptions` of a camera's figures.
  constructor(descriptions) {
    this.descriptions = descriptions;
    this.parts = Object.fromEntries(Object.keys(kFigures).map((name) => [name, {
      now: element("p"), chart: new Chart(texts.watched[name]) }]));
    this.outline = element("p");
    this.root = element("section", { id: "watched" }, element("h4", {}, texts.watched.title),
      ...Object.values(this.parts).flatMap(({ now, chart }) => [now, chart.root]), this.outline);
  }

  // `chosen`: name of the camera that is shown, or nothing.
  status(cameras, chosen, now) {
    const shown = cameras.find(({ name }) => name === chosen);
    if (!shown) return;
    if (chosen !== this.#camera) this.#choose(chosen);
    for (const [name, history] of Object.entries(this.#histories)) history.add(now, shown[name]);
    if (this.root.offsetParent !== null) this.#show(shown, now);
  }

  #choose(camera) {
    this.#camera = camera;
    this.#histories = Object.fromEntries(Object.keys(kFigures).map((figure) =>
      [figure, new History({ camera, figure })]));
  }

  #show(camera, now) {
    setText(this.outline, texts.watched.outline(camera.outline_check_text,
      figureText(camera.outline_offset), camera.outline_offset !== null));
    for (const [name, judge] of Object.entries(kFigures)) {
      const { unit = "" } = this.descriptions[name] ?? {}, { now: said, chart } = this.parts[name];
      const value = camera[name] === null ? texts.watched.notKnown : amountText(camera[name], unit);
      setText(said, texts.watched.now(texts.watched[name], value, camera[`${judge}_text`]));
      this.#histories[name].refresh(now);
      chart.draw([{ history: this.#histories[name], name: texts.watched[name], unit }], now);
    }
  }
}
