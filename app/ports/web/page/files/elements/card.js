// SPDX-License-Identifier: Apache-2.0
// A card with an icon, a title and its state in a line; opened, its contents are shown below.
import { element, setText } from "./elements.js";
import { icon } from "./icons.js";

export class Card {
  // `name`: its id and that of its icon.
  constructor(name, title, state = "") {
    this.state = element("span", { className: "state" }, state);
    this.root = element("details", { id: name, className: "card" },
      element("summary", {}, icon(name), element("h3", {}, title), this.state));
  }

  // True: the contents are shown.
  get isOpen() {
    return this.root.open;
  }

  append(...contents) {
    this.root.append(...contents);
  }

  say(state, isWrong = false) {
    setText(this.state, state);
    this.state.classList.toggle("wrong", isWrong);
  }

  // `act()` is called when it is opened.
  whenOpened(act) {
    this.root.addEventListener("toggle", () => this.isOpen && act());
  }
}
