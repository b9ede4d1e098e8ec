// One view by two cameras, or by two models of the ball, beside or over each other.
import { element, setText } from "../elements/elements.js";
import { texts } from "../texts.js";

const kBlinkMs = 500;  // two changes a second disturb nobody
const kSquares = 8;    // of the checkerboard, in each direction
export const kSide = 480;  // px

// Where a view looks, as fields of a form and arguments of a query; degrees.
export class ViewFields {
  // As numbers, by name: those that were right last.
  values = { yaw: 0, pitch: -20, h_fov: 80 };

  constructor(onChange) {
    const ends = { yaw: [-180, 180], pitch: [-90, 90], h_fov: [5, 150] };
    this.inputs = Object.fromEntries(Object.entries(this.values).map(([name, value]) =>
      [name, element("input", { type: "number", name, value, min: ends[name][0], max: ends[name][1],
        step: 5, required: true })]));
    this.root = element("p", {}, ...Object.entries(this.inputs).map(([name, input]) =>
      element("label", {}, texts.compare[name], " ", input)));
    for (const [name, input] of Object.entries(this.inputs)) {
      input.addEventListener("change", () => {
        const value = input.valueAsNumber, [least, most] = ends[name];
        if (!(value >= least && value <= most)) return;
        this.values[name] = value;
        onChange();
      });
    }
  }

  turnTo({ yaw, pitch }) {
    for (const [name, value] of Object.entries({ yaw, pitch })) {
      this.values[name] = this.inputs[name].value = Math.round(value);
    }
  }

  get query() {
    return Object.entries(this.values);
  }
}

export async function pictureOf(query) {
  const all = new URLSearchParams([...query, ["width", kSide], ["height", kSide]]);
  const answer = await fetch(`/api/v1/alignment/view.jpg?${all}`);
  if (!answer.ok) throw new Error((await answer.json()).error);
  return createImageBitmap(await answer.blob());
}

export function viewCanvas(label) {
  const canvas = element("canvas", { role: "img", "aria-label": label });
  canvas.width = canvas.height = kSide;
  return canvas;
}

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

// Two pictures over each other.
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
    this.legend = element("span", { className: "age" });
    this.root = element("figure", { className: "view" },
      element("div", { className: "picture" }, this.canvas),
      element("figcaption", {}, element("label", {}, texts.compare.way, " ", this.way),
        element("label", {}, texts.compare.share, " ", this.share), this.legend));
    setInterval(() => {
      if (this.way.value !== "blink" || this.root.offsetParent === null) return;
      this.#isSecond = !this.#isSecond;
      this.#draw();
    }, kBlinkMs);
  }

  // `names` of both pictures, which are its own from now on.
  show(pictures, names) {
    for (const picture of this.#pictures) picture.close();
    this.#pictures = pictures;
    this.names = names;
    this.canvas.dataset.number = Number(this.canvas.dataset.number ?? 0) + 1;
    this.#draw();
  }

  #draw() {
    if (this.#pictures.length < 2) return;
    const way = this.way.value;
    kWays[way](this.canvas.getContext("2d"), this.#pictures,
      { isSecond: this.#isSecond, share: Number(this.share.value) });
    setText(this.legend, way === "blink" ? this.names[this.#isSecond ? 1 : 0] : this.names.join(", "));
  }
}
