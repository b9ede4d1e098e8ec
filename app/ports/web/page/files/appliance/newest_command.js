// SPDX-License-Identifier: Apache-2.0
// Commands that follow a gesture: one at a time, and while it is executed only the newest one waits.
import { command } from "./api.js";

export class NewestCommand {
  #isSending = false;
  #waiting = null;

  // `onAnswer(why)`: empty: done.
  constructor(name, onAnswer) {
    this.name = name;
    this.onAnswer = onAnswer;
  }

  async send(body) {
    this.#waiting = body;
    if (this.#isSending) return;
    this.#isSending = true;
    while (this.#waiting) {
      const next = this.#waiting;
      this.#waiting = null;
      this.onAnswer(await command(this.name, next));
    }
    this.#isSending = false;
  }
}
