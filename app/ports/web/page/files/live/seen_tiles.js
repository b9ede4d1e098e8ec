// SPDX-License-Identifier: Apache-2.0
// Tiles that are not scrolled out of sight.

// Time until tiles that have left are noticed: each change opens the stream anew.
const kLeaveMs = 500;
const kLeastShare = 0.01;  // of its area: a neighbour touches the edge of the screen

export class SeenTiles {
  #names = new Map();   // by element
  #inSight = new Set(); // names, at present
  #seen = new Set();    // names, as noticed
  #leave = 0;
  #observer = new IntersectionObserver((entries) => this.#note(entries), { threshold: kLeastShare });

  // `onChange()`: other tiles are seen.
  constructor(onChange) {
    this.onChange = onChange;
  }

  watch(tile, name) {
    this.#names.set(tile, name);
    this.#observer.observe(tile);
  }

  // Stops watching a tile that is removed.
  forget(tile) {
    const name = this.#names.get(tile);
    this.#observer.unobserve(tile);
    this.#names.delete(tile);
    this.#inSight.delete(name);
    this.#seen.delete(name);
  }

  has(name) {
    return this.#seen.has(name);
  }

  #note(entries) {
    for (const { target, isIntersecting } of entries) {
      this.#inSight[isIntersecting ? "add" : "delete"](this.#names.get(target));
    }
    clearTimeout(this.#leave);
    const isMore = [...this.#inSight].some((name) => !this.#seen.has(name));
    if (isMore) this.#notice();
    else this.#leave = setTimeout(() => this.#notice(), kLeaveMs);
  }

  #notice() {
    this.#seen = new Set(this.#inSight);
    this.onChange();
  }
}
