// SPDX-License-Identifier: Apache-2.0
// The age of a picture that is replaced by newer ones, and a veil with the reason over one that is old or whose
// camera has a fault.
import { texts } from "../texts.js";
import { element, setText } from "./elements.js";

const kStaleMs = 2000;

export class Freshness {
  #latest = null; // {age_ms, received} of the displayed picture

  // `picture`: the element around the canvas. `staleMs`: age of an old picture.
  constructor(picture, staleMs = kStaleMs) {
    Object.assign(this, { picture, staleMs });
    this.overlay = element("p", { className: "overlay" });
    this.age = element("span", { className: "age" }, texts.noPicture);
    picture.append(this.overlay);
  }

  // `age_ms`: age at `received`, which is of performance.now().
  drew(age_ms, received) {
    this.#latest = { age_ms, received };
  }

  // Another picture takes its place.
  forget() {
    this.#latest = null;
    setText(this.age, texts.noPicture);
  }

  get hasPicture() {
    return this.#latest !== null;
  }

  // `faults`: of its cameras; empty: none. Returns the reason of the veil; empty: there is none.
  tick(faults) {
    const age = this.#latest ? this.#latest.age_ms + performance.now() - this.#latest.received : 0;
    const isOld = age > this.staleMs;
    if (this.#latest) setText(this.age, texts.age(age));
    this.age.classList.toggle("wrong", isOld);
    this.picture.classList.toggle("veiled", isOld || faults !== "");
    const why = [isOld ? texts.stale(age) : "", faults].filter(Boolean).join(". ");
    setText(this.overlay, why);
    return why;
  }
}
