// SPDX-License-Identifier: Apache-2.0
// A view that the appliance points, turned by a user for all users once it is unlocked.
import { NewestCommand } from "../appliance/newest_command.js";
import { followFingers, followKeys, followWheel, Gaze } from "../look/gaze.js";
import { texts } from "../texts.js";

// Time for which the picture's direction is ignored until it shows the last command.
const kSettleMs = 1000;

export class PointedView {
  #view = null;
  #isLocked = true;
  #turned = -Infinity; // time of performance.now()

  // `say(what)`: reason of a refusal; empty: accepted.
  constructor(canvas, mayCommand, say) {
    this.canvas = canvas;
    this.mayCommand = mayCommand;
    this.say = say;
    this.gaze = new Gaze(() => this.#point());
    this.command = new NewestCommand("point_view", (why) => say(why ? texts.refused(why) : ""));
    // Fingers swipe over a locked view; a mouse is told that it is locked.
    followFingers(canvas, this.gaze, ({ pointerType }) => pointerType === "mouse" || this.isTurned);
    followWheel(canvas, this.gaze, () => this.isTurned && (canvas === document.activeElement
      || document.fullscreenElement?.contains(canvas)));
    followKeys(canvas, this.gaze, true);
  }

  // The view's entry in /api/v1/views.
  describe(view) {
    const { yaw, pitch, h_fov: fov } = view.configured;
    this.#view = view;
    this.gaze.home = { yaw, pitch, fov };
    if (!view.is_zoomed) this.gaze.narrowest = this.gaze.widest = fov;
    this.lock(this.#isLocked);
  }

  lock(isLocked) {
    this.#isLocked = isLocked;
    this.canvas.classList.toggle("pointed", this.isTurned);
    this.say("");
  }

  // Turns to the configured direction, also while it is locked.
  back() {
    Object.assign(this.gaze, this.gaze.home);
    this.#send();
  }

  // True: gestures turn it.
  get isTurned() {
    return this.mayTurn && !this.#isLocked;
  }

  // Direction of the displayed picture.
  follow({ yaw, pitch, roll, h_fov: fov }) {
    if (performance.now() - this.#turned < kSettleMs) return;
    Object.assign(this.gaze, { yaw, pitch, roll, fov });
  }

  // True: the user may turn it.
  get mayTurn() {
    return this.mayCommand && Boolean(this.#view?.is_pointed);
  }

  #point() {
    if (!this.#view) return;
    if (!this.mayTurn) return this.say(texts.staysPut(this.#view.is_measured, this.mayCommand));
    if (this.#isLocked) return this.say(texts.locked);
    this.#send();
  }

  #send() {
    this.#turned = performance.now();
    const { yaw, pitch, fov } = this.gaze, { index: view, is_zoomed: isZoomed } = this.#view;
    this.command.send({ view, yaw, pitch, h_fov: isZoomed ? fov : 0 });
  }
}
