// SPDX-License-Identifier: Apache-2.0
// Registration of a camera to the first one, and comparison of both pictures.
import { anglesOf, directionOf } from "../elements/directions.js";
import { commandButton, element } from "../elements/elements.js";
import { texts } from "../texts.js";
import { pairOf, ViewFields } from "./camera_view.js";
import { Comparison } from "./compare.js";
import { Reload } from "./reload.js";

// Direction that two cameras facing [a] and [b] both see best: between them; for opposite ones, beside.
function between(a, b) {
  const second = directionOf(b), sum = directionOf(a).map((part, k) => part + second[k]);
  return anglesOf(Math.hypot(...sum) > 0.5 ? sum : directionOf({ yaw: a.yaw + 90, pitch: 0 }));
}

export class Register {
  #cameras = [];
  #camera = null;
  #pictures = new Reload(() => this.#load());

  // `give(command, values)`: see Gestures. `mayAlign`: the user may register a camera.
  constructor(give, mayAlign) {
    this.button = commandButton(texts.register.run, "register_camera", give);
    this.comparison = new Comparison();
    this.view = new ViewFields(() => this.#follow());
    this.isFirst = element("p", {}, texts.register.isFirst);
    this.others = element("div", {}, ...(mayAlign ? [element("p", {}, texts.register.help),
      element("p", { className: "buttons" }, this.button)] : []), this.#pictures.refused,
      this.view.root, this.comparison.root);
    this.root = element("section", { id: "register" }, this.isFirst, this.others);
  }

  // `isLive`: newer pictures are to be compared.
  show(cameras, camera, isWorking, isLive) {
    this.#cameras = cameras;
    this.others.hidden = camera.index === 0;
    this.isFirst.hidden = !this.others.hidden;
    this.button.disabled = isWorking || !camera.is_watched;
    if (this.others.hidden) return;
    if (this.#camera?.name !== camera.name) {
      this.comparison.forget();
      this.#pictures.forget();
      this.#lookBetween(cameras[0], camera);
    }
    this.#camera = camera;
    if (isLive) this.#follow();
  }

  #lookBetween({ in_force: first }, { in_force: second }) {
    if (first && second) this.view.turnTo(between(first.rotation, second.rotation));
  }

  #follow() {
    const { name, steps, proposed } = this.#camera;
    this.#pictures.of([name, steps, proposed?.outline, proposed?.rotation,
                       this.#cameras[0].in_force?.number, this.view.query]);
  }

  async #load() {
    const { name } = this.#camera;
    const pair = await pairOf([["camera", name], ["which", "proposed"], ...this.view.query]);
    if (this.#camera.name !== name) return pair.pictures.forEach((picture) => picture.close());
    this.comparison.show(pair, [this.#cameras[0].name, name]);
  }
}
