// SPDX-License-Identifier: Apache-2.0
// Views in tiles.
import { shownWidth } from "../appliance/asked_widths.js";
import { element } from "../elements/elements.js";
import { Keyed } from "../elements/figures.js";
import { followSize } from "../elements/resized.js";
import { texts } from "../texts.js";
import { Layouts } from "./layouts.js";
import { SeenTiles } from "./seen_tiles.js";
import { Tile } from "./tile.js";

export class Live {
  #chosen = null; // names; null before the first status
  #large = ""; // name of the large one, where the layout has one

  // `mayCommand`: the user may turn, mix and colour views.
  constructor(root, views, faults, onChoice, mayCommand) {
    Object.assign(this, { root, described: views, faults, onChoice });
    this.choices = element("fieldset", {}, element("legend", {}, texts.chooseViews));
    const tiles = element("div", { id: "tiles" });
    this.tiles = new Keyed(tiles, (name) => new Tile(name, mayCommand, () => this.#enlarge(name)));
    this.layouts = new Layouts(tiles);
    this.seen = new SeenTiles(onChoice);
    const help = element("details", {}, element("summary", {}, texts.help), element("p", {}, texts.liveHelp));
    root.append(element("div", { className: "choices" }, this.choices, this.layouts.root, help), tiles);
    views.addEventListener("change", () => this.#describe());
    setInterval(() => this.#tick(), 250);
  }

  status(status) {
    if (!this.#chosen) this.#begin(status.views);
  }

  #begin(views) {
    this.#chosen = new Map();
    for (const { name } of views) {
      this.#chosen.set(name, true);
      const box = element("input", { type: "checkbox", checked: true, name });
      box.addEventListener("change", () => this.#choose(name, box.checked));
      this.choices.append(element("label", {}, box, " ", name));
      this.seen.watch(this.tiles.get(name).root, name);
      followSize(this.tiles.get(name).canvas, this.onChoice);
    }
    this.#describe();
    this.#arrange();
  }

  #describe() {
    for (const view of this.described.all) {
      if (this.#chosen?.has(view.name)) this.tiles.get(view.name).describe(view, this.described.maps);
    }
  }

  get isShown() {
    return !this.root.hidden;
  }

  // Names and widths of the streamed views.
  get views() {
    return this.#shownNames().filter((name) => this.seen.has(name))
      .map((name) => ({ name, width: shownWidth(this.tiles.get(name).canvas) }));
  }

  #shownNames() {
    return [...(this.#chosen ?? [])].filter(([, is]) => is).map(([name]) => name);
  }

  picture(message) {
    this.tiles.get(message.head.name).show(message);
  }

  #choose(name, isChosen) {
    this.#chosen.set(name, isChosen);
    this.tiles.get(name).root.hidden = !isChosen;
    this.#arrange();
    this.onChoice();
  }

  #enlarge(name) {
    this.#large = name;
    this.#arrange();
  }

  #arrange() {
    const views = this.#shownNames();
    this.layouts.fit(views.length);
    const large = views.includes(this.#large) ? this.#large : views[0];
    for (const name of views) this.tiles.get(name).root.classList.toggle("large", name === large);
  }

  #tick() {
    for (const [name, is] of this.#chosen ?? []) if (is) this.tiles.get(name).tick(this.faults.ofView(name));
  }
}
