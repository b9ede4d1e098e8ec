// SPDX-License-Identifier: Apache-2.0
// The process at one glance with its charts; then changes of the recipe and the events of alarms.
import { element } from "../elements/elements.js";
import { Keyed } from "../elements/figures.js";
import { Trial } from "../system/trial.js";
import { texts } from "../texts.js";
import { AlarmHistory } from "./alarm_history.js";
import { Glance } from "./glance.js";
import { RecipeCopy } from "./recipe_copy.js";
import { RegionSignals } from "./region_signals.js";

export class Process {
  // `mayChange`: the user may change limits and regions. `onChoice()`: another view is needed.
  constructor(root, faults, recipe, figures, mayChange, onChoice) {
    Object.assign(this, { root, recipe });
    const descriptions = figures.regions ?? {};
    this.none = element("p", {}, texts.noRegions);
    const charts = element("div", { id: "charts" });
    this.happened = new AlarmHistory();
    this.regions = new Keyed(charts, (name) =>
      new RegionSignals(name, descriptions, this.recipe, mayChange));
    this.glance = new Glance(faults, this.recipe, descriptions, mayChange, onChoice,
      (region, signal) => this.regions.get(region).choose(signal));
    root.append(this.glance.root, this.none, charts, ...(mayChange ? [this.#makeTrial()] : []), this.happened.root);
  }

  #makeTrial() {
    const trial = new Trial("recipe", () => this.recipe.body, () => this.isShown,
      { onTried: () => this.recipe.forget() });
    const forget = element("button", { type: "button" }, texts.process.forget);
    forget.addEventListener("click", () => this.recipe.forget());
    this.recipe.addEventListener("change", () => { forget.disabled = !this.recipe.body; });
    addEventListener("hashchange", () => trial.refresh());
    trial.refresh();
    return element("section", { id: "recipe" }, element("h3", {}, texts.process.changes), trial.head,
      new RecipeCopy(this.recipe).root, trial.foot, forget);
  }

  get isShown() {
    return !this.root.hidden;
  }
  get views() {
    return this.glance.views;
  }
  picture(message) {
    this.glance.picture(message);
  }

  status(status, now) {
    const { regions = [] } = status;
    this.glance.status(status, now);
    if (this.isShown) this.happened.refresh(status.web.alarm_events);
    this.regions.keep(regions.map(({ name }) => name));
    for (const region of regions) this.regions.get(region.name).show(region, now);
    this.none.hidden = this.regions.size > 0;
  }
}
