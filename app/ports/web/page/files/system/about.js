// SPDX-License-Identifier: Apache-2.0
// Versions, and interfaces that accept commands; loaded once, when the page is shown.
import { read } from "../appliance/api.js";
import { Card } from "../elements/card.js";
import { element, table } from "../elements/elements.js";
import { texts } from "../texts.js";

export class About {
  #isLoaded = false;

  constructor() {
    this.card = new Card("about", texts.about);
    this.root = this.card.root;
  }

  async status() {
    if (this.#isLoaded) return;
    this.#isLoaded = true;
    const about = await read("api/v1/about").catch(() => null);
    this.#isLoaded = about !== null; // else retried with the next status
    if (about) this.#show(about);
  }

  #show({ versions, commanders }) {
    const { root, body } = table([texts.program, texts.version], texts.about);
    for (const [name, version] of Object.entries(versions)) {
      body.append(element("tr", {}, element("th", { scope: "row" }, name), element("td", {}, version)));
    }
    this.card.say(Object.entries(versions)[0].join(" "));
    this.card.append(element("p", {}, texts.commanders(commanders)), root);
  }
}
