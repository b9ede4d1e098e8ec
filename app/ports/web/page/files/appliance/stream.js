// SPDX-License-Identifier: Apache-2.0
// The single connection for status and pictures. It is reopened for ever, and closed while the page is
// hidden.
import { Framing } from "./framing.js";

const kRetryMs = 500;
// Silence after which the connection counts as dead; the appliance reports four times a second.
const kSilenceMs = 3000;

export class Stream {
  #views = null; // {name, width}; null before the first choice
  #abort = null;
  #retry = 0;
  #silence = 0;

  // `onMessage({head, body, received})`, `received`: time of performance.now(); `onLost()`.
  constructor(onMessage, onLost) {
    this.onMessage = onMessage;
    this.onLost = onLost;
    document.addEventListener("visibilitychange", () => this.#restart());
  }

  // `views`: names with the width in which each is asked for, 0: in full.
  choose(views) {
    if (JSON.stringify(views) === JSON.stringify(this.#views)) return;
    this.#views = [...views];
    this.#restart();
  }

  #restart() {
    this.#abort?.abort();
    this.#abort = null;
    clearTimeout(this.#retry);
    clearTimeout(this.#silence);
    if (!document.hidden) this.#run();
  }

  async #run() {
    const abort = new AbortController();
    this.#abort = abort;
    try {
      await this.#read(abort);
    } catch (error) {
      if (!abort.signal.aborted) console.info(`stream: ${error.message}`);
    }
    if (this.#abort !== abort) return;
    this.onLost();
    this.#retry = setTimeout(() => this.#restart(), kRetryMs);
  }

  async #read(abort) {
    const query = new URLSearchParams(this.#views.flatMap(({ name, width }) => [["view", name], ["width", width]]));
    const answer = await fetch(`api/v1/live?${query}`, { signal: abort.signal });
    if (!answer.ok) throw new Error(`status ${answer.status}`);
    const framing = new Framing();
    const reader = answer.body.getReader();
    for (;;) {
      this.#expectWord(abort);
      const { done, value } = await reader.read();
      if (done) return;
      const received = performance.now();
      for (const message of framing.push(value)) this.onMessage({ ...message, received });
    }
  }

  #expectWord(abort) {
    clearTimeout(this.#silence);
    this.#silence = setTimeout(() => {
      if (this.#abort === abort) {
        this.onLost();
        this.#restart();
      }
    }, kSilenceMs);
  }
}
