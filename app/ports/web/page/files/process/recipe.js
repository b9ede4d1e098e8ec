// SPDX-License-Identifier: Apache-2.0
// The selected recipe with its unsent changes. Those of another recipe are kept until it is selected again.
import { patience } from "../appliance/api.js";
import { texts } from "../texts.js";
import { RecipeChanges } from "./recipe_changes.js";

const kNothing = { number: 0, views: [], regions: [], alarms: [], recipes: [] };

async function answered(path) {
  const answer = await fetch(path, patience());
  const json = await answer.json();
  if (!answer.ok) throw new Error(json.error);
  return json;
}

// The same recipe; its regions and alarms name it, because a change of one may end when another recipe runs.
function naming(recipe) {
  const named = (list) => list.map((one) => ({ ...one, recipe: recipe.number }));
  return { ...recipe, regions: named(recipe.regions), alarms: named(recipe.alarms) };
}

export class Recipe extends EventTarget {
  #loaded = "";  // number of the loaded recipe, and checksum of its configuration
  #isLoading = false;
  #changes = new Map();  // unsent ones by number of the recipe
  #asked = new Map();    // pixels of the newest setRegion() by recipe and region; none: dropped
  #tried = null;         // {changes, before, hasRun}: those on trial, the recipe before it as text
  stated = kNothing;

  // Loads it again if another one runs.
  async status({ system }) {
    if (this.#tried && system.trial_left > 0) this.#tried.hasRun = true;
    const running = `${system.recipe} ${system.configuration_checksum}`;
    if (running === this.#loaded || this.#isLoading) return;
    this.#isLoading = true;
    try {
      this.stated = naming(await answered("api/v1/recipe"));
      this.#loaded = running;
      this.#restore();
      this.#changed();
    } catch (error) {
      console.info(`recipe: ${error.message}`); // retried with the next status
    }
    this.#isLoading = false;
  }

  #changed() {
    this.dispatchEvent(new Event("change"));
  }

  #changesOf(number) {
    if (!this.#changes.has(number)) this.#changes.set(number, new RecipeChanges(number));
    return this.#changes.get(number);
  }
  get #own() {
    return this.#changesOf(this.stated.number);
  }

  // Adds an alarm, which is sent once it has a limit.
  addAlarm(region, signal, unit) {
    this.#own.addAlarm(region, signal, unit);
    this.#changed();
  }

  alarmsOf(region, signal) {
    return [...this.stated.alarms, ...this.#own.added].filter((alarm) =>
      alarm.region === region && alarm.signal === signal);
  }

  // Null: there is none.
  limit(alarm, name) {
    return this.#changesOf(alarm.recipe).limit(alarm, name);
  }

  setLimit(stated, limit, value) {
    this.#changesOf(stated.recipe).setLimit(stated, limit, value);
    this.#changed();
  }

  // Regions as drawn: {recipe, name, view, kind, corners: [{at, pixel}], lines, threshold of a new one}.
  get regions() {
    return this.#own.regions(this.stated.regions);
  }

  // Sets corners from these pixels of its view; corners that were not moved keep their coordinates. False: meanwhile
  // newer ones were given, or the region was removed, or its changes were dropped.
  async setRegion(region, pixels) {
    const query = new URLSearchParams({ number: region.recipe, view: region.view, pixels: pixels.flat() });
    const key = `${region.recipe} ${region.name}`;
    this.#asked.set(key, pixels);
    const { corners, lines, error } = await answered(`api/v1/recipe/polygon?${query}`).catch((why) => ({ error: why }));
    const changes = this.#changesOf(region.recipe);
    if (this.#asked.get(key) !== pixels || changes.removed.has(region.name)) return false;
    if (error) throw error;
    const keptAt = (pixel) => region.corners.find(({ pixel: before }) =>
      before?.every((part, k) => part === pixel[k]))?.at;
    const hasSurface = corners.every(({ point }) => point !== null);
    const kind = region.kind === "whole_view" ? (hasSurface ? "points" : "directions") : region.kind;
    if (kind === "points" && !hasSurface) throw new Error(texts.process.noSurface);
    changes.setRegion({ ...region, kind, lines, corners: pixels.map((pixel, index) => ({
      pixel, at: keptAt(pixel) ?? corners[index][kind === "points" ? "point" : "direction"] })) });
    this.#changed();
    return true;
  }

  // Removes a region with its alarms.
  removeRegion(name) {
    this.#asked.delete(`${this.stated.number} ${name}`);
    this.#own.removeRegion(name, this.stated.regions.some((region) => region.name === name));
    this.#changed();
  }

  // {name, alarms: their numbers} of each removed region.
  get removed() {
    return [...this.#own.removed].map((name) => ({ name,
      alarms: this.stated.alarms.filter(({ region }) => region === name).map(({ alarm }) => alarm) }));
  }

  get copy() {
    return this.#own.copy;
  }
  set copy(copy) {
    this.#own.copy = copy;
    this.#changed();
  }

  // The body of check_recipe and try_recipe; null: no changes.
  get body() {
    return this.#own.body;
  }

  // True: changes of any recipe are not sent.
  get isChanged() {
    return [...this.#changes.values()].some(({ body }) => body);
  }

  // {number, name} of the other recipes with unsent changes; without a name if it is no longer configured.
  get others() {
    return [...this.#changes.values()].filter(({ number, body }) => body && number !== this.stated.number)
      .map(({ number }) => this.stated.recipes.find((one) => one.number === number) ?? { number, name: "" });
  }

  // Drops the changes of a recipe.
  forget(number = this.stated.number) {
    for (const key of this.#asked.keys()) if (key.startsWith(`${number} `)) this.#asked.delete(key);
    this.#changes.delete(number);
    this.#changed();
  }

  // The changes were sent as this body to be tried out. They are kept until the trial has ended. If some were made
  // meanwhile, or another recipe runs, all of them stay unsent.
  beginTrial(sent) {
    const changes = this.#own;
    if (JSON.stringify(changes.body) !== JSON.stringify(sent)) return;
    this.#tried = { changes, before: JSON.stringify(this.stated), hasRun: false };
    this.#changes.delete(changes.number);
    this.#changed();
  }

  get isTried() {
    return this.#tried !== null;
  }

  // Drops the changes that were kept. Others come back, at once or when the recipe from before the trial runs.
  endTrial(isKept) {
    if (!this.#tried) return;
    this.#tried.hasRun = true;
    if (isKept) this.#tried = null;
    else if (this.#restore()) this.#changed();
  }

  // Brings the changes back once the recipe reads as before the trial; changes made during the trial are dropped,
  // because their recipe is gone. Until the trial has run, the recipe reads so, too. Returns true if they came back.
  #restore() {
    const tried = this.#tried;
    if (!tried?.hasRun || JSON.stringify(this.stated) !== tried.before) return false;
    this.#changes.set(tried.changes.number, tried.changes);
    this.#tried = null;
    return true;
  }
}
