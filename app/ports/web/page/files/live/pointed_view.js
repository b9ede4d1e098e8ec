// A view that the appliance points, turned by whoever looks at it, for all who do.
import { NewestCommand } from "../appliance/newest_command.js";
import { followFingers, followKeys, followWheel, Gaze } from "../look/gaze.js";
import { texts } from "../texts.js";

// Until the picture shows what was commanded last, it does not say where the view looks.
const kSettleMs = 1000;

export class PointedView {
  #view = null;
  #turned = -Infinity; // as of performance.now()

  // `say(what)`: why it was not turned; empty when it was.
  constructor(canvas, mayCommand, say) {
    this.canvas = canvas;
    this.mayCommand = mayCommand;
    this.say = say;
    this.gaze = new Gaze(() => this.#point());
    this.command = new NewestCommand("point_view", (why) => say(why ? texts.refused(why) : ""));
    followFingers(canvas, this.gaze);
    followWheel(canvas, this.gaze, () => this.#mayTurn && (canvas === document.activeElement
      || document.fullscreenElement?.contains(canvas)));
    followKeys(canvas, this.gaze, true);
  }

  // As /api/v1/views has it.
  describe(view) {
    const { yaw, pitch, h_fov: fov } = view.configured;
    this.#view = view;
    this.gaze.home = { yaw, pitch, fov };
    if (!view.is_zoomed) this.gaze.narrowest = this.gaze.widest = fov;
    this.canvas.classList.toggle("pointed", this.#mayTurn);
  }

  // Where the picture that is shown looks.
  follow({ yaw, pitch, roll, h_fov: fov }) {
    if (performance.now() - this.#turned < kSettleMs) return;
    Object.assign(this.gaze, { yaw, pitch, roll, fov });
  }

  get #mayTurn() {
    return this.mayCommand && Boolean(this.#view?.is_pointed);
  }

  #point() {
    if (!this.#view) return;
    if (!this.#mayTurn) return this.say(texts.staysPut(this.#view.is_measured, this.mayCommand));
    this.#turned = performance.now();
    const { yaw, pitch, fov } = this.gaze, { index: view, is_zoomed: isZoomed } = this.#view;
    this.command.send({ view, yaw, pitch, h_fov: isZoomed ? fov : 0 });
  }
}
