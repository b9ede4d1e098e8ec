// SPDX-License-Identifier: Apache-2.0
// Reloads data whenever its key has changed, and periodically: one load at a time, and the last one wins.
import { element, setText } from "../elements/elements.js";
import { texts } from "../texts.js";

const kAgainMs = 2000;

export class Reload {
  #loaded = "";
  #loadedAt = 0;
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
    const isNew = performance.now() < this.#loadedAt + kAgainMs;
    if (this.#isLoading || (wanted === this.#loaded && isNew)) return;
    this.#isLoading = true;
    try {
      await this.load();
      this.#loaded = wanted;
      this.#loadedAt = performance.now();
      setText(this.refused, "");
    } catch (error) {
      setText(this.refused, texts.refused(error.message));
    } finally {
      this.#isLoading = false;
    }
  }
}
