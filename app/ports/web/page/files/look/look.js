// SPDX-License-Identifier: Apache-2.0
// The room as seen from the ball, turned by the user: drawn here, or by the appliance if the browser has no
// WebGL.
import { patience, read } from "../appliance/api.js";
import { shownWidth } from "../appliance/asked_widths.js";
import { Framing } from "../appliance/framing.js";
import { NewestPicture } from "../appliance/newest_picture.js";
import { element, setText } from "../elements/elements.js";
import { Freshness } from "../elements/freshness.js";
import { texts } from "../texts.js";
import { followGestures, Gaze } from "./gaze.js";
import { neededWidth } from "./needed_width.js";
import { offerNames } from "./offer.js";
import { ServerLook } from "./server_look.js";
import { SpherePainter } from "./sphere_painter.js";

const kMarks = ["blind", "resolution", "wireFrame"];

// One camera's mesh, requested again with its tag: {head, body}; null: unchanged.
class Meshes {
  #tags = new Map();

  async load(name) {
    const tag = this.#tags.get(name);
    const answer = await fetch(`api/v1/sphere?view=${encodeURIComponent(name)}`,
      { ...patience(), headers: tag ? { "If-None-Match": tag } : {} });
    if (answer.status === 304) return null;
    if (!answer.ok) throw new Error(`status ${answer.status}`);
    const [mesh] = new Framing().push(new Uint8Array(await answer.arrayBuffer()));
    this.#tags.set(name, answer.headers.get("ETag"));
    return mesh;
  }
  forget() {
    this.#tags.clear();
  }
}

export class Look {
  #isStale = true; // data may be older than a restart of the appliance, or than a choice
  #isCurrent = false; // the meshes are those of the running appliance, whose pictures fit them
  #isLoading = false;
  #willDraw = false;
  #meshes = new Meshes();
  #pictures = new Map(); // pictures by view

  // `onChoice()`: other views are needed.
  constructor(root, faults, onChoice) {
    Object.assign(this, { root, faults, onChoice });
    this.gaze = new Gaze(() => this.#redraw());
    this.canvas = element("canvas", { tabIndex: 0, role: "application",
      "aria-label": texts.lookCanvas });
    this.seen = element("div", { className: "picture" }, this.canvas);
    this.freshness = new Freshness(this.seen);
    this.where = element("span", { className: "where" });
    this.painter = SpherePainter.make(this.canvas);
    this.#addControls();
    followGestures(this.canvas, this.gaze);
    this.canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    this.canvas.addEventListener("webglcontextrestored", () => {
      this.painter.begin();
      this.#meshes.forget();
      this.lost();
    });
    new ResizeObserver(() => this.#redraw()).observe(this.canvas);
    setInterval(() => this.#tick(), 250);
  }

  get isShown() {
    return !this.root.hidden;
  }

  // Views needed while it is shown, in the widths that the gaze needs. A ball is not asked for before its mesh has
  // arrived, which has the ball's size.
  get views() {
    if (this.server) return this.#names.map((name) => ({ name, width: shownWidth(this.canvas) }));
    return this.#names.filter((name) => this.painter?.hasMesh(name)).map((name) => {
      const head = this.painter.headOf(name);
      return { name, width: neededWidth(head, this.gaze, shownWidth(this.canvas)), sizes: head.widths };
    });
  }
  get #names() {
    if (this.server) return this.server.views;
    return [this.first.value, this.second.value].filter(Boolean);
  }

  status() {
    if (this.isShown && this.#isStale && !this.#isLoading) this.#load();
  }

  lost() {
    this.#isStale = true;
    this.#isCurrent = false;
  }

  picture(message) {
    const { name } = message.head;
    if (this.server) return this.server.picture(message);
    if (!this.#isCurrent) return null;
    if (!this.#pictures.has(name)) {
      this.#pictures.set(name, new NewestPicture((bitmap, { head, received }) => this.#show(bitmap, head, received)));
    }
    return this.#pictures.get(name).show(message);
  }

  #show(bitmap, { name, number, age_ms }, received) {
    if (!this.#names.includes(name) || !this.painter.hasMesh(name)) return; // another choice meanwhile
    this.painter.show(name, bitmap);
    this.freshness.drew(age_ms, received, name);
    if (name === this.first.value) this.canvas.dataset.number = number;
    this.#redraw();
  }

  // Forgets pictures of cameras that are not chosen any more: without an age they must not be shown again.
  #forgetOthers() {
    this.freshness.keep(this.#names);
    this.painter?.keepPictures(this.#names);
  }

  #addControls() {
    const changed = () => {
      this.#isStale = true;
      this.#forgetOthers();
      this.onChoice();
    };
    this.first = element("select", { name: "first" });
    this.second = element("select", { name: "second" });
    this.mix = element("input", { type: "range", name: "mix", min: 0, max: 100, value: 50 });
    for (const select of [this.first, this.second]) select.addEventListener("change", changed);
    this.mix.addEventListener("input", () => this.#redraw());
    this.marks = Object.fromEntries(kMarks.map((name) => {
      const box = element("input", { type: "checkbox", name, checked: name === "blind" });
      box.addEventListener("change", () => this.#redraw());
      return [name, box];
    }));
    const marks = kMarks.map((name) => element("label", {}, this.marks[name], " ", texts[name]));
    this.legend = element("p", { className: "legend", hidden: true }, texts.resolutionLow,
      element("span", { className: "ramp" }), texts.resolutionHigh);
    this.none = element("p", { hidden: true }, texts.noSphere);
    this.controls = element("fieldset", {}, element("legend", {}, texts.lookShows),
      element("label", {}, texts.lookFirst, " ", this.first),
      element("label", {}, texts.lookSecond, " ", this.second),
      element("label", {}, texts.lookMix, " ", this.mix), ...marks, this.legend);
    const back = element("button", { type: "button" }, texts.lookBack);
    back.addEventListener("click", () => this.gaze.reset());
    const full = element("button", { type: "button" }, texts.fullScreen);
    full.addEventListener("click", () => this.figure.requestFullscreen());
    this.figure = element("figure", {}, this.seen,
      element("figcaption", {}, this.where, this.freshness.age, back, full));
    this.root.append(this.none, this.controls, this.figure, element("p", {}, texts.lookHelp));
  }

  async #load() {
    this.#isLoading = true;
    this.#isStale = false;
    try {
      const { spheres, pointed } = await read("api/v1/look-around");
      if (!this.painter) this.#beginServer(pointed);
      else await this.#loadSpheres(spheres);
      this.#isCurrent = !this.#isStale;
    } catch (error) {
      console.info(`look around: ${error.message}`);
      this.#isStale = true; // retried with the next status
    }
    this.#isLoading = false;
  }

  #beginServer(pointed) {
    this.controls.hidden = true;
    this.none.hidden = false;
    setText(this.none, pointed.length > 0 ? texts.noWebGl : texts.noWebGlNoView);
    this.server ??= this.#makeServer();
    this.server.offer(pointed);
    this.#forgetOthers();
    this.onChoice();
  }

  #makeServer() {
    const chosen = () => {
      this.#forgetOthers();
      this.onChoice();
    };
    const server = new ServerLook(this.canvas, this.gaze, chosen,
      ({ age_ms, received, name }) => this.freshness.drew(age_ms, received, name));
    this.figure.before(server.root);
    return server;
  }

  // Meshes of a former list are dropped with it.
  #offer(spheres) {
    const isFirst = this.second.options.length === 0;
    if (!offerNames(this.first, spheres)) return;
    offerNames(this.second, ["", ...spheres]);
    if (isFirst) this.second.value = spheres[1] ?? "";
    this.painter.clear();
    this.#meshes.forget();
    this.freshness.forget();
  }

  async #loadSpheres(spheres) {
    this.#offer(spheres);
    this.none.hidden = spheres.length > 0;
    for (const name of this.#names) {
      const mesh = await this.#meshes.load(name);
      if (!mesh) continue;
      this.painter.setMesh(name, mesh);
      if (name === this.first.value) this.gaze.begin(mesh.head.facing);
    }
    this.onChoice();
    this.#redraw();
  }

  #redraw() {
    if (this.#willDraw || this.server) return;
    this.#willDraw = true;
    requestAnimationFrame(() => {
      this.#willDraw = false;
      this.#draw();
    });
  }

  #draw() {
    const { clientWidth, clientHeight } = this.canvas;
    if (!this.painter || clientWidth === 0) return;
    const scale = window.devicePixelRatio || 1;
    const width = Math.round(clientWidth * scale), height = Math.round(clientHeight * scale);
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
    const { yaw, pitch, fov } = this.gaze;
    Object.assign(this.canvas.dataset, { yaw, pitch, fov });
    this.legend.hidden = !this.marks.resolution.checked;
    this.mix.disabled = !this.second.value;
    this.painter.draw(this.gaze.view, {
      first: this.first.value,
      second: this.second.value === this.first.value ? "" : this.second.value,
      mix: this.mix.value / 100,
      blind: this.marks.blind.checked,
      resolution: this.marks.resolution.checked,
      wireFrame: this.marks.wireFrame.checked,
    });
  }

  #tick() {
    if (!this.isShown) return;
    this.onChoice(); // the gaze or the canvas may need another size
    setText(this.where, texts.lookWhere(this.gaze.yaw, this.gaze.pitch, this.gaze.fov));
    this.freshness.tick(this.faults.ofView(...this.#names));
  }
}
