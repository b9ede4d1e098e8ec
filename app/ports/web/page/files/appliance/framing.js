// SPDX-License-Identifier: Apache-2.0
// Splits the body of /api/v1/live. Each message begins with a line of JSON, whose `bytes` is the number of
// bytes that follow.
const kNewline = 10;

export class Framing {
  #held = new Uint8Array(0);
  #head = null;

  // Returns the messages that `chunk` (Uint8Array) completes: {head, body}.
  push(chunk) {
    const all = new Uint8Array(this.#held.length + chunk.length);
    all.set(this.#held);
    all.set(chunk, this.#held.length);
    const messages = [];
    let at = 0;
    for (;;) {
      if (this.#head === null) {
        const end = all.indexOf(kNewline, at);
        if (end < 0) break;
        this.#head = JSON.parse(new TextDecoder().decode(all.subarray(at, end)));
        at = end + 1;
      }
      if (all.length - at < this.#head.bytes) break;
      messages.push({ head: this.#head, body: all.slice(at, at + this.#head.bytes) });
      at += this.#head.bytes;
      this.#head = null;
    }
    this.#held = all.slice(at);
    return messages;
  }
}
