// SPDX-License-Identifier: Apache-2.0
// The views as /api/v1/views has them, loaded once and again after a lost connection.
import { read } from "./api.js";

const kBall = "ball:"; // prefix of a camera's own picture, see /api/v1/look-around

export class Views extends EventTarget {
  #isStale = true; // the views may be older than a restart
  all = [];
  maps = [];

  async status() {
    if (!this.#isStale) return;
    this.#isStale = false;
    try {
      ({ views: this.all, colour_maps: this.maps } = await read("api/v1/views"));
      this.dispatchEvent(new Event("change"));
    } catch (error) {
      console.info(`views: ${error.message}`);
      this.#isStale = true; // retried with the next status
    }
  }

  lost() {
    this.#isStale = true;
  }

  // Widths of the sizes in which a view's pictures are sent, the largest first; none: not known.
  sizesOf(name) {
    return this.all.find((view) => view.name === name)?.widths ?? [];
  }

  // Names of the cameras of a view; none: the view is unknown yet.
  camerasOf(name) {
    if (name.startsWith(kBall)) return [name.slice(kBall.length)];
    return this.all.find((view) => view.name === name)?.sources.map(({ camera }) => camera) ?? [];
  }
}
