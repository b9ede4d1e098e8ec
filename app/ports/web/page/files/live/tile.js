// SPDX-License-Identifier: Apache-2.0
// One view: its picture with its age, values at the pointer, direction, weights and colours of its cameras.
import { NewestPicture } from "../appliance/newest_picture.js";
import { element, setText } from "../elements/elements.js";
import { Freshness } from "../elements/freshness.js";
import { icon, iconButton } from "../elements/icons.js";
import { texts } from "../texts.js";
import { Legend } from "./legend.js";
import { Mixer } from "./mixer.js";
import { PointedView } from "./pointed_view.js";
import { Pointer } from "./pointer.js";
import { nextPicture, saveSnapshot } from "./snapshot.js";

export class Tile {
  #hasPicture = false;
  #described = ""; // what the controls were made of
  #pictures = new NewestPicture((picture, message) => this.#draw(picture, message));

  // `onEnlarge()`: it shall be the large one.
  constructor(name, mayCommand, onEnlarge) {
    this.name = name;
    this.mayCommand = mayCommand;
    this.canvas = element("canvas", { tabIndex: 0, role: "application",
      "aria-label": texts.pictureOf(name) });
    this.pointer = new Pointer(name, this.canvas);
    this.controls = element("div", { className: "controls" });
    const said = element("p", { className: "wrong", role: "alert" });
    this.say = (what) => setText(said, what);
    this.pointed = new PointedView(this.canvas, mayCommand, this.say);
    this.frame = element("div", { className: "frame" }, this.canvas, this.pointer.mark);
    this.#fit({ width: 320, height: 180 });
    const seen = element("div", { className: "picture" }, this.frame,
      element("div", { className: "over" }, this.pointer.reading, this.controls));
    this.freshness = new Freshness(seen);
    this.root = element("figure", {}, seen, this.pointer.spoken, said, element("figcaption", {},
      element("strong", {}, name), this.freshness.age, ...this.#makeButtons(onEnlarge)));
  }

  #makeButtons(onEnlarge) {
    const button = (name, act) => {
      const made = iconButton(name, texts.tile[name](this.name));
      made.classList.add(name);
      made.addEventListener("click", act);
      return made;
    };
    this.lock = button("locked", () => this.#turn(this.lock.ariaPressed !== "true"));
    this.back = button("back", () => this.pointed.back());
    this.#turn(false);
    this.lock.hidden = this.back.hidden = true;
    return [button("enlarge", onEnlarge), this.lock, this.back,
      button("cameras", () => this.#save()),
      button("full", () => this.root.requestFullscreen())];
  }

  #turn(isTurned) {
    this.lock.ariaPressed = String(isTurned);
    this.lock.replaceChildren(icon(isTurned ? "unlocked" : "locked"));
    this.pointed.lock(!isTurned);
  }

  // The canvas has the view's pixels, in which all coordinates are, also if the picture that is drawn was sent smaller.
  #fit({ width, height }) {
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
    this.frame.style.setProperty("--aspect", width / height);
  }

  // The view's entry and the colour maps of /api/v1/views. The controls may be in use: without a change they stay.
  describe(view, maps) {
    const { aim, ...fixed } = view, described = JSON.stringify([fixed, maps]);
    if (described === this.#described) return;
    this.#described = described;
    if (!this.#hasPicture) this.#fit(view);
    this.pointed.describe(view);
    this.lock.hidden = this.back.hidden = !this.pointed.mayTurn;
    this.legend = new Legend(view, maps, this.mayCommand, this.say);
    if (aim) this.legend.follow(aim.colours);
    this.controls.replaceChildren(this.legend.root);
    this.mixer = this.mayCommand && view.is_mixed ? new Mixer(view, this.say) : null;
    if (this.mixer) this.controls.append(this.mixer.root);
  }

  show(message) {
    return this.#pictures.show(message);
  }

  #draw(picture, { head, received }) {
    this.#fit(head);
    this.canvas.getContext("2d").drawImage(picture, 0, 0, head.width, head.height);
    Object.assign(this.canvas.dataset, { number: head.number, stamp: head.stamp, sent: picture.width });
    this.#hasPicture = true;
    this.freshness.drew(head.age_ms, received);
    this.pointer.follow();
    this.pointed.follow(head.aim);
    this.mixer?.follow(head.aim.weights);
    this.legend?.follow(head.aim.colours);
  }

  // The displayed picture, or the next one in full where the displayed one is smaller, unless there is none.
  async #save() {
    if (!this.#hasPicture) return;
    const displayed = { picture: this.canvas, stamp: this.canvas.dataset.stamp };
    const isFull = Number(this.canvas.dataset.sent) === this.canvas.width;
    const next = isFull ? null : await nextPicture(this.name);
    await saveSnapshot(this.name, next ?? displayed, this.legend?.shown ?? []);
  }

  // `faults`: of its cameras.
  tick(faults) {
    this.freshness.tick(faults);
  }
}
