// SPDX-License-Identifier: Apache-2.0
// Progress of what is computed for a camera, and the button that cancels it.
import { commandButton, element, setText } from "../elements/elements.js";
import { texts } from "../texts.js";

export class Working {
  // `give(command)`: see Gestures. `mayAlign`: the user may cancel it.
  constructor(give, mayAlign) {
    this.step = element("span");
    this.bar = element("progress", { max: 1 });
    this.root = element("p", { id: "working", className: "buttons", hidden: true },
      element("label", {}, this.step, " ", this.bar),
      mayAlign ? commandButton(texts.align.cancel, "cancel_alignment", give) : "");
  }

  show({ step_text: step, share }, isWorking) {
    this.root.hidden = !isWorking;
    setText(this.step, step);
    this.bar.value = share;
  }
}
