// Views, tiled, each with the age of what is seen.
import { element, setText } from "./elements.js";
import { Keyed } from "./figures.js";
import { NewestPicture } from "./newest_picture.js";
import { texts } from "./texts.js";

const kStaleMs = 2000;

class Tile {
  #latest = null; // {age_ms, received} of the picture that is shown
  #pictures = new NewestPicture((picture, message) => this.#draw(picture, message));

  constructor(name) {
    this.name = name;
    this.canvas = element("canvas", { role: "img", "aria-label": texts.pictureOf(name) });
    this.canvas.width = 320;
    this.canvas.height = 180;
    this.overlay = element("p", { className: "overlay" });
    this.age = element("span", { className: "age" }, texts.noPicture);
    const full = element("button", { type: "button" }, texts.fullScreen);
    full.addEventListener("click", () => this.root.requestFullscreen());
    this.root = element("figure", {},
      element("div", { className: "picture" }, this.canvas, this.overlay),
      element("figcaption", {}, element("strong", {}, name), this.age,
        element("a", { className: "button", download: `${name}.jpg`,
          href: `/snapshot.jpg?view=${encodeURIComponent(name)}` }, texts.snapshot), full));
  }

  show(message) {
    return this.#pictures.show(message);
  }

  #draw(picture, { head, received }) {
    if (this.canvas.width !== picture.width) this.canvas.width = picture.width;
    if (this.canvas.height !== picture.height) this.canvas.height = picture.height;
    this.canvas.getContext("2d").drawImage(picture, 0, 0);
    this.canvas.dataset.number = head.number;
    this.#latest = { age_ms: head.age_ms, received };
  }

  tick(faults) {
    if (!this.#latest) return setText(this.overlay, faults);
    const age = this.#latest.age_ms + performance.now() - this.#latest.received;
    setText(this.age, texts.age(age));
    this.age.classList.toggle("wrong", age > kStaleMs);
    const old = age > kStaleMs ? texts.stale(age) : "";
    setText(this.overlay, [old, faults].filter(Boolean).join(". "));
  }
}

export class Live {
  #chosen = null; // by name, null before the first status
  #faults = "";

  constructor(root, onChoice) {
    this.onChoice = onChoice;
    this.choices = element("fieldset", {}, element("legend", {}, texts.chooseViews));
    const tiles = element("div", { id: "tiles" });
    this.tiles = new Keyed(tiles, (name) => new Tile(name));
    root.append(this.choices, tiles);
    setInterval(() => this.#tick(), 250);
  }

  status(status) {
    const faults = status.cameras.filter((c) => c.fault !== 0);
    this.#faults = faults.map((c) => `${c.name}: ${c.fault_text}`).join(". ");
    if (this.#chosen) return;
    this.#chosen = new Map();
    for (const { name } of status.views) {
      this.#chosen.set(name, true);
      const box = element("input", { type: "checkbox", checked: true, name });
      box.addEventListener("change", () => this.#choose(name, box.checked));
      this.choices.append(element("label", {}, box, " ", name));
      this.tiles.get(name);
    }
    this.onChoice();
  }

  get views() {
    return [...(this.#chosen ?? [])].filter(([, is]) => is).map(([name]) => name);
  }

  picture(message) {
    this.tiles.get(message.head.name).show(message);
  }

  #choose(name, isChosen) {
    this.#chosen.set(name, isChosen);
    this.tiles.get(name).root.hidden = !isChosen;
    this.onChoice();
  }
  #tick() {
    for (const [name, is] of this.#chosen ?? []) if (is) this.tiles.get(name).tick(this.#faults);
  }
}
