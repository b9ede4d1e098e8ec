// SPDX-License-Identifier: Apache-2.0
// One view from two cameras at one moment, one over the other.
import { element, setText } from "../elements/elements.js";
import { Freshness } from "../elements/freshness.js";
import { texts } from "../texts.js";
import { caption, kSide, kStaleMs, viewCanvas } from "./camera_view.js";

const kBlinkMs = 500;  // two changes per second are not disturbing
const kSquares = 8;    // squares of the checkerboard in each direction

const kWays = {
  blink: (brush, [a, b], { isSecond }) => brush.drawImage(isSecond ? b : a, 0, 0),
  blend: (brush, [a, b], { share }) => {
    brush.drawImage(a, 0, 0);
    brush.globalAlpha = share;
    brush.drawImage(b, 0, 0);
    brush.globalAlpha = 1;
  },
  checkerboard: (brush, [a, b]) => {
    const side = kSide / kSquares;
    brush.drawImage(a, 0, 0);
    for (let row = 0; row < kSquares; ++row) {
      for (let column = (row + 1) % 2; column < kSquares; column += 2) {
        const square = [column * side, row * side, side, side];
        brush.drawImage(b, ...square, ...square);
      }
    }
  },
};

export class Comparison {
  #pictures = [];
  #isSecond = false;

  constructor() {
    this.canvas = viewCanvas(texts.compare.canvas);
    this.way = element("select", { name: "way" }, ...Object.keys(kWays).map((way) =>
      element("option", { value: way }, texts.compare[way])));
    this.share = element("input", { type: "range", name: "share", min: 0, max: 1, step: 0.05, value: 0.5 });
    this.way.addEventListener("change", () => this.#draw());
    this.share.addEventListener("input", () => this.#draw());
    this.legend = element("span");
    const seen = element("div", { className: "picture" }, this.canvas);
    this.freshness = new Freshness(seen, kStaleMs);
    this.root = element("figure", { className: "view" }, seen,
      caption(element("label", {}, texts.compare.way, " ", this.way),
        element("label", {}, texts.compare.share, " ", this.share), this.legend,
        this.freshness.age));
    setInterval(() => {
      if (this.way.value !== "blink" || this.root.offsetParent === null) return;
      this.#isSecond = !this.#isSecond;
      this.#draw();
    }, kBlinkMs);
  }

  // Other cameras take their place.
  forget() {
    for (const picture of this.#pictures) picture.close();
    this.#pictures = [];
    this.canvas.width = kSide; // clears it
    this.freshness.forget();
  }

  // `names` of the pictures of a pair, which it owns from now on.
  show({ pictures, stamp, age_ms, received }, names) {
    for (const picture of this.#pictures) picture.close();
    this.freshness.drew(age_ms, received);
    this.#pictures = pictures;
    this.names = names;
    this.canvas.dataset.number = Number(this.canvas.dataset.number ?? 0) + 1;
    this.canvas.dataset.stamp = stamp;
    this.#draw();
  }

  #draw() {
    if (this.#pictures.length < 2) return;
    const way = this.way.value;
    kWays[way](this.canvas.getContext("2d"), this.#pictures,
      { isSecond: this.#isSecond, share: Number(this.share.value) });
    setText(this.legend, way === "blink" ? this.names[this.#isSecond ? 1 : 0]
      : texts.compare.both(...this.names));
  }
}
