// SPDX-License-Identifier: Apache-2.0
// Two changes of one file, of which the user takes one for each part.
import { element } from "../elements/elements.js";
import { texts } from "../texts.js";
import { partsOf, usualChoice } from "./three_way.js";

export class Merge {
  #shown = "";    // the three texts
  #parts = [];
  #choices = [];  // by part: "theirs", "mine" or null

  // `onTake(text)`: the user takes the text that results.
  constructor(name, onTake) {
    Object.assign(this, { name, onTake });
    this.list = element("div");
    this.take = element("button", { type: "button" }, texts.merge.take);
    this.take.addEventListener("click", () => this.onTake(this.#text));
    this.root = element("section", { className: "merge", hidden: true },
      element("p", {}, texts.merge.help), this.list, element("p", {}, this.take));
  }

  hide() {
    this.root.hidden = true;
    this.#shown = "";
  }

  // Choices that were made are kept as long as the texts stay the same.
  show(base, theirs, mine) {
    this.root.hidden = false;
    const shown = JSON.stringify([base, theirs, mine]);
    if (shown === this.#shown) return;
    this.#shown = shown;
    this.#parts = partsOf(base, theirs, mine);
    this.#choices = this.#parts.map((part) => (part.same ? null : usualChoice(part)));
    this.list.replaceChildren(...this.#parts.flatMap((part, index) => (part.same ? [] : [this.#makePart(part, index)])));
    this.#enable();
  }

  #makePart(part, index) {
    const sides = ["theirs", "mine"].map((side) => {
      const button = element("input", { type: "radio", name: `merge ${this.name} ${index}`, value: side,
        checked: this.#choices[index] === side });
      button.addEventListener("change", () => {
        this.#choices[index] = side;
        this.#enable();
      });
      return element("div", {}, element("label", {}, button, " ", texts.merge[side]), this.#lines(part[side]));
    });
    return element("fieldset", {}, element("legend", {}, texts.merge.line(part.line)),
      element("div", {}, texts.merge.base, this.#lines(part.base)), ...sides);
  }

  #lines(lines) {
    return element("pre", {}, lines.length > 0 ? lines.join("\n") : texts.merge.nothing);
  }

  #enable() {
    this.take.disabled = this.#parts.some((part, index) => !part.same && !this.#choices[index]);
  }

  get #text() {
    return this.#parts.flatMap((part, index) => part.same ?? part[this.#choices[index]]).join("\n");
  }
}
