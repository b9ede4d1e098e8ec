// Loads something again whenever what it is of has changed: one load at a time, and the last one counts.
import { element, setText } from "../elements/elements.js";
import { texts } from "../texts.js";

export class Reload {
  #loaded = "";
  #isLoading = false;

  // `load()`: a promise. Why it failed stands in `refused`; the next call of of() tries again.
  constructor(load) {
    this.load = load;
    this.refused = element("p", { role: "alert", className: "wrong" });
  }

  forget() {
    this.#loaded = "";
  }

  // To be called again and again.
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
