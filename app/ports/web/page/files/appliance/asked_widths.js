// SPDX-License-Identifier: Apache-2.0
// Widths in which views are asked for. The appliance sends the smallest of a view's sizes that is wide enough; the page
// asks anew only when another size is due, because each change opens the stream anew.

const kSmaller = 0.9; // share of a smaller size from which on it is asked for; a larger one is at once

// The size sent for a width in which a view is displayed; 0: the full one. `sizes`: widths, the largest first.
function sizeFor(width, sizes) {
  return (width > 0 && sizes.findLast((size) => size >= width)) || sizes[0];
}

export class AskedWidths {
  #asked = new Map(); // widths by view

  // `views`: see Views.
  constructor(views) {
    this.views = views;
  }

  // `shown`: views with the width in which they are displayed, device px; 0: in full; and `sizes` of those that Views
  // does not have. Returns the same with the widths to ask for.
  of(shown) {
    return shown.map(({ name, width, sizes = this.views.sizesOf(name) }) => {
      const before = this.#asked.get(name);
      if (before === undefined || this.#isDue(before, width, sizes)) this.#asked.set(name, width);
      return { name, width: this.#asked.get(name) };
    });
  }

  #isDue(before, width, sizes) {
    if (sizes.length === 0) return false;
    const size = sizeFor(width, sizes), sent = sizeFor(before, sizes);
    return size > sent || (size < sent && width <= kSmaller * size);
  }
}

// Width of an element, device px.
export const shownWidth = ({ clientWidth }) => Math.ceil(clientWidth * window.devicePixelRatio);
