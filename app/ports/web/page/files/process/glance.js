// SPDX-License-Identifier: Apache-2.0
// Overview of the process: the view with its regions, what the machine says, key figures and alarms.
import { element, setText } from "../elements/elements.js";
import { texts } from "../texts.js";
import { Alarms, worstOf } from "./alarms.js";
import { KeyFigures } from "./key_figures.js";
import { RegionEditor } from "./region_editor.js";

export class Glance {
  // `descriptions` of the signals; `mayChange`: the user may change regions; `onView()`: another view is displayed;
  // `onKey(region, signal)`: a key figure was pressed.
  constructor(faults, recipe, descriptions, mayChange, onView, onKey) {
    this.editor = new RegionEditor(recipe, faults, mayChange, onView);
    this.keys = new KeyFigures(descriptions, onKey);
    this.machine = element("p", { className: "machine" });
    this.alarms = new Alarms(descriptions);
    this.root = element("div", { className: "glance" }, this.editor.root,
      element("div", {}, this.machine, this.keys.root, this.alarms.root));
  }

  get views() {
    return this.editor.views;
  }
  picture(message) {
    this.editor.picture(message);
  }

  status({ alarms = [], machine, regions = [] }, now) {
    setText(this.machine, machine ? texts.process.machine(machine) : "");
    this.alarms.show(alarms);
    this.keys.show(regions, alarms, now);
    this.editor.mark(regions.map(({ name }, index) =>
      [name, worstOf(alarms.filter(({ region }) => region === index))]));
  }
}
