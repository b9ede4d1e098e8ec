// SPDX-License-Identifier: Apache-2.0
// The regions of the recipe over a live view: shown, and by integrators moved, resized, drawn and deleted,
// corner by corner, with pointer, touch or keys.
import { shownWidth } from "../appliance/asked_widths.js";
import { NewestPicture } from "../appliance/newest_picture.js";
import { commandButton, element, field, setText } from "../elements/elements.js";
import { Freshness } from "../elements/freshness.js";
import { followSize } from "../elements/resized.js";
import { drawn, followDrag, kKeys, pixelAt, place, pointsText } from "../elements/shapes.js";
import { texts } from "../texts.js";

const kStepPx = 1, kLargeStepPx = 10;
const kGrowth = 1.05;   // scale factor per key
const kSettleMs = 250;  // repeated keys within this time become one change
const kHandlePx = 11;   // screen px
const kMiddlePx = 8;    // handle in the middle of an edge, which adds a corner
const kShortEdgePx = 44;  // a shorter edge has no middle handle
const kLeastPx = 4;     // a smaller rectangle is a click
const kNewShare = 4;    // the view has this many times the size of a new region

const rectangle = ([x, y], [u, v]) => [[x, y], [u, y], [u, v], [x, v]];
const middleOf = ([x, y], [u, v]) => [(x + u) / 2, (y + v) / 2];
const option = (name) => element("option", { value: name }, name);

export class RegionEditor {
  #pixels = null;  // corners of the region being changed
  #changing = null; // the region being changed
  #settle = 0;
  #handles = [];   // handles of the corners
  #middles = [];   // handles of the edges, each after its corner
  #marks = new Map(); // classes of regions with alarms
  #markKey = "";
  #corner = 0;     // index of the last touched corner
  #recipe = 0;     // number of the recipe that is shown
  #pictures = new NewestPicture((picture, { head, received }) => {
    if (head.name !== this.view.value) return; // another choice meanwhile
    // Sent smaller where it is shown smaller; regions are in the view's pixels.
    this.canvas.getContext("2d").drawImage(picture, 0, 0, this.canvas.width, this.canvas.height);
    this.canvas.dataset.number = head.number;
    this.freshness.drew(head.age_ms, received);
  });

  // `onView()`: another view is displayed.
  constructor(recipe, faults, mayChange, onView) {
    Object.assign(this, { recipe, mayChange, onView });
    this.view = element("select", { name: "view" });
    this.view.addEventListener("change", () => this.#chooseView());
    this.choice = element("select", { name: "region" });
    this.choice.addEventListener("change", () => this.#choose());
    this.removal = commandButton(texts.process.remove, "region", () => this.#remove());
    this.cornerRemoval = commandButton(texts.process.removeCorner(1), "corner",
      () => this.#removeCorner(this.#corner));
    this.said = element("p", { role: "status" });
    this.refused = element("p", { role: "alert", className: "wrong" });
    this.canvas = element("canvas", { role: "img" });
    this.svg = drawn("svg", { role: "group", "aria-label": texts.process.regions });
    this.lines = drawn("g");
    this.body = drawn("polygon", { class: "body", tabindex: 0, role: "button" });
    this.body.addEventListener("pointerdown", (event) => this.#move(event));
    this.body.addEventListener("keydown", (event) => this.#press(event));
    this.middleGroup = drawn("g");
    this.svg.append(this.lines, this.body, this.middleGroup);
    this.svg.addEventListener("pointerdown", (event) => this.#span(event));
    const seen = element("div", { className: "picture" }, this.canvas, this.svg);
    this.freshness = new Freshness(seen);
    setInterval(() => this.freshness.tick(faults.ofView(this.view.value)), 250);
    this.root = element("section", { id: "regions" },
      element("h3", { className: "spoken" }, texts.process.regions),
      element("figure", { className: "ball" }, seen, element("figcaption", {}, this.freshness.age,
        element("label", {}, texts.process.view, " ", this.view))),
      ...(mayChange ? [this.#makeTools(), this.said] : []), this.refused);
    recipe.addEventListener("change", () => this.#refresh());
    new ResizeObserver(() => this.#draw()).observe(this.svg);
    followSize(this.canvas, onView);
  }

  // Folded until regions are to be changed: only then the view has handles.
  #makeTools() {
    this.tools = element("details", {}, element("summary", {}, texts.process.change),
      element("p", { className: "buttons" }, element("label", {}, texts.process.region, " ", this.choice),
        this.cornerRemoval, this.removal),
      element("p", {}, texts.process.help), this.#makeForm());
    this.tools.addEventListener("toggle", () => this.#draw());
    return this.tools;
  }

  #makeForm() {
    this.form = element("form", {}, field(texts.process.newName, { name: "name", pattern: "[A-Za-z0-9_]+" }),
      field(texts.process.threshold, { name: "threshold", type: "number", step: "any" }),
      element("button", {}, texts.process.add));
    this.form.addEventListener("submit", (event) => this.#add(event));
    return this.form;
  }

  get views() {
    return this.view.value ? [{ name: this.view.value, width: shownWidth(this.canvas) }] : [];
  }
  get #region() {
    return this.recipe.regions.find(({ name }) => name === this.choice.value);
  }

  // The region that is being changed.
  get #chosen() {
    return this.tools?.open ? this.#region : null;
  }

  // Colours the outlines; `marks`: [name, class] of each region.
  mark(marks) {
    const key = JSON.stringify(marks);
    if (key === this.#markKey) return;
    this.#markKey = key;
    this.#marks = new Map(marks);
    this.#draw();
  }

  picture(message) {
    if (message.head.name === this.view.value) this.#pictures.show(message);
  }

  #chooseView() {
    this.freshness.forget();
    const view = this.recipe.stated.views.find(({ name }) => name === this.view.value);
    if (view) {
      this.canvas.width = view.width;
      this.canvas.height = view.height;
      this.canvas.setAttribute("aria-label", texts.pictureOf(view.name));
      this.root.style.setProperty("--ratio", view.width / view.height);
      place(this.svg, { viewBox: `-0.5 -0.5 ${view.width} ${view.height}` });
    }
    this.#listRegions();
    this.#draw();
    this.onView();
  }

  #listRegions() {
    const names = this.recipe.regions.filter(({ view }) => view === this.view.value).map(({ name }) => name);
    if ([...this.choice.options].map(({ value }) => value).join("\n") === names.join("\n")) return;
    const chosen = this.choice.value;
    this.choice.replaceChildren(...names.map(option));
    if (names.includes(chosen)) this.choice.value = chosen;
  }

  #refresh() {
    if (this.recipe.stated.number !== this.#recipe) this.#turn();
    const names = this.recipe.stated.views.map(({ name }) => name);
    if ([...this.view.options].map(({ value }) => value).join("\n") !== names.join("\n")) {
      this.view.replaceChildren(...names.map(option));
      this.#chooseView();
    }
    this.#listRegions();
    this.#draw();
    setText(this.said, this.recipe.removed.map(texts.process.removed).join(" "));
  }

  // Another recipe is shown. A drag that goes on is a change of its own recipe.
  #turn() {
    this.#recipe = this.recipe.stated.number;
    clearTimeout(this.#settle);
    this.#pixels = null;
    setText(this.refused, "");
  }

  #isChanging({ name, recipe }) {
    return this.#pixels !== null && name === this.#changing.name && recipe === this.#changing.recipe;
  }

  // Corners outside the view cannot be dragged.
  #cornersOf(region) {
    const pixels = region && this.#isChanging(region) ? this.#pixels : region?.corners.map(({ pixel }) => pixel) ?? [];
    return pixels.every((pixel) => pixel !== null) ? pixels : [];
  }

  #draw() {
    const shown = this.recipe.regions.filter(({ view }) => view === this.view.value);
    const chosen = this.#chosen;
    this.lines.replaceChildren(...shown.flatMap((region) => {
      const lines = this.#isChanging(region) ? [[...this.#pixels, this.#pixels[0]]] : region.lines;
      const at = lines[0]?.[0] ?? [0, 0];
      const text = drawn("text", { x: at[0] + 6 * this.#scale(), y: at[1] + 16 * this.#scale(),
        "font-size": 14 * this.#scale(), class: this.#marks.get(region.name) ?? "" }, region.name);
      const kind = `${region.name === chosen?.name ? "limb" : "edges"} ${this.#marks.get(region.name) ?? ""}`;
      return [...lines.map((line) => drawn("polyline", { points: pointsText(line), class: kind })), text];
    }));
    const pixels = chosen ? this.#cornersOf(chosen) : [];
    place(this.body, { points: pointsText(pixels), visibility: pixels.length > 0 ? "visible" : "hidden",
      "aria-label": texts.process.body(chosen?.name ?? "") });
    this.svg.classList.toggle("drawing", Boolean(chosen && this.#isDrawable(chosen)));
    for (const handles of [this.#handles, this.#middles]) {
      while (handles.length > pixels.length) handles.pop().remove();
    }
    pixels.forEach(([cx, cy], index) => place(this.#handles[index] ?? this.#addHandle(), {
      cx, cy, r: kHandlePx * this.#scale(), "data-corner": index,
      "aria-label": texts.process.corner(index + 1, cx, cy) }));
    pixels.forEach((pixel, index) => this.#placeMiddle(index, pixel, pixels[(index + 1) % pixels.length]));
    this.#corner = Math.max(0, Math.min(this.#corner, pixels.length - 1));
    setText(this.cornerRemoval, texts.process.removeCorner(this.#corner + 1));
    this.cornerRemoval.disabled = pixels.length === 0;
    this.removal.disabled = !chosen;
  }

  #placeMiddle(index, from, to) {
    const [cx, cy] = middleOf(from, to);
    const isShort = Math.hypot(from[0] - to[0], from[1] - to[1]) < kShortEdgePx * this.#scale();
    place(this.#middles[index] ?? this.#addMiddle(), { cx, cy, r: kMiddlePx * this.#scale(),
      "data-edge": index, visibility: isShort ? "hidden" : "visible",
      "aria-label": texts.process.edge(index + 1) });
  }

  #addHandle() {
    const index = this.#handles.length;
    const handle = drawn("circle", { tabindex: 0, role: "button" });
    const moved = (du, dv) => (pixels) =>
      pixels.map(([u, v], k) => (k === index ? [u + du, v + dv] : [u, v]));
    handle.addEventListener("pointerdown", (event) => this.#drag(event, handle, moved));
    handle.addEventListener("focus", () => this.#chooseCorner(index));
    handle.addEventListener("keydown", (event) => {
      if (event.key === "Delete" || event.key === "Backspace") return this.#removeCorner(index, event);
      this.#pressArrow(event, moved);
    });
    this.svg.append(handle);
    this.#handles.push(handle);
    return handle;
  }

  // Pressing it makes it a corner, which can be dragged at once.
  #addMiddle() {
    const index = this.#middles.length;
    const middle = drawn("circle", { class: "middle", tabindex: 0, role: "button" });
    const added = (du, dv) => (pixels) => {
      const [u, v] = middleOf(pixels[index], pixels[(index + 1) % pixels.length]);
      return pixels.toSpliced(index + 1, 0, [u + du, v + dv]);
    };
    middle.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      this.#drag(event, middle, added);
      this.#pixels = added(0, 0)(this.#cornersOf(this.#region));
      this.#draw();
      this.#chooseCorner(index + 1);
    });
    middle.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      this.#change(added(0, 0));
      this.#handles[index + 1].focus();
    });
    this.middleGroup.append(middle);
    this.#middles.push(middle);
    return middle;
  }

  // Changes of the previous region are kept.
  #choose() {
    clearTimeout(this.#settle);
    this.#apply();
    this.#draw();
  }

  #chooseCorner(index) {
    this.#corner = index;
    setText(this.cornerRemoval, texts.process.removeCorner(index + 1));
  }

  // `event`: the key event that requested it, so that the focus stays at the corners.
  #removeCorner(index, event = null) {
    event?.preventDefault();
    this.#change((pixels) => pixels.toSpliced(index, 1));
    if (event) this.#handles.at(Math.min(index, this.#handles.length - 1))?.focus();
  }

  #remove() {
    setText(this.refused, "");
    if (this.#changing?.name === this.choice.value) this.#forget();
    this.recipe.removeRegion(this.choice.value);
  }

  // Size of a screen pixel.
  #scale() {
    return this.canvas.width / (this.svg.clientWidth || this.canvas.width);
  }

  // Lets the user draw a rectangle over the picture.
  #isDrawable({ kind, threshold }) {
    return kind === "whole_view" || threshold !== undefined;
  }

  // Begins a change of the chosen region. Pixels of another one have been given already.
  #begin() {
    if (!this.#isChanging(this.#region)) this.#pixels = null;
    this.#changing = this.#region;
  }

  #drag(event, shape, moved) {
    if (event.button !== 0) return;
    event.stopPropagation();
    shape.focus();
    const from = pixelAt(this.svg, this.canvas, event), before = this.#cornersOf(this.#region);
    this.#begin();
    followDrag(shape, event, (now) => {
      const to = pixelAt(this.svg, this.canvas, now);
      this.#pixels = moved(to[0] - from[0], to[1] - from[1])(before);
      this.#draw();
    }, (ended, isDone) => (isDone ? this.#apply() : this.#forget()));
  }

  #move(event) {
    this.#drag(event, this.body, (du, dv) => (pixels) => pixels.map(([u, v]) => [u + du, v + dv]));
  }

  #span(event) {
    const region = this.#chosen;
    if (event.button !== 0 || !region || !this.#isDrawable(region)) return;
    const from = pixelAt(this.svg, this.canvas, event);
    this.#begin();
    followDrag(this.svg, event, (now) => {
      this.#pixels = rectangle(from, pixelAt(this.svg, this.canvas, now));
      this.#draw();
    }, (ended, isDone) => {
      const to = pixelAt(this.svg, this.canvas, ended);
      const isLarge = to.every((part, k) => Math.abs(part - from[k]) > kLeastPx);
      if (isDone && isLarge) this.#apply();
      else this.#forget();
    });
  }

  #change(change) {
    this.#pixels = change(this.#cornersOf(this.#region));
    this.#changing = this.#region;
    this.#draw();
    clearTimeout(this.#settle);
    this.#settle = setTimeout(() => this.#apply(), kSettleMs);
  }

  #pressArrow(event, moved) {
    const key = kKeys[event.key];
    if (!key) return;
    event.preventDefault();
    const step = event.shiftKey ? kLargeStepPx : kStepPx;
    this.#change(moved(key[0] * step, key[1] * step));
  }

  // Scales about the middle of its corners.
  #press(event) {
    this.#pressArrow(event, (du, dv) => (pixels) => pixels.map(([u, v]) => [u + du, v + dv]));
    const factor = { "+": kGrowth, "-": 1 / kGrowth }[event.key];
    if (!factor) return;
    event.preventDefault();
    this.#change((pixels) => {
      const middle = [0, 1].map((k) => pixels.reduce((sum, pixel) => sum + pixel[k], 0) / pixels.length);
      return pixels.map((pixel) => pixel.map((part, k) => middle[k] + (part - middle[k]) * factor));
    });
  }

  #forget() {
    this.#pixels = null;
    this.#draw();
  }

  async #apply() {
    const pixels = this.#pixels;
    if (!pixels) return;
    await this.#give(this.#changing, pixels);
    if (this.#pixels === pixels) this.#forget(); // unchanged meanwhile
  }

  // Returns whether the appliance has coordinates for them, and they still count.
  async #give(region, pixels) {
    try {
      const isSet = await this.recipe.setRegion(region, pixels);
      if (isSet) setText(this.refused, "");
      return isSet;
    } catch (error) {
      setText(this.refused, texts.refused(error.message));
      return false;
    }
  }

  // Reason why a new region cannot have this name; empty: it can.
  #whyNot(name) {
    const has = (regions) => regions.some((region) => region.name === name);
    if (has(this.recipe.removed)) return texts.process.isRemoved(name);
    return has(this.recipe.regions) ? texts.process.isThere(name) : "";
  }

  // New region in the middle of the view.
  async #add(event) {
    event.preventDefault();
    const { name, threshold } = this.form.elements, { width, height } = this.canvas;
    const away = 0.5 - 0.5 / kNewShare;
    const added = { recipe: this.recipe.stated.number, name: name.value, view: this.view.value, kind: "whole_view",
      corners: [], lines: [], threshold: Number(threshold.value) };
    const why = this.#whyNot(added.name);
    if (why) return setText(this.refused, texts.refused(why));
    const isPlaced = await this.#give(added, rectangle([width * away, height * away],
      [width * (1 - away), height * (1 - away)]));
    if (!isPlaced) return;
    this.choice.value = added.name;
    this.form.reset();
    this.#draw();
    this.body.focus();
  }
}
