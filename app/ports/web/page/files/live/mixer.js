// SPDX-License-Identifier: Apache-2.0
// Shares of a view's cameras, changed by sliders, for all users.
import { NewestCommand } from "../appliance/newest_command.js";
import { element } from "../elements/elements.js";
import { texts } from "../texts.js";

const kSettleMs = 1000; // same as for a pointed view
const kLeast = 0.001, kMost = 1000; // range of the command

export class Mixer {
  #weights = [];
  #mixed = -Infinity; // time of performance.now()

  // A view from /api/v1/views; `say(what)`: reason of a refusal; empty: accepted. There is a slider for each
  // camera besides the first one.
  constructor({ index, sources }, say) {
    const answer = (why) => say(why ? texts.refused(why) : "");
    this.index = index;
    this.commands = sources.map(() => new NewestCommand("mix_sources", answer));
    this.sliders = sources.slice(1).map(({ camera }, n) => {
      const slider = element("input", { type: "range", min: 0, max: 100, name: `share-${camera}` });
      slider.addEventListener("input", () => this.#mix(n + 1, slider.value / 100));
      return slider;
    });
    this.root = element("p", { className: "mixer" }, ...this.sliders.map((slider, n) =>
      element("label", {}, texts.shareOf(sources[n + 1].camera, sources[0].camera), " ", slider)));
  }

  // Weights in the displayed picture.
  follow(weights) {
    if (performance.now() - this.#mixed < kSettleMs) return;
    this.#weights = weights;
    this.sliders.forEach((slider, n) => {
      slider.value = Math.round((100 * weights[n + 1]) / (weights[0] + weights[n + 1]));
    });
  }

  #mix(source, share) {
    this.#mixed = performance.now();
    const weight = ((this.#weights[0] ?? 1) * share) / (1 - share);
    this.commands[source].send({ view: this.index, source,
      weight: Math.min(kMost, Math.max(kLeast, weight)) });
  }
}
