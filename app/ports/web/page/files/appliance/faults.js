// SPDX-License-Identifier: Apache-2.0
// Faults of the cameras that a view is made from.
export class Faults {
  #texts = new Map(); // fault by camera, of those that have one
  #cameras = null;    // names by view; null: to be asked for

  status({ cameras }) {
    this.#texts = new Map(cameras.filter(({ fault }) => fault !== 0)
      .map(({ name, fault_text: text }) => [name, text]));
    if (!this.#cameras) this.#describe();
  }

  // The views may be others after a restart.
  lost() {
    this.#cameras = null;
  }

  async #describe() {
    this.#cameras = new Map();
    try {
      const answer = await fetch("api/v1/views");
      if (!answer.ok) throw new Error(`status ${answer.status}`);
      const { views } = await answer.json();
      this.#cameras = new Map(views.map(({ name, sources }) => [name, sources.map(({ camera }) => camera)]));
    } catch (error) {
      console.info(`views: ${error.message}`);
      this.#cameras = null; // retried with the next status
    }
  }

  // Empty: it delivers.
  ofCamera(name) {
    return this.#texts.has(name) ? `${name}: ${this.#texts.get(name)}` : "";
  }

  ofView(name) {
    return (this.#cameras?.get(name) ?? []).map((camera) => this.ofCamera(camera)).filter(Boolean).join(". ");
  }
}
