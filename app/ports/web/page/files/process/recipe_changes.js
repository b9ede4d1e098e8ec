// SPDX-License-Identifier: Apache-2.0
// Unsent changes of one recipe.
const kNoLimits = { low_alarm: null, low_warning: null, high_warning: null, high_alarm: null, hysteresis: null };

const keyOf = ({ alarm, region, signal }, limit) => [alarm, region, signal, limit].join(" ");

export class RecipeChanges {
  #limits = new Map();  // by alarm and limit
  #regions = new Map(); // regions by name
  added = [];           // alarms, with the number 0
  removed = new Set();  // names of removed regions
  copy = null;          // {number, name} of the new recipe that gets the changes; null: the recipe itself

  // `number` of the recipe.
  constructor(number) {
    this.number = number;
  }

  // An alarm without limits is not sent.
  addAlarm(region, signal, unit) {
    this.added.push({ recipe: this.number, alarm: 0, region, signal, unit, ...kNoLimits });
  }

  // Null: there is none.
  limit(alarm, name) {
    return (this.#limits.get(keyOf(alarm, name)) ?? { value: alarm[name] }).value;
  }

  setLimit(stated, limit, value) {
    const { alarm, region, signal } = stated, key = keyOf(stated, limit);
    if (value === stated[limit]) this.#limits.delete(key);
    else this.#limits.set(key, { alarm, region, signal, limit, value });
  }

  // The recipe's regions as changed, then the new ones.
  regions(stated) {
    const kept = stated.filter(({ name }) => !this.removed.has(name));
    const added = [...this.#regions.values()].filter(({ threshold }) => threshold !== undefined);
    return [...kept.map((region) => this.#regions.get(region.name) ?? region), ...added];
  }

  setRegion(region) {
    this.#regions.set(region.name, region);
  }

  // Removes a region with its alarms. `isStated`: the recipe has it.
  removeRegion(name, isStated) {
    if (isStated) this.removed.add(name);
    this.#regions.delete(name);
    for (const [key, { region }] of this.#limits) if (region === name) this.#limits.delete(key);
    this.added = this.added.filter(({ region }) => region !== name);
  }

  // The body of check_recipe and try_recipe; null: no changes.
  get body() {
    if (this.#limits.size + this.#regions.size + this.removed.size === 0 && !this.copy) return null;
    const regions = [...this.#regions.values()].map(({ name, view, kind, corners, threshold }) => ({
      name, [kind]: corners.map(({ at }) => at),
      ...(threshold === undefined ? {} : { view, hot_spot_threshold: threshold }) }));
    regions.push(...[...this.removed].map((name) => ({ name, removed: true })));
    return { recipe: this.number, limits: [...this.#limits.values()], regions,
      ...(this.copy && { copy: this.copy }) };
  }
}
