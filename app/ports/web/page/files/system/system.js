// SPDX-License-Identifier: Apache-2.0
// Complete status of the appliance, its cameras and views.
import { element } from "../elements/elements.js";
import { FigureTable, Keyed } from "../elements/figures.js";
import { Stages } from "./stages.js";

// Shown elsewhere, or not a component.
const kElsewhere = new Set(["stamp", "age", "regions", "alarms", "stages"]);

export class System {
  constructor(root, figures) {
    this.parts = new Keyed(root, (key) => {
      const [kind, name] = JSON.parse(key);
      const table = new FigureTable(figures[kind] ?? {});
      const title = name ? `${kind}: ${name}` : kind;
      table.root.setAttribute("aria-label", title);
      const opened = element("details", { open: kind === "system" },
        element("summary", {}, title), table.root);
      return { root: opened, show: (part) => opened.open && table.show(part) };
    });
    this.stages = new Stages(root);
  }

  status(status) {
    this.stages.show(status.stages, status.system.load);
    for (const [kind, part] of Object.entries(status)) {
      if (kElsewhere.has(kind)) continue;
      for (const one of [part].flat()) {
        this.parts.get(JSON.stringify([kind, one.name ?? ""])).show(one);
      }
    }
  }
}
