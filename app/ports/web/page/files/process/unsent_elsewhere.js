// SPDX-License-Identifier: Apache-2.0
// Unsent changes of recipes that do not run: each is named, and can be discarded.
import { Cards } from "../elements/cards.js";
import { button, element, setText } from "../elements/elements.js";
import { texts } from "../texts.js";

// One recipe, updated in place. `discard(number)` is called when its button is pressed.
class Unsent {
  constructor({ number }, discard) {
    this.text = element("span");
    this.root = element("p", { className: "buttons" }, this.text, button(texts.align.discard, () => discard(number)));
  }

  show(recipe) {
    setText(this.text, texts.process.unsent(recipe));
  }
}

export class UnsentElsewhere {
  constructor(recipe) {
    this.root = element("div", { id: "unsent", "aria-live": "polite" });
    const shown = new Cards(this.root, ({ number }) => number,
      (one) => new Unsent(one, (number) => recipe.forget(number)));
    recipe.addEventListener("change", () => shown.show(recipe.others));
  }
}
