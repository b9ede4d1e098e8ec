// SPDX-License-Identifier: Apache-2.0
// Layouts of the tiles: a number of equal ones that fill the screen, or a large one and several small ones. The choice
// is kept by the browser.
import { element } from "../elements/elements.js";
import { iconButton } from "../elements/icons.js";
import { keep, kept } from "../elements/kept.js";
import { texts } from "../texts.js";

const kNumbers = [1, 2, 4, 6, 9];
const kLarge = "large";
const kKept = "layout"; // key in the browser's storage

export class Layouts {
  #chosen = kept(kKept);

  // `tiles`: the element around the tiles; its style follows the data `layout`.
  constructor(tiles) {
    this.tiles = tiles;
    this.buttons = new Map([...kNumbers.map(String), kLarge].map((layout) => {
      const button = iconButton(`layout-${layout}`, texts.layout(layout === kLarge ? 0 : Number(layout)));
      button.addEventListener("click", () => {
        this.#chosen = layout;
        keep(kKept, layout);
        this.#apply(layout);
      });
      return [layout, button];
    }));
    this.root = element("div", { role: "group", className: "layouts", "aria-label": texts.layouts },
      ...this.buttons.values());
  }

  // Without a choice of the user: the smallest that shows `count` views at once.
  fit(count) {
    const fitting = String(kNumbers.find((number) => number >= count) ?? kNumbers.at(-1));
    this.#apply(this.buttons.has(this.#chosen) ? this.#chosen : fitting);
  }

  #apply(layout) {
    this.tiles.dataset.layout = layout;
    for (const [name, button] of this.buttons) button.setAttribute("aria-pressed", name === layout);
  }
}
