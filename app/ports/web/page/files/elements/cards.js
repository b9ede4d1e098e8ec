// SPDX-License-Identifier: Apache-2.0
// A list of cards, each made once and updated in place.

export class Cards {
  #cards = new Map();  // by key

  // `make(item)` makes a card: {root, show(item)}; `keyOf(item)` is what it is known by.
  constructor(list, keyOf, make) {
    Object.assign(this, { list, keyOf, make });
  }

  // Shows these items, in this order, and no others.
  show(items) {
    const listed = new Set(items.map(this.keyOf));
    for (const [key, card] of this.#cards) {
      if (listed.has(key)) continue;
      card.root.remove();
      this.#cards.delete(key);
    }
    items.forEach((item, place) => {
      const card = this.#card(item);
      card.show(item);
      // Moves only misplaced elements, so that focus and scroll position are kept.
      if (this.list.children[place] !== card.root) {
        this.list.insertBefore(card.root, this.list.children[place] ?? null);
      }
    });
  }

  #card(item) {
    const key = this.keyOf(item);
    if (!this.#cards.has(key)) this.#cards.set(key, this.make(item));
    return this.#cards.get(key);
  }
}
