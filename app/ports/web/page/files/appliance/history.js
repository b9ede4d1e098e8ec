// SPDX-License-Identifier: Apache-2.0
// The last ten minutes of one figure: its history from the appliance, and newer values.
import { read } from "./api.js";

export const kHistoryMs = 600000;
// A status has momentary values; the appliance also keeps the peaks between two of them.
const kAgainMs = 10000;

// Capacity for all values that the appliance reports in that time, four per second, and some more.
const kMostValues = 3000;

// Memory is allocated at once.
class Ring {
  #at = new Float64Array(kMostValues); // ms
  #values = new Float64Array(kMostValues); // NaN: not measured
  #oldest = 0;
  #count = 0;

  // `value` null: not measured.
  add(at, value) {
    if (this.#count === kMostValues) this.#forgetOldest();
    const place = (this.#oldest + this.#count) % kMostValues;
    this.#at[place] = at;
    this.#values[place] = value ?? NaN;
    ++this.#count;
    while (this.#at[this.#oldest] < at - kHistoryMs) this.#forgetOldest();
  }

  #forgetOldest() {
    this.#oldest = (this.#oldest + 1) % kMostValues;
    --this.#count;
  }

  // {at, low, high}, oldest first; null where nothing was measured.
  get points() {
    return Array.from({ length: this.#count }, (_, index) => {
      const place = (this.#oldest + index) % kMostValues;
      const value = Number.isNaN(this.#values[place]) ? null : this.#values[place];
      return { at: this.#at[place], low: value, high: value };
    });
  }
}

// {at, low, high} of each step that the appliance kept, oldest first.
function stepsOf({ step, age, low, high }, received) {
  const end = received - 1000 * age;
  return low.map((value, index) => (
    { at: end - 1000 * step * (low.length - 1 - index), low: value, high: high[index] }));
}

export class History {
  #seen = new Ring();
  #kept = [];
  #askedAt = -Infinity;

  // `figure`: {region or camera, figure}, their names.
  constructor(figure) {
    this.path = `api/v1/history?${new URLSearchParams(figure)}`;
  }

  // `at` and `now` are times of performance.now().
  add(at, value) {
    this.#seen.add(at, value);
  }

  // Requests the history from the appliance, at once and then periodically.
  async refresh(now) {
    if (now < this.#askedAt + kAgainMs) return;
    this.#askedAt = now;
    const kept = await read(this.path).catch(() => null);
    if (kept) this.#kept = stepsOf(kept, performance.now());
  }

  // {at, low, high}, oldest first; null where nothing was measured. Includes values received while the
  // appliance had no history, for example before a restart.
  get points() {
    const seen = this.#seen.points;
    if (this.#kept.length === 0) return seen;
    const from = this.#kept[0].at, until = this.#kept.at(-1).at;
    return [...seen.filter(({ at }) => at < from), ...this.#kept, ...seen.filter(({ at }) => at > until)];
  }
}
