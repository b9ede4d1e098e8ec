// SPDX-License-Identifier: Apache-2.0
// A camera's picture with the ball's outline over it as an ellipse, moved by its handles with pointer, touch
// or keys, and the scene's edges by the alignment.
import { element } from "../elements/elements.js";
import { Freshness } from "../elements/freshness.js";
import { drawn, followDrag, followPull, kKeys, pixelAt, place } from "../elements/shapes.js";
import { texts } from "../texts.js";
import { caption, kStaleMs } from "./camera_view.js";
import { edgeLine } from "./edge_line.js";
import { Loupe } from "./loupe.js";

const kStepPx = 0.1, kLargeStepPx = 1;
// Keys that are held down become one change.
const kSettleMs = 250;
const kHandlePx = 11, kMarkPx = 6;  // screen px

// Unit vectors along the axes.
function axes({ angle }) {
  const a = angle * Math.PI / 180;
  return { rx: [Math.cos(a), Math.sin(a)], ry: [-Math.sin(a), Math.cos(a)] };
}

// Positions by handle; a radius has it at the end of the axis inside the picture.
function handlesOf(outline, { width, height }) {
  const { u, v } = outline;
  const isShown = ([x, y]) => x >= 0 && y >= 0 && x < width && y < height;
  const end = (name) => {
    const [x, y] = axes(outline)[name], r = outline[name];
    const ends = [[u + r * x, v + r * y], [u - r * x, v - r * y]];
    return ends.find(isShown) ?? ends[0];
  };
  return { centre: [u, v], rx: end("rx"), ry: end("ry") };
}

// Outline after its handle was moved to [u, v]. The first radius also turns the ellipse.
function pulled(outline, handle, [u, v]) {
  if (handle === "centre") return { ...outline, u, v };
  const du = u - outline.u, dv = v - outline.v;
  if (handle === "rx") {
    return { ...outline, rx: Math.max(1, Math.hypot(du, dv)), angle: Math.atan2(dv, du) * 180 / Math.PI };
  }
  const [x, y] = axes(outline).ry;
  return { ...outline, ry: Math.max(1, Math.abs(du * x + dv * y)) };
}

export class BallEditor {
  #outline = null;   // displayed outline
  #changed = new Set();  // commands to send
  #edits = 0;        // number of changes, also of those that are being made
  #isHeld = false;   // being changed: states of the appliance wait
  #settle = 0;
  #handles = {};
  #marked = null;    // pixel of a point that is being marked
  #isMarking = false;

  // `gestures`: see Gestures. `onPick([u, v])`: a click beside the handles. `onPull(gesture, from, to)`: an edge was
  // dragged from one pixel to another; a promise. `mayAlign`: the user may change outline and edges.
  constructor(gestures, onPick, onPull, mayAlign) {
    Object.assign(this, { gestures, onPull, mayAlign });
    this.canvas = element("canvas", { role: "img", "aria-label": texts.align.picture });
    this.svg = drawn("svg", { role: "group", "aria-label": texts.align.outlineGroup });
    this.edges = drawn("g", { class: "edges" });
    this.marks = drawn("g", { class: "marks" });
    this.before = drawn("ellipse", { class: "before" });
    this.ellipse = drawn("ellipse", { class: "limb" });
    this.svg.append(this.before, this.ellipse, this.marks, this.edges);
    for (const name of mayAlign ? ["centre", "rx", "ry"] : []) this.#addHandle(name);
    this.loupe = new Loupe(this.canvas);
    this.onPick = (pixel) => this.#isMarking && onPick(pixel);
    this.svg.addEventListener("click", (event) => {
      const isOther = event.target.hasAttribute("data-handle") || event.target.tagName === "polyline";
      if (!isOther) this.onPick(this.pixelAt(event));
    });
    this.svg.addEventListener("pointermove", (event) => {
      if (this.#isMarking) this.loupe.show(this.pixelAt(event));
    });
    this.svg.addEventListener("pointerleave", () => this.loupe.hide());
    if (mayAlign) this.edges.addEventListener("pointerdown", (event) => this.#pull(event));
    const seen = element("div", { className: "picture" }, this.canvas, this.svg, this.loupe.root);
    this.freshness = new Freshness(seen, kStaleMs);
    this.root = element("figure", { className: "ball" }, seen,
      caption(this.freshness.age));
    new ResizeObserver(() => this.#draw()).observe(this.svg);
  }

  #addHandle(name) {
    const handle = drawn("circle", { tabindex: 0, role: "button", "data-handle": name });
    handle.addEventListener("pointerdown", (event) => this.#drag(event, handle, name));
    handle.addEventListener("keydown", (event) => this.#press(event, name));
    this.#handles[name] = handle;
    this.svg.append(handle);
  }

  pixelAt(event) {
    return pixelAt(this.svg, this.canvas, event);
  }

  #drag(event, handle, name) {
    const gesture = this.gestures.begin();
    if (!gesture || !this.#outline || event.button !== 0) return;
    handle.focus();
    const before = this.#outline;
    const from = this.pixelAt(event), at = handlesOf(before, this.canvas)[name];
    this.#hold();
    let isMoved = false;
    followDrag(handle, event, (moved) => {
      if (gesture.isOver()) return;
      isMoved = true;
      const to = this.pixelAt(moved);
      this.#outline = pulled(before, name, [at[0] + to[0] - from[0], at[1] + to[1] - from[1]]);
      this.#draw();
    }, (ended, isDone) => {
      if (gesture.isOver()) return;
      if (!isDone) this.#outline = before;
      else if (isMoved) this.#change(name);
      this.#apply(gesture);
    });
  }

  // A click on an edge without dragging picks a point.
  #pull(event) {
    const gesture = this.gestures.begin();
    if (!gesture || event.button !== 0) return;
    this.#isHeld = true;
    followPull(this.svg, this.edges, event, this.canvas, async (from, to, isDone) => {
      if (isDone && !gesture.isOver()) await (to ? this.onPull(gesture, from, to) : this.onPick(from));
      if (gesture.isOver()) return;
      this.#isHeld = false;
      this.#refresh();
    });
  }

  // For a radius, right and up enlarge, left and down reduce it.
  #press(event, name) {
    const [du, dv] = kKeys[event.key] ?? [], gesture = this.gestures.begin();
    if (du === undefined || !gesture || !this.#outline) return;
    event.preventDefault();
    const step = event.shiftKey ? kLargeStepPx : kStepPx;
    this.#change(name);
    if (name === "centre") {
      this.#outline = { ...this.#outline, u: this.#outline.u + step * du, v: this.#outline.v + step * dv };
    } else {
      const radius = Math.max(1, this.#outline[name] + step * (du - dv));
      this.#outline = { ...this.#outline, [name]: radius };
    }
    this.#draw();
    this.#settle = setTimeout(() => this.#apply(gesture), kSettleMs);
  }

  #change(handle) {
    this.#changed.add(handle === "centre" ? "move_outline" : "shape_outline");
    this.#hold();
  }

  // Earlier changes do not end it: those being sent count as older, those that wait are sent with this one.
  #hold() {
    clearTimeout(this.#settle);
    this.#isHeld = true;
    ++this.#edits;
  }

  // Changes made meanwhile are applied later.
  async #apply(gesture) {
    const edits = this.#edits, { u, v, rx, ry, angle } = this.#outline;
    const values = { move_outline: { u, v }, shape_outline: { rx, ry, angle } };
    const changed = [...this.#changed];
    this.#changed.clear();
    for (const name of changed) await gesture.give(name, values[name]);
    if (edits !== this.#edits) return;
    this.#isHeld = false;
    this.#refresh();
  }

  // Another camera takes its place.
  forget() {
    clearTimeout(this.#settle);
    this.#changed.clear();
    ++this.#edits;
    this.#isHeld = false;
  }

  show(camera) {
    this.camera = camera;
    if (this.canvas.width !== camera.width || this.canvas.height !== camera.height) {
      this.canvas.width = camera.width;
      this.canvas.height = camera.height;
      this.root.style.setProperty("--aspect", camera.width / camera.height);
    }
    place(this.svg, { viewBox: `-0.5 -0.5 ${camera.width} ${camera.height}` });
    this.#refresh();
  }

  // It was taken after it had been asked for, at `asked`, which is of performance.now().
  showPicture(picture, asked) {
    this.freshness.drew(0, asked);
    this.canvas.getContext("2d").drawImage(picture, 0, 0);
    this.canvas.dataset.number = Number(this.canvas.dataset.number ?? 0) + 1;
    this.loupe.refresh();
  }

  // Clicks mark points, and there is a loupe.
  set isMarking(is) {
    this.#isMarking = is;
    this.svg.classList.toggle("marking", is);
    if (!is) this.loupe.hide();
  }

  // Draws the point that is being marked; null: none.
  mark(pixel) {
    this.#marked = pixel;
    if (this.camera) this.#markPoints(this.camera);
  }

  // Crosses at marked points, with a line to their projection by the placement.
  #markPoints({ points, picked }) {
    const size = kMarkPx * this.#scale();
    const cross = ([u, v]) => drawn("path", {
      d: `M${u - size},${v}H${u + size}M${u},${v - size}V${v + size}` });
    const off = points.filter(({ residual }) => residual).map(({ pixel, residual }) =>
      drawn("path", { d: `M${pixel}L${pixel[0] - residual[0]},${pixel[1] - residual[1]}` }));
    const pixels = [...points.map(({ pixel }) => pixel), this.#marked ?? picked].filter(Boolean);
    this.marks.replaceChildren(...off, ...pixels.map(cross));
  }

  // Size of a screen pixel.
  #scale() {
    return this.canvas.width / (this.svg.clientWidth || this.canvas.width);
  }

  #refresh() {
    if (this.#isHeld || !this.camera) return;
    this.#markPoints(this.camera);
    const shown = this.camera.proposed ?? this.camera.in_force;
    this.#outline = shown?.outline ?? null;
    this.edges.replaceChildren(...(shown?.edges ?? []).flatMap(({ pixels }) => edgeLine(pixels, this.mayAlign)));
    this.#draw();
  }

  #draw() {
    const shapes = [this.ellipse, this.before, ...Object.values(this.#handles)];
    for (const shape of shapes) place(shape, { visibility: this.#outline ? "visible" : "hidden" });
    if (!this.#outline) return;
    const ellipse = ({ u, v, rx, ry, angle }) =>
      ({ cx: u, cy: v, rx, ry, transform: `rotate(${angle} ${u} ${v})` });
    place(this.ellipse, ellipse(this.#outline));
    const inForce = this.camera.in_force?.outline;
    if (inForce) place(this.before, ellipse(inForce));
    const places = handlesOf(this.#outline, this.canvas);
    for (const [name, handle] of Object.entries(this.#handles)) {
      const [cx, cy] = places[name];
      place(handle, { cx, cy, r: kHandlePx * this.#scale(),
        "aria-label": texts.align.handle[name](this.#outline) });
    }
  }
}
