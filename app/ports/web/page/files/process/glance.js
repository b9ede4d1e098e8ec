// SPDX-License-Identifier: Apache-2.0
// Overview of the process: the view with its regions, what the machine says, key figures and alarms.
import { element, setText } from "../elements/elements.js";
import { texts } from "../texts.js";
import { Alarms, worstOf } from "./alarms.js";
import { KeyFigures } from "./key_figures.js";
import { RegionEditor } from "./region_editor.js";

export class Glance {
  // `descriptions` of the signals; `mayChange` regions and `mayAcknowledge` alarms: the user may; `onView()`: another
  // view is displayed; `onKey(region, signal)`: a key figure was pressed.
  constructor(faults, recipe, descriptions, { mayChange, mayAcknowledge }, onView, onKey) {
    this.editor = new RegionEditor(recipe, faults, mayChange, onView);
    this.keys = new KeyFigures(descriptions, onKey);
    this.machine = element("p", { className: "machine" });
    this.alarms = new Alarms(descriptions, mayAcknowledge);
    this.root = element("div", { className: "glance" }, this.editor.root,
      element("div", {}, this.machine, this.keys.root, this.alarms.root));
  }

  get views() {
    return this.editor.views;
  }
  picture(message) {
    this.editor.picture(message);
  }

  // `silence`: reason why nothing is measured; empty: it is.
  status({ alarms = [], machine, regions = [], silence }, now) {
    setText(this.machine, machine ? texts.process.machine(machine) : "");
    this.alarms.show(alarms);
    this.keys.show(regions, alarms, now, silence);
    this.editor.mark(silence ? [] : regions.map(({ name }, index) =>
      [name, worstOf(alarms.filter(({ region }) => region === index))]));
  }

  // Shows that nothing is measured without a connection.
  lost(why) {
    this.keys.lost(why);
    this.editor.mark([]);
  }
}
