// SPDX-License-Identifier: Apache-2.0
// Values of the displayed picture at the pointer: the mouse, a tap, or a crosshair moved by keys.
import { patience } from "../appliance/api.js";
import { element, setText } from "../elements/elements.js";
import { texts } from "../texts.js";

const kSteps = 50; // steps of the crosshair across the picture
const kMoves = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

const clamp = (value, low, high) => Math.min(high, Math.max(low, value));

export class Pointer {
  #place = null; // {u, v}, whole pixels of the picture
  #followsMouse = false;
  #isAsking = false;
  #isNews = false; // a position or a picture without a request yet
  #asked = 0; // number of the picture requested last
  #kept = 0; // number of the first picture kept by the appliance; 0: none
  #willSay = false; // announce the next answer to screen readers

  // `canvas` has the number of its picture as data.
  constructor(view, canvas) {
    this.view = view;
    this.canvas = canvas;
    this.mark = element("span", { className: "crosshair", hidden: true });
    this.reading = element("p", { className: "reading" });
    this.spoken = element("p", { className: "spoken", role: "status" });
    canvas.addEventListener("pointermove", (event) => {
      if (event.pointerType === "mouse") this.#at(event);
    });
    canvas.addEventListener("pointerleave", (event) => {
      if (event.pointerType === "mouse" && this.#followsMouse) this.clear();
    });
    canvas.addEventListener("click", (event) => this.#at(event));
    canvas.addEventListener("keydown", (event) => this.#key(event));
  }

  // Handles a new displayed picture.
  follow() {
    if (this.#place) this.#ask();
  }

  clear() {
    this.#place = null;
    this.mark.hidden = true;
    setText(this.reading, "");
    delete this.reading.dataset.number;
  }

  #at({ offsetX, offsetY, pointerType }) {
    const { clientWidth, clientHeight, width, height } = this.canvas;
    this.#followsMouse = pointerType !== "touch";
    this.#point(Math.floor((offsetX / clientWidth) * width),
      Math.floor((offsetY / clientHeight) * height));
  }

  // With shift, keys turn the view instead.
  #key(event) {
    if (event.shiftKey || event.altKey || event.metaKey) return;
    if (event.key === "Escape") return this.clear();
    const move = kMoves[event.key];
    if (!move) return;
    event.preventDefault();
    const { width, height } = this.canvas;
    const { u, v } = this.#place ?? { u: width / 2, v: height / 2 };
    const step = event.ctrlKey ? 1 : Math.ceil(width / kSteps);
    this.#followsMouse = false;
    this.#willSay = true;
    this.#point(Math.floor(u + move[0] * step), Math.floor(v + move[1] * step));
  }

  #point(u, v) {
    const { width, height } = this.canvas;
    this.#place = { u: clamp(u, 0, width - 1), v: clamp(v, 0, height - 1) };
    this.mark.hidden = this.#followsMouse;
    this.mark.style.left = `${(100 * (this.#place.u + 0.5)) / width}%`;
    this.mark.style.top = `${(100 * (this.#place.v + 0.5)) / height}%`;
    this.#ask();
  }

  // Sends one request at a time, for the picture displayed at that moment.
  async #ask() {
    this.#isNews = true;
    if (this.#isAsking) return;
    this.#isAsking = true;
    while (this.#isNews && this.#place && this.canvas.dataset.number) {
      this.#isNews = false;
      const { u, v } = this.#place, number = Number(this.canvas.dataset.number);
      // Numbers begin with 1 after a restart of the appliance.
      if (number < this.#asked) this.#kept = 0;
      this.#asked = number;
      if (!this.#kept) await this.#begin({ u, v });
      else if (number >= this.#kept) await this.#read({ u, v, number });
    }
    this.#isAsking = false;
  }

  // The first request makes the appliance keep pictures from the next one on.
  async #begin(place) {
    const { said } = await this.#answer(place);
    this.#kept = said?.number ?? 0;
  }

  async #read(asked) {
    const { said, refused, isGone } = await this.#answer(asked);
    if (isGone) this.#kept = 0;
    if (!this.#place || isGone) return;
    const text = refused ? texts.refused(refused) : texts.pixel(said);
    setText(this.reading, text);
    Object.assign(this.reading.dataset, asked);
    if (!this.#willSay) return;
    this.#willSay = false;
    setText(this.spoken, text);
  }

  async #answer(asked) {
    const query = new URLSearchParams({ view: this.view, ...asked });
    try {
      const answer = await fetch(`api/v1/live/pixel?${query}`, patience());
      const said = await answer.json();
      return answer.ok ? { said } : { refused: said.error, isGone: answer.status === 410 };
    } catch (error) {
      return { refused: error.message };
    }
  }
}
