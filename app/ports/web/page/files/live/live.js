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
  #chosen = new Map(); // choices by name, in the order of the views
  #large = ""; // name of the large one, where the layout has one

  // `mayCommand`: the user may turn, mix and colour views.
  constructor(root, views, faults, onChoice, mayCommand) {
    Object.assign(this, { root, described: views, faults, onChoice });
    const choices = element("fieldset", {}, element("legend", {}, texts.chooseViews));
    const tiles = element("div", { id: "tiles" });
    this.choices = new Keyed(choices, (name) => ({ root: this.#makeChoice(name) }));
    this.tiles = new Keyed(tiles, (name) => this.#makeTile(name, mayCommand));
    this.layouts = new Layouts(tiles);
    this.seen = new SeenTiles(onChoice);
    const help = element("details", {}, element("summary", {}, texts.help), element("p", {}, texts.liveHelp));
    root.append(element("div", { className: "choices" }, choices, this.layouts.root, help), tiles);
    views.addEventListener("change", () => this.#describe());
    setInterval(() => this.#tick(), 250);
  }

  #makeChoice(name) {
    const box = element("input", { type: "checkbox", checked: true, name });
    box.addEventListener("change", () => this.#choose(name, box.checked));
    return element("label", {}, box, " ", name);
  }

  #makeTile(name, mayCommand) {
    const tile = new Tile(name, mayCommand, () => this.#enlarge(name));
    this.seen.watch(tile.root, name);
    followSize(tile.canvas, this.onChoice);
    return tile;
  }

  // A restarted appliance may have other views.
  status({ views = [] }) {
    const names = views.map(({ name }) => name);
    if (names.join("\n") !== [...this.#chosen.keys()].join("\n")) this.#offer(names);
  }

  // Adds and removes tiles; a new view is chosen at first.
  #offer(names) {
    for (const name of this.#chosen.keys()) {
      if (!names.includes(name)) this.seen.forget(this.tiles.get(name).root);
    }
    this.#chosen = new Map(names.map((name) => [name, this.#chosen.get(name) ?? true]));
    for (const parts of [this.choices, this.tiles]) {
      parts.keep(names);
      parts.root.append(...names.map((name) => parts.get(name).root));
    }
    this.#describe();
    this.#arrange();
    this.onChoice();
  }

  #describe() {
    for (const view of this.described.all) {
      if (this.#chosen.has(view.name)) this.tiles.get(view.name).describe(view, this.described.maps);
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
    return [...this.#chosen].filter(([, is]) => is).map(([name]) => name);
  }

  picture(message) {
    const { name } = message.head;
    if (this.#chosen.has(name)) this.tiles.get(name).show(message);
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
    for (const [name, is] of this.#chosen) if (is) this.tiles.get(name).tick(this.faults.ofView(name));
  }
}
