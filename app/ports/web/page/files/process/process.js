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
import { UnsentElsewhere } from "./unsent_elsewhere.js";

export class Process {
  #names = [];  // of the regions with a chart
  #files = "";  // names and checksums of the configuration's files before a trial

  // `may(role)`: true if the user may do what the role may; integrators change limits and regions. `onChoice()`:
  // another view is needed.
  constructor(root, faults, recipe, figures, may, onChoice) {
    Object.assign(this, { root, recipe });
    const descriptions = figures.regions ?? {}, mayChange = may("integrator");
    this.none = element("p", {}, texts.noRegions);
    const charts = element("div", { id: "charts" });
    this.happened = new AlarmHistory();
    this.regions = new Keyed(charts, (name) =>
      new RegionSignals(name, descriptions, this.recipe, mayChange));
    // Here and not in each chart: one that is removed is not notified any more.
    recipe.addEventListener("change", () => this.#names.forEach((name) => this.regions.get(name).update()));
    this.glance = new Glance(faults, this.recipe, descriptions, { mayChange, mayAcknowledge: may("operator") },
      onChoice, (region, signal) => this.regions.get(region).choose(signal));
    root.append(this.glance.root, this.none, charts, ...(mayChange ? [this.#makeTrial()] : []), this.happened.root);
  }

  #makeTrial() {
    const trial = new Trial("recipe", () => this.recipe.body, () => this.isShown,
      { onState: (state) => this.#followTrial(state), onTried: (sent) => this.recipe.beginTrial(sent) });
    const forget = element("button", { type: "button" }, texts.process.forget);
    forget.addEventListener("click", () => this.recipe.forget());
    this.recipe.addEventListener("change", () => { forget.disabled = !this.recipe.body; });
    addEventListener("hashchange", () => trial.refresh());
    trial.refresh();
    return element("section", { id: "recipe" }, element("h3", {}, texts.process.changes), trial.head,
      new UnsentElsewhere(this.recipe).root, new RecipeCopy(this.recipe).root, trial.foot, forget);
  }

  // The files differ from those before the trial only when it was kept.
  #followTrial({ trial, files }) {
    const read = JSON.stringify(files.map(({ name, checksum }) => [name, checksum]));
    if (trial || !this.recipe.isTried) this.#files = read;
    else this.recipe.endTrial(read !== this.#files);
  }

  get isShown() {
    return !this.root.hidden;
  }
  get isChanged() {
    return this.recipe.isChanged;
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
    this.#names = regions.map(({ name }) => name);
    this.regions.keep(this.#names);
    for (const region of regions) this.regions.get(region.name).show(region, now);
    this.none.hidden = this.regions.size > 0;
  }

  // Shows that nothing is measured without a connection.
  lost(why) {
    this.glance.lost(why);
    this.happened.lost();
    for (const name of this.#names) this.regions.get(name).show({ name }, performance.now());
  }
}
