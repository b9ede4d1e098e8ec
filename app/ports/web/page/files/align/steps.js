// SPDX-License-Identifier: Apache-2.0
// The steps of an alignment, each with its state by what the appliance reports: open, done or stale.
import { element, setText } from "../elements/elements.js";
import { texts } from "../texts.js";

// Numbers of app/model/status/watch_status.h, which stay the same.
const kGood = 1, kBeyond = [2, 3], kNotRegistered = 4;
const kAligned = 1, kNotAligned = 2;

// State by step. `camera` and `first`: alignments of the camera and of the first one; the camera's figures.
// Nothing that the rig file states counts as done, unless it was checked by a picture.
export function statesOf(camera, first, { alignment, outline_check: check, cleanliness }) {
  const { number = 0, method = "" } = camera.in_force ?? {};
  const isWrong = check === kNotAligned || kBeyond.includes(alignment);
  const accepted = number === 0 ? "open" : isWrong ? "stale" : "done";
  // The registration is relative to the alignment that the first camera had.
  const isOlder = accepted === "done" && first.in_force?.number > number;
  return {
    ball: number === 0 && check === kAligned ? "done" : accepted,
    register: camera.index === 0 ? "" : alignment === kNotRegistered ? "open" : isOlder ? "stale" : accepted,
    place: method.startsWith("place") ? accepted : "open",
    check: isWrong ? accepted : alignment === kGood && check === kAligned ? "done" : "open",
    clean: kBeyond.includes(cleanliness) ? "stale" : cleanliness === kGood ? "done" : "open",
  };
}

// Part of the page that can be closed; browsers leave one step open at a time.
export class Step {
  constructor(number, name, ...content) {
    this.state = element("span", { className: "state" });
    const heading = element("h3", {}, `${number} ${texts.steps[name]}`);
    this.root = element("details", { id: `step-${name}`, className: "step", name: "step" },
      element("summary", {}, heading, this.state), ...content);
  }

  get isOpen() {
    return this.root.open;
  }

  // Empty: the step does not apply.
  show(state) {
    setText(this.state, texts.steps.states[state] ?? "");
    this.state.classList.toggle("wrong", state === "stale");
  }
}
