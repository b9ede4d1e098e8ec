// SPDX-License-Identifier: Apache-2.0
// One view: its picture with its age, values at the pointer, direction, weights and colours of its cameras.
import { NewestPicture } from "../appliance/newest_picture.js";
import { element, setText } from "../elements/elements.js";
import { Freshness } from "../elements/freshness.js";
import { texts } from "../texts.js";
import { Legend } from "./legend.js";
import { Mixer } from "./mixer.js";
import { PointedView } from "./pointed_view.js";
import { Pointer } from "./pointer.js";
import { saveSnapshot } from "./snapshot.js";

export class Tile {
  #hasPicture = false;
  #pictures = new NewestPicture((picture, message) => this.#draw(picture, message));

  constructor(name, mayCommand) {
    this.name = name;
    this.mayCommand = mayCommand;
    this.canvas = element("canvas", { tabIndex: 0, role: "application",
      "aria-label": texts.pictureOf(name) });
    this.canvas.width = 320;
    this.canvas.height = 180;
    this.pointer = new Pointer(name, this.canvas);
    this.controls = element("div", { className: "controls" });
    const said = element("p", { className: "wrong", role: "alert" });
    this.say = (what) => setText(said, what);
    this.pointed = new PointedView(this.canvas, mayCommand, this.say);
    const full = element("button", { type: "button" }, texts.fullScreen);
    full.addEventListener("click", () => this.root.requestFullscreen());
    const snapshot = element("button", { type: "button" }, texts.snapshot);
    snapshot.addEventListener("click", () => {
      if (this.#hasPicture) saveSnapshot(name, this.canvas, this.legend?.shown ?? []);
    });
    const seen = element("div", { className: "picture" }, this.canvas, this.pointer.mark);
    this.freshness = new Freshness(seen);
    this.root = element("figure", {}, seen,
      this.pointer.reading, this.pointer.spoken, this.controls, said,
      element("figcaption", {}, element("strong", {}, name), this.freshness.age, snapshot, full));
  }

  // The view's entry and the colour maps of /api/v1/views.
  describe(view, maps) {
    this.pointed.describe(view);
    this.legend = new Legend(view, maps, this.mayCommand, this.say);
    if (view.aim) this.legend.follow(view.aim.colours);
    this.controls.replaceChildren(this.legend.root);
    this.mixer = this.mayCommand && view.is_mixed ? new Mixer(view, this.say) : null;
    if (this.mixer) this.controls.append(this.mixer.root);
  }

  show(message) {
    return this.#pictures.show(message);
  }

  #draw(picture, { head, received }) {
    if (this.canvas.width !== picture.width) this.canvas.width = picture.width;
    if (this.canvas.height !== picture.height) this.canvas.height = picture.height;
    this.canvas.getContext("2d").drawImage(picture, 0, 0);
    this.canvas.dataset.number = head.number;
    this.canvas.dataset.stamp = head.stamp;
    this.#hasPicture = true;
    this.freshness.drew(head.age_ms, received);
    this.pointer.follow();
    this.pointed.follow(head.aim);
    this.mixer?.follow(head.aim.weights);
    this.legend?.follow(head.aim.colours);
  }

  // `faults`: of its cameras.
  tick(faults) {
    this.freshness.tick(faults);
  }
}
