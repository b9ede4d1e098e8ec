// SPDX-License-Identifier: Apache-2.0
// Key figures: signals with limits as large numbers with their last ten minutes, in the colours of their alarms.
import { raisedAlarms } from "../appliance/alarms.js";
import { History } from "../appliance/history.js";
import { figureText, unitSymbol } from "../elements/amounts.js";
import { freshBrush, pointsOf, recentX, strokeCurve, valuesOf } from "../elements/curve.js";
import { element, setText } from "../elements/elements.js";
import { Keyed } from "../elements/figures.js";
import { texts } from "../texts.js";
import { worstOf } from "./alarms.js";

const kEdgePx = 2;  // room for the line's width

// Spark line over the full height.
function drawSpark(canvas, history, now) {
  const points = pointsOf(history, now), values = valuesOf(points), brush = freshBrush(canvas);
  if (values.length === 0) return;
  const least = Math.min(...values), span = Math.max(...values) - least || 1;
  const height = canvas.clientHeight;
  const y = (value) => height - kEdgePx - (value - least) / span * (height - 2 * kEdgePx);
  brush.strokeStyle = getComputedStyle(canvas).color;
  brush.lineWidth = 1.5;
  strokeCurve(brush, points, { y }, recentX(canvas.clientWidth, now));
}

// One of them; a button that chooses its signal in the chart.
class KeyFigure {
  constructor(region, signal, { title, unit = "" } = {}, onChoice) {
    this.history = new History({ region, figure: signal });
    this.value = element("span", { className: "value" });
    this.state = element("span", { className: "state" });
    this.spark = element("canvas", { "aria-hidden": true });
    this.root = element("button", { type: "button", "data-key": `${region} ${signal}` },
      element("span", { className: "title" }, title || signal),
      element("code", { className: "quiet" }, `${region}: ${signal}`),
      element("span", { className: "amount" }, this.value, " ", element("small", {}, unitSymbol(unit))),
      this.state, this.spark);
    this.root.addEventListener("click", () => onChoice(region, signal));
  }

  // `alarms` of the signal. `silence`: reason why nothing is measured; empty: it is.
  show(value, alarms, now, silence) {
    const [worst = alarms[0]] = raisedAlarms(alarms);
    this.history.add(now, value);
    if (silence) this.lost(silence);
    else this.#say(figureText(value), worst.state_text, worstOf(alarms));
    if (this.root.offsetParent === null) return; // not shown
    this.history.refresh(now);
    drawSpark(this.spark, this.history, now);
  }

  // Neither the value nor the state of its alarms is known.
  lost(why) {
    this.#say(figureText(null), why, "");
  }

  #say(value, state, mark) {
    setText(this.value, value);
    setText(this.state, state);
    this.root.className = `key ${mark}`;
  }
}

export class KeyFigures {
  #keys = []; // keys of the shown figures

  // `descriptions` of the signals; `onChoice(region, signal)`: one was pressed.
  constructor(descriptions, onChoice) {
    this.root = element("div", { id: "key-figures", role: "group", "aria-label": texts.process.keyFigures });
    this.figures = new Keyed(this.root, (key) => {
      const [region, signal] = JSON.parse(key);
      return new KeyFigure(region, signal, descriptions[signal], onChoice);
    });
  }

  // `silence`: reason why nothing is measured; empty: it is.
  show(regions, alarms, now, silence) {
    const signals = alarms.filter(({ region }) => regions[region])
      .map(({ region, signal_text: signal }) => ({ region, signal }));
    const keyOf = ({ region, signal }) => JSON.stringify([regions[region].name, signal]);
    this.#keys = signals.map(keyOf);
    this.figures.keep(this.#keys);
    for (const one of signals) {
      const own = alarms.filter(({ region, signal_text: signal }) =>
        region === one.region && signal === one.signal);
      this.figures.get(keyOf(one)).show(regions[one.region][one.signal] ?? null, own, now, silence);
    }
  }

  lost(why) {
    for (const key of this.#keys) this.figures.get(key).lost(why);
  }
}
