// SPDX-License-Identifier: Apache-2.0
// The ball in each camera's picture: found, corrected by hand, accepted.
import { command, patience } from "../appliance/api.js";
import { directionOf, turnBetween } from "../elements/directions.js";
import { commandButton, element, setText } from "../elements/elements.js";
import { offerNames } from "../look/offer.js";
import { parsed, texts } from "../texts.js";
import { BallEditor } from "./ball_editor.js";
import { Gestures } from "./gestures.js";
import { Place } from "./place.js";
import { Register } from "./register.js";
import { SceneView } from "./scene_view.js";
import { statesOf, Step } from "./steps.js";
import { Watched } from "./watched.js";
import { Working } from "./working.js";

const kPauseMs = 300;  // period of requests to the appliance
const kNudgeDeg = 0.05;

async function fetched(path) {
  const answer = await fetch(path, patience());
  if (!answer.ok) throw new Error((await answer.json().catch(() => ({}))).error ?? answer.status);
  return answer;
}

// Manual rotation about the machine's axes.
function nudges(give) {
  return ["yaw", "pitch", "roll"].flatMap((axis) => [-kNudgeDeg, kNudgeDeg].map((step) => {
    const button = element("button", { type: "button" }, texts.align.nudge(axis, step));
    button.addEventListener("click", () =>
      give("turn_camera", { yaw: 0, pitch: 0, roll: 0, [axis]: step }));
    return button;
  }));
}

const buttonsOf = (...buttons) => element("p", { className: "buttons" }, ...buttons);

export class Align {
  #cameras = [];
  #newest = [];  // cameras of the newest status
  #isRunning = false;
  #isCancelled = false;  // the last command cancelled a computation

  // `descriptions` of a camera's figures. `isAtLeast(role)`: the user may do what this role may.
  constructor(root, faults, descriptions, isAtLeast) {
    Object.assign(this, { root, faults, mayAlign: isAtLeast("integrator"), mayLearn: isAtLeast("operator") });
    this.states = descriptions.proposal.codes;
    this.choice = element("select", { name: "camera" });
    this.choice.addEventListener("change", () => this.#choose());
    this.said = element("p", { role: "status" });
    this.refused = element("p", { role: "alert", className: "wrong" });
    this.gestures = new Gestures(() => this.#camera, (...given) => this.#give(...given));
    const give = (name, values) => this.gestures.give(name, values);
    this.place = new Place(this.gestures, (pixel) => this.editor.mark(pixel), this.mayAlign);
    this.editor = new BallEditor(this.gestures, (pixel) => this.place.pick(pixel),
      (...pulled) => this.#pull(...pulled), this.mayAlign);
    this.buttons = Object.fromEntries([
      ["detect", "detect_ball"], ["undo", "undo_alignment"], ["accept", "accept_alignment"],
      ["discard", "discard_alignment"], ["revert", "revert_alignment"],
    ].map(([name, given]) => [name, commandButton(texts.align[name], given, give)]));
    this.blocked = element("p", { id: "not-acceptable", className: "wrong" });
    this.buttons.accept.setAttribute("aria-describedby", this.blocked.id);
    this.facts = element("p", { className: "where" });
    this.working = new Working(give, this.mayAlign);
    this.register = new Register(give, this.mayAlign);
    this.scene = new SceneView(this.gestures, this.mayAlign);
    this.watched = new Watched(descriptions);
    this.steps = this.#makeSteps(give);
    root.append(element("div", { className: "columns" }, this.#makeSeen(),
      element("div", {}, ...Object.values(this.steps).map((step) => step.root))));
    addEventListener("hashchange", () => this.#run());
    document.addEventListener("visibilitychange", () => this.#run());
    this.#run();
    setInterval(() => this.#age(), 250);
  }

  // Parts that all steps change: the camera's picture, and the commands that judge a proposal.
  #makeSeen() {
    const { accept, undo, discard, revert } = this.buttons;
    return element("div", { className: "seen" },
      element("p", {}, element("label", {}, texts.align.camera, " ", this.choice)), this.editor.root,
      this.working.root, ...(this.mayAlign ? [buttonsOf(accept, undo, discard, revert), this.blocked] : []),
      this.said, this.refused, this.facts);
  }

  // Steps without the commands that the user's role may not give.
  #makeSteps(give) {
    const ifAligning = (...elements) => (this.mayAlign ? elements : []);
    const learn = commandButton(texts.cleanBall.run, "learn_clean_ball", give);
    const correct = commandButton(texts.watched.correct, "correct_alignment", give);
    const contents = {
      ball: this.mayAlign ? [buttonsOf(this.buttons.detect), element("p", {}, texts.align.help)]
        : [element("p", {}, texts.align.readOnly)],
      register: [this.register.root,
        ...ifAligning(element("p", {}, texts.register.turn), buttonsOf(...nudges(give)))],
      place: [this.place.root],
      check: [this.scene.root, this.watched.root, ...ifAligning(buttonsOf(correct))],
      clean: [element("p", {}, texts.cleanBall.help),
        this.mayLearn ? buttonsOf(learn) : element("p", {}, texts.cleanBall.readOnly)],
    };
    const steps = Object.fromEntries(Object.entries(contents).map(([name, content], index) =>
      [name, new Step(index + 1, name, ...content)]));
    steps.ball.root.open = true;
    steps.place.root.addEventListener("toggle", () => {
      this.editor.isMarking = this.mayAlign && steps.place.isOpen;
    });
    return steps;
  }

  status({ cameras }, now) {
    this.#newest = cameras;
    this.watched.status(cameras, this.choice.value, now);
  }

  get isShown() {
    return !this.root.hidden && !document.hidden;
  }
  get #camera() {
    return this.#cameras.find(({ name }) => name === this.choice.value);
  }

  // True: done. Another camera may be shown by the time of the answer.
  async #give({ name, index }, given, values) {
    const why = await command(given, { camera: index, ...values });
    if (name === this.choice.value) this.#isCancelled = given === "cancel_alignment" && !why;
    await this.#look().catch((error) => this.#waitAfter(error));
    const refusal = this.#cameras.find((camera) => camera.name === name)?.refusal;
    this.#refuse(name, why && (refusal || why));
    return !why;
  }

  // Empty: the command to the camera is done.
  #refuse(camera, why) {
    const isShown = camera === this.choice.value;
    if (why) setText(this.refused, texts.refused(isShown ? why : `${camera}: ${why}`));
    else if (isShown) setText(this.refused, "");
  }

  // A shape drawn at one pixel is at the other pixel in the picture.
  async #pull(gesture, drawn, shown) {
    const { camera } = gesture;
    const directionAt = async ([u, v]) => directionOf(await (await fetched(
      `api/v1/alignment/direction?${new URLSearchParams({ camera, u, v })}`)).json());
    try {
      const [to, from] = await Promise.all([drawn, shown].map(directionAt));
      await gesture.give("turn_camera", turnBetween(from, to));
    } catch (error) {
      this.#refuse(camera, error.message);
    }
  }

  // Loads one picture after the other while the page is shown; retries after a failure.
  async #run() {
    if (this.#isRunning) return;
    this.#isRunning = true;
    while (this.isShown) {
      try {
        await this.#look();
        await this.#showPicture();
      } catch (error) {
        this.#waitAfter(error);
      }
      await new Promise((resolve) => setTimeout(resolve, kPauseMs));
    }
    this.#isRunning = false;
  }

  // Veils old pictures and those of cameras with a fault. No outline is accepted over such a picture of its ball.
  #age() {
    const fault = this.faults.ofCamera(this.choice.value), ball = this.editor.freshness;
    const first = this.faults.ofCamera(this.#cameras[0]?.name);
    const why = ball.tick(fault) || (ball.hasPicture ? "" : texts.noPicture);
    this.scene.freshness.tick(fault);
    this.register.comparison.freshness.tick([first, fault].filter(Boolean).join(". "));
    const isReady = this.#camera?.state === this.states.ready;
    this.buttons.accept.disabled = !isReady || why !== "";
    setText(this.blocked, isReady && why ? texts.align.notAcceptable(why) : "");
  }

  #waitAfter(error) {
    setText(this.said, texts.align.waiting(error.message));
  }

  // A restarted appliance may have other cameras.
  async #look() {
    this.#cameras = parsed(await (await fetched("api/v1/alignment")).text()).cameras;
    const { value: before } = this.choice;
    offerNames(this.choice, this.#cameras.map(({ name }) => name));
    if (before && before !== this.choice.value) this.#choose();
    else if (this.#camera) this.#show(this.#camera);
  }

  async #showPicture() {
    if (!this.#camera?.is_watched) return;
    const { name } = this.#camera;
    const path = `api/v1/alignment/ball.jpg?camera=${encodeURIComponent(name)}`;
    const asked = performance.now();
    const picture = await createImageBitmap(await (await fetched(path)).blob());
    if (this.#camera?.name === name) this.editor.showPicture(picture, asked);
    picture.close();
  }

  #choose() {
    this.gestures.end();
    setText(this.refused, "");
    this.#isCancelled = false;
    this.editor.forget();
    this.place.forgetPixel();
    this.editor.freshness.forget();
    if (this.#camera) this.#show(this.#camera);
  }

  #show(camera) {
    const { proposed, in_force: inForce, state } = camera;
    const isWorking = state === this.states.working;
    this.editor.show(camera);
    this.working.show(camera, isWorking);
    setText(this.said, this.#words(camera));
    setText(this.facts, this.#figures(proposed ?? inForce));
    this.place.show(camera, isWorking);
    // Views are made by the same thread that records the pictures for a computation.
    this.scene.show(camera, this.steps.check.isOpen && !isWorking);
    this.register.show(this.#cameras, camera, isWorking, this.steps.register.isOpen && !isWorking);
    this.#showSteps(camera);
    this.buttons.detect.disabled = isWorking || !camera.is_watched;
    this.buttons.undo.disabled = isWorking || (camera.steps === 0 && !camera.refusal);
    this.buttons.discard.disabled =
      isWorking || (state === this.states.none && camera.steps === 0);
    this.buttons.revert.disabled = isWorking || !inForce?.method;
    this.#age();
  }

  #showSteps(camera) {
    const figures = this.#newest.find(({ name }) => name === camera.name);
    const states = figures ? statesOf(camera, this.#cameras[0], figures) : {};
    for (const [name, step] of Object.entries(this.steps)) step.show(states[name]);
  }

  #words({ is_watched: isWatched, state, state_text: text, refusal, proposed, in_force: inForce }) {
    if (!isWatched) return texts.align.notWatched;
    if (refusal) return texts.align.refusal(refusal);
    if (this.#isCancelled) return texts.align.cancelled;
    if (state === this.states.ready) return texts.align.proposal(proposed.method, proposed.quality);
    if (state === this.states.working) return text;
    return inForce?.method ? texts.align.inForce(inForce.method, inForce.quality)
      : texts.align.ofRig;
  }

  #figures(shown) {
    if (!shown) return "";
    const { outline, rotation } = shown;
    return `${texts.align.outline(outline)} ${texts.align.rotation(rotation)}`;
  }
}
