// SPDX-License-Identifier: Apache-2.0
// The selected recipe, and its unsent changes.
import { texts } from "../texts.js";

const kNoLimits = { low_alarm: null, low_warning: null, high_warning: null, high_alarm: null, hysteresis: null };
const kNothing = { number: 0, views: [], regions: [], alarms: [], recipes: [] };

async function answered(path) {
  const answer = await fetch(path);
  const json = await answer.json();
  if (!answer.ok) throw new Error(json.error);
  return json;
}

export class Recipe extends EventTarget {
  #loaded = "";  // number of the loaded recipe
  #isLoading = false;
  #limits = new Map();  // unsent limits by alarm and limit
  #added = [];          // unsent alarms, with the number 0
  #regions = new Map(); // regions by name
  #removed = new Set(); // names of removed regions
  #copy = null;         // {number, name} of the new recipe that gets the changes; null: the recipe itself
  stated = kNothing;

  // Loads it again if another one runs.
  async status({ system }) {
    const running = `${system.recipe} ${system.configuration_checksum}`;
    if (running === this.#loaded || this.#isLoading) return;
    this.#isLoading = true;
    try {
      this.stated = await answered("api/v1/recipe");
      this.#loaded = running;
      this.#changed();
    } catch (error) {
      console.info(`recipe: ${error.message}`); // retried with the next status
    }
    this.#isLoading = false;
  }

  #changed() {
    this.dispatchEvent(new Event("change"));
  }

  // Adds an alarm, which is sent once it has a limit.
  addAlarm(region, signal, unit) {
    this.#added.push({ alarm: 0, region, signal, unit, ...kNoLimits });
    this.#changed();
  }

  alarmsOf(region, signal) {
    return [...this.stated.alarms, ...this.#added].filter((alarm) => alarm.region === region && alarm.signal === signal);
  }

  // Null: there is none.
  limit(alarm, name) {
    return (this.#limits.get(this.#keyOf(alarm, name)) ?? { value: alarm[name] }).value;
  }

  #keyOf({ alarm, region, signal }, limit) {
    return [alarm, region, signal, limit].join(" ");
  }

  setLimit(stated, limit, value) {
    const { alarm, region, signal } = stated, key = this.#keyOf(stated, limit);
    if (value === stated[limit]) this.#limits.delete(key);
    else this.#limits.set(key, { alarm, region, signal, limit, value });
    this.#changed();
  }

  // Regions as drawn: {name, view, kind, corners: [{at, pixel}], lines, threshold of a new one}.
  get regions() {
    const stated = this.stated.regions.filter(({ name }) => !this.#removed.has(name))
      .map((region) => this.#regions.get(region.name) ?? region);
    return [...stated, ...[...this.#regions.values()].filter(({ threshold }) => threshold !== undefined)];
  }

  // Sets corners from these pixels of its view; corners that were not moved keep their coordinates.
  async setRegion(region, pixels) {
    const query = new URLSearchParams({ number: this.stated.number, view: region.view, pixels: pixels.flat() });
    const { corners, lines } = await answered(`api/v1/recipe/polygon?${query}`);
    if (this.#removed.has(region.name)) return; // removed meanwhile
    const keptAt = (pixel) => region.corners.find(({ pixel: before }) =>
      before?.every((part, k) => part === pixel[k]))?.at;
    const hasSurface = corners.every(({ point }) => point !== null);
    const kind = region.kind === "whole_view" ? (hasSurface ? "points" : "directions") : region.kind;
    if (kind === "points" && !hasSurface) throw new Error(texts.process.noSurface);
    this.#regions.set(region.name, { ...region, kind, lines, corners: pixels.map((pixel, index) => ({
      pixel, at: keptAt(pixel) ?? corners[index][kind === "points" ? "point" : "direction"] })) });
    this.#changed();
  }

  // Removes a region with its alarms.
  removeRegion(name) {
    if (this.stated.regions.some((region) => region.name === name)) this.#removed.add(name);
    this.#regions.delete(name);
    for (const [key, { region }] of this.#limits) if (region === name) this.#limits.delete(key);
    this.#added = this.#added.filter(({ region }) => region !== name);
    this.#changed();
  }

  // {name, alarms: their numbers} of each removed region.
  get removed() {
    return [...this.#removed].map((name) => ({ name,
      alarms: this.stated.alarms.filter(({ region }) => region === name).map(({ alarm }) => alarm) }));
  }

  get copy() {
    return this.#copy;
  }
  set copy(copy) {
    this.#copy = copy;
    this.#changed();
  }

  // The body of check_recipe and try_recipe; null: no changes.
  get body() {
    if (this.#limits.size + this.#regions.size + this.#removed.size === 0 && !this.#copy) return null;
    const regions = [...this.#regions.values()].map(({ name, view, kind, corners, threshold }) => ({
      name, [kind]: corners.map(({ at }) => at),
      ...(threshold === undefined ? {} : { view, hot_spot_threshold: threshold }) }));
    regions.push(...[...this.#removed].map((name) => ({ name, removed: true })));
    return { recipe: this.stated.number, limits: [...this.#limits.values()], regions,
      ...(this.#copy && { copy: this.#copy }) };
  }

  forget() {
    this.#limits.clear();
    this.#added = [];
    this.#regions.clear();
    this.#removed.clear();
    this.#copy = null;
    this.#changed();
  }
}
