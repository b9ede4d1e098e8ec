// SPDX-License-Identifier: Apache-2.0
// Screen of the machine's panel: the process at one glance, without menus, to be read from some metres.
import { iconButton } from "../elements/icons.js";
import { texts } from "../texts.js";
import { Glance } from "./glance.js";

export class Operator {
  isShown = true;

  // `mayAcknowledge`: the user may acknowledge alarms. `onView()`: another view is needed.
  constructor(root, faults, recipe, figures, mayAcknowledge, onView) {
    this.glance = new Glance(faults, recipe, figures.regions ?? {}, { mayChange: false, mayAcknowledge }, onView,
      () => {});
    const full = iconButton("full", texts.fullScreen);
    full.addEventListener("click", () => document.documentElement.requestFullscreen());
    root.append(this.glance.root, full);
  }

  get views() {
    return this.glance.views;
  }
  picture(message) {
    this.glance.picture(message);
  }
  status(status, now) {
    this.glance.status(status, now);
  }
  lost(why) {
    this.glance.lost(why);
  }
}
