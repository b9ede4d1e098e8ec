// SPDX-License-Identifier: Apache-2.0
// Reloads data whenever its key has changed: one load at a time, and the last one wins.
import { element, setText } from "../elements/elements.js";
import { texts } from "../texts.js";

export class Reload {
  #loaded = "";
  #isLoading = false;

  // `load()`: a promise. The reason of a failure is in `refused`; the next call of of() retries.
  constructor(load) {
    this.load = load;
    this.refused = element("p", { role: "alert", className: "wrong" });
  }

  forget() {
    this.#loaded = "";
  }

  // To be called repeatedly.
  async of(what) {
    const wanted = JSON.stringify(what);
    if (this.#isLoading || wanted === this.#loaded) return;
    this.#isLoading = true;
    try {
      await this.load();
      this.#loaded = wanted;
      setText(this.refused, "");
    } catch (error) {
      setText(this.refused, texts.refused(error.message));
    } finally {
      this.#isLoading = false;
    }
  }
}
