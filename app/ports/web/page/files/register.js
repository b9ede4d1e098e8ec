// How a camera stands to the first one: found, and compared by what both show.
import { Comparison, Gaze, pictureOf } from "./compare.js";
import { commandButton, element, setText } from "./elements.js";
import { texts } from "./texts.js";

const kDeg = Math.PI / 180;

function direction({ yaw, pitch }) {
  return [Math.sin(yaw * kDeg) * Math.cos(pitch * kDeg), Math.cos(yaw * kDeg) * Math.cos(pitch * kDeg),
          Math.sin(pitch * kDeg)];
}

// Where two cameras that face [a] and [b] both see best: between them; of opposite ones, beside.
function between(a, b) {
  const sum = direction(a).map((part, k) => part + direction(b)[k]);
  const [x, y, z] = Math.hypot(...sum) > 0.5 ? sum : [Math.cos(a.yaw * kDeg), -Math.sin(a.yaw * kDeg), 0];
  return [Math.atan2(x, y) / kDeg, Math.asin(z / Math.hypot(x, y, z)) / kDeg];
}

export class Register {
  #cameras = [];
  #camera = null;
  #shown = "";      // what the pictures are of
  #isLoading = false;

  // `give(command, values)` as Align has it.
  constructor(give) {
    this.give = give;
    this.button = commandButton(texts.register.run, "register_camera", give);
    this.comparison = new Comparison();
    this.gaze = new Gaze(() => this.#load());
    this.refused = element("p", { role: "alert", className: "wrong" });
    this.root = element("section", { id: "register" }, element("h3", {}, texts.register.title),
      element("p", {}, texts.register.help),
      element("p", { className: "buttons" }, this.button), this.refused,
      this.gaze.root, this.comparison.root);
  }

  show(cameras, camera, isWorking) {
    this.#cameras = cameras;
    this.root.hidden = camera.index === 0;
    this.button.disabled = isWorking || !camera.is_watched;
    if (this.root.hidden) return;
    if (this.#camera?.name !== camera.name) this.#lookBetween(cameras[0], camera);
    this.#camera = camera;
    const alignment = JSON.stringify([camera.name, camera.steps, camera.proposed?.outline,
                                      camera.proposed?.rotation, cameras[0].in_force?.number]);
    if (alignment !== this.#shown) this.#load(alignment);
  }

  #lookBetween({ in_force: first }, { in_force: second }) {
    if (first && second) this.gaze.set(...between(first.rotation, second.rotation));
  }

  async #load(alignment = this.#shown) {
    if (this.#isLoading || !this.#camera) return;
    this.#isLoading = true;
    const names = [this.#cameras[0].name, this.#camera.name];
    try {
      const pictures = await Promise.all([["in_force", names[0]], ["proposed", names[1]]]
        .map(([which, camera]) => pictureOf([["camera", camera], ["which", which], ...this.gaze.query])));
      this.comparison.show(pictures, names);
      this.#shown = alignment;
      setText(this.refused, "");
    } catch (error) {
      setText(this.refused, texts.refused(error.message));
    } finally {
      this.#isLoading = false;
    }
  }
}
