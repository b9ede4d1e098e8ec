// SPDX-License-Identifier: Apache-2.0
// Placement of a camera in the machine by known points in its picture.
import { decimalText } from "../elements/amounts.js";
import { commandButton, element, field, setText, table } from "../elements/elements.js";
import { texts } from "../texts.js";

const kCoordinates = ["x", "y", "z"];

const kOffered = 3;  // corners beside a pixel

function number(label, name) {
  return field(label, { type: "number", name, step: "any" });
}

const rounded = (numbers, digits) => texts.place.list(numbers.map((one) => decimalText(one, digits)));

function isOnScreen(shown) {
  const { top, bottom } = shown.getBoundingClientRect();
  return top >= 0 && bottom <= document.documentElement.clientHeight;
}

export class Place {
  #corners = [];  // of the scene, by the alignment that is shown

  // `gestures`: see Gestures. `onMark(pixel)`: the pixel in the form has changed; null: there is none. `mayAlign`: the
  // user may add and remove points.
  constructor(gestures, onMark, mayAlign) {
    Object.assign(this, { gestures, onMark, mayAlign });
    const give = (name) => gestures.give(name);
    this.pixel = element("form", { id: "point" }, number(texts.place.u, "u"), number(texts.place.v, "v"),
      ...kCoordinates.map((name) => number(texts.place[name], name)),
      element("button", {}, texts.place.add));
    this.pixel.addEventListener("submit", (event) => {
      event.preventDefault();
      this.#add();
    });
    this.pixel.addEventListener("input", () => this.#mark());
    const light = element("button", { type: "button" }, texts.place.light);
    light.addEventListener("click", () => this.#markLight());
    this.offers = element("p", { className: "buttons" });
    this.run = commandButton(texts.place.run, "place_camera", give);
    this.forget = commandButton(texts.place.forget, "forget_points", give);
    this.points = table([texts.place.point, texts.place.pixel, texts.place.residual, "", ""],
      texts.place.points);
    this.root = element("section", { id: "place" }, ...(mayAlign ? [element("p", {}, texts.place.help), this.pixel,
      element("p", { className: "buttons" }, light, this.run, this.forget), this.offers] : []), this.points.root);
  }

  #coordinates() {
    return Object.fromEntries(kCoordinates.map((name) =>
      [name, Number(this.pixel.elements[name].value)]));
  }

  #typed() {
    return JSON.stringify([...new FormData(this.pixel)]);
  }

  // Reads the form before the first request: by the time of an answer it may be another camera's, or the next point is
  // begun in it.
  async #add() {
    const { u, v } = this.pixel.elements, pixel = { u: Number(u.value), v: Number(v.value) };
    const gesture = this.gestures.begin(), point = this.#coordinates(), sent = this.#typed();
    const isAdded = await gesture?.give("pick_pixel", pixel) && await gesture.give("mark_point", point);
    if (isAdded && !gesture.isOver() && this.#typed() === sent) this.forgetPixel();
  }

  #mark() {
    const { u, v } = this.pixel.elements;
    const pixel = u.value && v.value ? [Number(u.value), Number(v.value)] : null;
    this.#offer(pixel);
    this.onMark(pixel);
  }

  // Offers the scene's corners that the picture shows nearest to the pixel; the chosen one is added.
  #offer(at) {
    const distance = ({ pixel: [u, v] }) => Math.hypot(u - at[0], v - at[1]);
    const nearest = at ? [...this.#corners].sort((a, b) => distance(a) - distance(b)).slice(0, kOffered) : [];
    this.offers.replaceChildren(...nearest.map(({ point }) => {
      const button = element("button", { type: "button" }, texts.place.corner(rounded(point, 1)));
      button.addEventListener("click", () => {
        kCoordinates.forEach((name, k) => { this.pixel.elements[name].value = Number(point[k].toFixed(2)); });
        this.#add();
      });
      return button;
    }));
  }

  forgetPixel() {
    this.pixel.reset();
    this.#mark();
  }

  #markLight() {
    for (const name of kCoordinates) {
      if (!this.pixel.elements[name].reportValidity()) return;
    }
    this.gestures.give("mark_point", this.#coordinates());
  }

  // Handles a click in the picture, which stays where it is: a phone would scroll to a form that is below.
  pick([u, v]) {
    this.pixel.elements.u.value = u.toFixed(1);
    this.pixel.elements.v.value = v.toFixed(1);
    this.#mark();
    if (isOnScreen(this.pixel.elements.x)) this.pixel.elements.x.focus({ preventScroll: true });
  }

  show({ points, is_watched: isWatched, proposed, in_force: inForce }, isWorking) {
    this.#corners = (proposed ?? inForce)?.corners ?? [];
    this.run.disabled = isWorking || !isWatched;
    this.forget.disabled = isWorking || points.length === 0;
    while (this.points.body.rows.length > points.length) this.points.body.lastChild.remove();
    points.forEach((point, index) => this.#showRow(point, index, isWorking));
  }

  // The row has its point, which its button discards.
  #addRow() {
    const remove = element("button", { type: "button", hidden: !this.mayAlign }, texts.remove);
    const row = element("tr", {}, ...[0, 1, 2, 3].map(() => element("td")), element("td", {}, remove));
    remove.addEventListener("click", () => this.gestures.give("forget_point", row.point));
    return this.points.body.appendChild(row);
  }

  #showRow({ point, pixel, residual, is_outlier: isOutlier }, index, isWorking) {
    const row = this.points.body.rows[index] ?? this.#addRow();
    row.point = Object.fromEntries(kCoordinates.map((name, k) => [name, point[k]]));
    const cells = [rounded(point, 2), rounded(pixel, 1), residual ? rounded(residual, 2) : "–",
                   isOutlier ? texts.place.outlier : ""];
    cells.forEach((text, column) => setText(row.cells[column], text));
    row.classList.toggle("wrong", isOutlier);
    const remove = row.querySelector("button");
    remove.disabled = isWorking;
    remove.setAttribute("aria-label", texts.place.remove(cells[0]));
  }
}
