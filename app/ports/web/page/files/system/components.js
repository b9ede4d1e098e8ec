// SPDX-License-Identifier: Apache-2.0
// Figures of components of the status: a table for each, side by side.
import { element } from "../elements/elements.js";
import { FigureTable, Keyed } from "../elements/figures.js";

export class Components {
  // `figures`: their descriptions by kind.
  constructor(figures) {
    this.root = element("div", { className: "components" });
    this.tables = new Keyed(this.root, (key) => {
      const [kind, name] = JSON.parse(key), title = name ? `${kind}: ${name}` : kind;
      const table = new FigureTable(figures[kind] ?? {});
      table.root.setAttribute("aria-label", title);
      return { root: element("section", {}, element("h4", {}, title), table.root),
               show: (component) => table.show(component) };
    });
  }

  // `component`: one, or a list of named ones.
  show(kind, component) {
    for (const one of [component].flat()) this.tables.get(JSON.stringify([kind, one.name ?? ""])).show(one);
  }
}
