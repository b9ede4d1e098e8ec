// SPDX-License-Identifier: Apache-2.0
// One view by the exact model of the ball beside the paper's, with a straight line.
import { element, setText } from "../elements/elements.js";
import { texts } from "../texts.js";
import { pictureOf, viewCanvas, ViewFields } from "./camera_view.js";

const kModels = ["exact", "paper"];

export class Models {
  #camera = null;
  #pictures = new Map();  // pictures by model
  #isLoading = false;

  constructor() {
    this.view = new ViewFields(() => this.#load());
    this.canvases = new Map(kModels.map((model) => [model, viewCanvas(texts.models[model])]));
    this.lines = Object.fromEntries([["angle", -90, 90, 0], ["offset", -0.5, 0.5, 0]].map(
      ([name, min, max, value]) => [name, element("input", { type: "range", name, min, max,
        step: (max - min) / 180, value })]));
    for (const input of Object.values(this.lines)) input.addEventListener("input", () => this.#draw());
    const button = element("button", { type: "button" }, texts.models.show);
    button.addEventListener("click", () => this.#load());
    this.refused = element("p", { role: "alert", className: "wrong" });
    this.root = element("section", { id: "models" }, element("h3", {}, texts.models.title),
      element("p", {}, texts.models.help), this.view.root,
      element("p", {}, button, ...Object.entries(this.lines).map(([name, input]) =>
        element("label", {}, " ", texts.models[name], " ", input))), this.refused,
      element("div", { className: "beside" }, ...kModels.map((model) =>
        element("figure", { className: "view" },
          element("div", { className: "picture" }, this.canvases.get(model)),
          element("figcaption", {}, texts.models[model])))));
  }

  show(camera) {
    if (this.#camera?.name === camera.name) return;
    this.#camera = camera;
    this.#pictures.clear();
    const rotation = camera.in_force?.rotation;
    if (rotation) this.view.turnTo(rotation);
    for (const canvas of this.canvases.values()) canvas.width = canvas.width; // clears it
  }

  async #load() {
    if (this.#isLoading || !this.#camera) return;
    this.#isLoading = true;
    const { name } = this.#camera;
    try {
      await Promise.all(kModels.map(async (model) => this.#pictures.set(model, await pictureOf(
        [["camera", name], ["which", "proposed"], ["model", model], ...this.view.query]))));
      this.#draw();
      setText(this.refused, "");
    } catch (error) {
      setText(this.refused, texts.refused(error.message));
    } finally {
      this.#isLoading = false;
    }
  }

  #draw() {
    for (const [model, picture] of this.#pictures) {
      const canvas = this.canvases.get(model), brush = canvas.getContext("2d");
      brush.drawImage(picture, 0, 0);
      canvas.dataset.number = Number(canvas.dataset.number ?? 0) + 1;
      this.#drawLine(brush, canvas.width);
    }
  }

  // Line through the whole picture, shifted from the middle by `offset` of its side.
  #drawLine(brush, side) {
    const a = Number(this.lines.angle.value) * Math.PI / 180;
    const x = Math.cos(a), y = Math.sin(a), beside = Number(this.lines.offset.value) * side;
    const u = side / 2 - beside * y, v = side / 2 + beside * x;
    brush.strokeStyle = "#ffd54a";
    brush.lineWidth = 1;
    brush.beginPath();
    brush.moveTo(u - side * x, v - side * y);
    brush.lineTo(u + side * x, v + side * y);
    brush.stroke();
  }
}
