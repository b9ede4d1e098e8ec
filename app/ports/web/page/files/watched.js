// What has become of an alignment, of the focus and of the ball's cleanness, over time.
import { drawChart, History } from "./chart.js";
import { element, setText } from "./elements.js";
import { figureText } from "./figures.js";
import { texts } from "./texts.js";

// By figure: the one that judges it.
const kFigures = { drift_error: "alignment", blur: "focus", contamination: "cleanliness" };

export class Watched {
  #histories = new Map();  // by camera, then by figure

  // `descriptions` of a camera's figures.
  constructor(descriptions) {
    this.descriptions = descriptions;
    this.parts = Object.fromEntries(Object.keys(kFigures).map((name) => [name, {
      now: element("p"), canvas: element("canvas", { className: "chart", role: "img" })}]));
    this.root = element("section", { id: "watched" }, element("h3", {}, texts.watched.title),
      ...Object.values(this.parts).flatMap(({ now, canvas }) => [now, canvas]));
  }

  // `chosen`: name of the camera that is shown, or nothing.
  status(cameras, chosen, now) {
    for (const camera of cameras) {
      if (!this.#histories.has(camera.name)) {
        this.#histories.set(camera.name, Object.fromEntries(Object.keys(kFigures).map((name) =>
          [name, new History()])));
      }
      for (const [name, history] of Object.entries(this.#histories.get(camera.name))) {
        history.add(now, camera[name]);
      }
    }
    const shown = cameras.find(({ name }) => name === chosen);
    if (shown && this.root.offsetParent !== null) this.#show(shown, now);
  }

  #show(camera, now) {
    for (const [name, judge] of Object.entries(kFigures)) {
      const { unit = "" } = this.descriptions[name] ?? {}, { now: said, canvas } = this.parts[name];
      setText(said, texts.watched.now(texts.watched[name], figureText(camera[name]), unit,
        camera[`${judge}_text`]));
      drawChart(canvas, this.#histories.get(camera.name)[name], texts.watched[name], unit, now);
    }
  }
}
