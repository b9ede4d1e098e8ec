// SPDX-License-Identifier: Apache-2.0
// The single connection for status and pictures. It is reopened for ever, and closed while the page is
// hidden.
import { Framing } from "./framing.js";

const kRetryMs = 500;
// Silence after which the connection counts as dead; the appliance reports four times a second.
const kSilenceMs = 3000;
// The same until the answer begins, perhaps after a TLS handshake over a slow link.
const kOpeningMs = 6000;
const kUnknown = 404;

// An answer other than a stream. The message is the appliance's reason; empty: another program answered.
class Refusal extends Error {
  constructor(status, why) {
    super(why);
    this.isUnknown = status === kUnknown && why !== "";
  }
}

async function refusalOf(answer) {
  const { error = "" } = await answer.json().catch(() => ({}));
  return new Refusal(answer.status, error);
}

export class Stream {
  #views = null; // {name, width}; null before the first choice
  #refused = ""; // reason why the views are not requested: one of them is unknown; empty: they are
  #abort = null;
  #retry = 0;
  #silence = 0;

  // `onMessage({head, body, received})`, `received`: time of performance.now(). `onLost(why)`: reason of a refusal;
  // empty: no connection. `onPaused()`: closed because the page is hidden.
  constructor({ onMessage, onLost, onPaused }) {
    Object.assign(this, { onMessage, onLost });
    document.addEventListener("visibilitychange", () => {
      if (document.hidden) onPaused();
      this.#restart();
    });
  }

  // `views`: names with the width in which each is asked for, 0: in full.
  choose(views) {
    if (JSON.stringify(views) === JSON.stringify(this.#views)) return;
    this.#views = [...views];
    this.#restart();
  }

  // Reason why only the status is sent; empty: the views are sent, too.
  get refused() {
    return this.#refused;
  }

  #restart(refused = "") {
    this.#refused = refused;
    this.#abort?.abort();
    this.#abort = null;
    clearTimeout(this.#retry);
    clearTimeout(this.#silence);
    if (!document.hidden) this.#run();
  }

  async #run() {
    const abort = new AbortController();
    this.#abort = abort;
    let end = null;
    try {
      await this.#read(abort);
    } catch (error) {
      if (!abort.signal.aborted) console.info(`stream: ${error.message}`);
      end = error;
    }
    if (this.#abort === abort) this.#reopen(end instanceof Refusal ? end : null);
  }

  // Omits the views if one of them is unknown: the status has the names of those of a restarted appliance.
  #reopen(refusal) {
    const refused = refusal?.isUnknown && this.#refused === "" ? refusal.message : "";
    this.#retry = setTimeout(() => this.#restart(refused), refused ? 0 : kRetryMs);
    this.onLost(refusal?.message ?? "");
  }

  async #read(abort) {
    this.#expectWord(abort, kOpeningMs);
    const views = this.#refused ? [] : this.#views;
    const query = new URLSearchParams(views.flatMap(({ name, width }) => [["view", name], ["width", width]]));
    const answer = await fetch(`api/v1/live?${query}`, { signal: abort.signal });
    if (!answer.ok) throw await refusalOf(answer);
    const framing = new Framing();
    const reader = answer.body.getReader();
    for (;;) {
      this.#expectWord(abort, kSilenceMs);
      const { done, value } = await reader.read();
      if (done) return;
      const received = performance.now();
      for (const message of framing.push(value)) this.onMessage({ ...message, received });
    }
  }

  #expectWord(abort, limit) {
    clearTimeout(this.#silence);
    this.#silence = setTimeout(() => {
      if (this.#abort !== abort) return;
      this.onLost("");
      this.#restart();
    }, limit);
  }
}
