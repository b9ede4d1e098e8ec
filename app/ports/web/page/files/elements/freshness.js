// SPDX-License-Identifier: Apache-2.0
// The age of a picture that is replaced by newer ones, or of the oldest of several that are displayed as one, and a
// veil with the reason over one that is old or whose camera has a fault.
import { texts } from "../texts.js";
import { element, setText } from "./elements.js";

const kStaleMs = 2000;

export class Freshness {
  #displayed = new Map(); // {age_ms, received} of the displayed pictures by view

  // `picture`: the element around the canvas. `staleMs`: age of an old picture.
  constructor(picture, staleMs = kStaleMs) {
    Object.assign(this, { picture, staleMs });
    this.overlay = element("p", { className: "overlay" });
    this.age = element("span", { className: "age" }, texts.noPicture);
    picture.append(this.overlay);
  }

  // `age_ms`: age at `received`, which is of performance.now(). `view`: of several that are displayed as one picture.
  drew(age_ms, received, view = "") {
    this.#displayed.set(view, { age_ms, received });
  }

  // Forgets pictures of other views than these, which are replaced.
  keep(views) {
    for (const view of this.#displayed.keys()) if (!views.includes(view)) this.#displayed.delete(view);
    if (!this.hasPicture) setText(this.age, texts.noPicture);
  }
  forget() {
    this.keep([]);
  }

  get hasPicture() {
    return this.#displayed.size > 0;
  }

  // Age of the oldest displayed picture, ms; 0: none is displayed.
  #oldest() {
    const now = performance.now();
    return Math.max(0, ...[...this.#displayed.values()].map(({ age_ms, received }) => age_ms + now - received));
  }

  // `faults`: of its cameras; empty: none. Returns the reason of the veil; empty: there is none.
  tick(faults) {
    const age = this.#oldest(), isOld = age > this.staleMs;
    if (this.hasPicture) setText(this.age, texts.age(age));
    this.age.classList.toggle("wrong", isOld);
    this.picture.classList.toggle("veiled", isOld || faults !== "");
    const why = [isOld ? texts.stale(age) : "", faults].filter(Boolean).join(". ");
    setText(this.overlay, why);
    return why;
  }
}
