// SPDX-License-Identifier: Apache-2.0
// Number and name of a new recipe, a copy of the selected one with the changes made here.
import { element, field } from "../elements/elements.js";
import { texts } from "../texts.js";

export class RecipeCopy {
  #shown = 0;  // number of the recipe whose copy is shown

  constructor(recipe) {
    this.recipe = recipe;
    this.name = field(texts.process.copyAs, { name: "copy", required: false, maxLength: 40, autocomplete: "off" });
    this.number = field(texts.process.copyNumber, { name: "number", type: "number", min: 1, max: 65535, step: 1 });
    this.root = element("div", { id: "recipe-copy" }, element("p", { className: "buttons" }, this.name, this.number),
      element("p", { className: "quiet" }, texts.process.copyHelp));
    this.root.addEventListener("input", () => this.#take());
    recipe.addEventListener("change", () => this.#show());
    this.#show();
  }

  get #fields() {
    return [this.name, this.number].map((label) => label.querySelector("input"));
  }

  #take() {
    const [name, number] = this.#fields;
    this.recipe.copy = name.value ? { name: name.value, number: number.valueAsNumber || 0 } : null;
  }

  // Without a copy the number is the next free one. Fields in use change only with the recipe.
  #show() {
    const [name, number] = this.#fields, { copy, stated } = this.recipe;
    if (stated.number === this.#shown && this.root.contains(document.activeElement)) return;
    this.#shown = stated.number;
    name.value = copy?.name ?? "";
    if (!copy) number.value = Math.max(0, ...stated.recipes.map((recipe) => recipe.number)) + 1;
    else if (copy.number > 0) number.value = copy.number;
  }
}
