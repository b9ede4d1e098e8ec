// SPDX-License-Identifier: Apache-2.0
// The scene's edges over a view of the room, in which straight lines of the machine are straight. Dragged
// onto the machine's edges, they turn the camera.
import { turnBetween } from "../elements/directions.js";
import { element } from "../elements/elements.js";
import { Freshness } from "../elements/freshness.js";
import { drawn, followPull } from "../elements/shapes.js";
import { texts } from "../texts.js";
import { caption, kSide, kStaleMs, pictureOf, viewCanvas, ViewFields } from "./camera_view.js";
import { edgeLine } from "./edge_line.js";
import { Perspective } from "./perspective.js";
import { Reload } from "./reload.js";

export class SceneView {
  #camera = null;
  #picture = new Reload(() => this.#load());
  #perspective = null;  // projection of the displayed picture
  #isHeld = false;      // an edge is being dragged: the view is not updated

  // `gestures`: see Gestures. `mayAlign`: the user may drag edges.
  constructor(gestures, mayAlign) {
    Object.assign(this, { gestures, mayAlign });
    this.view = new ViewFields(() => this.#follow());
    this.canvas = viewCanvas(texts.sceneView.canvas);
    this.edges = drawn("g", { class: "edges" });
    if (mayAlign) this.edges.addEventListener("pointerdown", (event) => this.#pull(event));
    this.svg = drawn("svg", { role: "group", "aria-label": texts.sceneView.edges,
      viewBox: `-0.5 -0.5 ${kSide} ${kSide}` }, this.edges);
    const seen = element("div", { className: "picture" }, this.canvas, this.svg);
    this.freshness = new Freshness(seen, kStaleMs);
    this.root = element("section", { id: "scene" }, element("h4", {}, texts.sceneView.title),
      mayAlign ? element("p", {}, texts.sceneView.help) : "", this.view.root, this.#picture.refused,
      element("figure", { className: "ball view" }, seen, caption(this.freshness.age)));
  }

  // `isLive`: newer pictures are to be shown.
  show(camera, isLive) {
    const { name, is_watched: isWatched } = camera, shown = camera.proposed ?? camera.in_force;
    this.root.hidden = !isWatched || !shown?.edges.length;
    if (this.root.hidden) return;
    if (this.#camera?.name !== name) {
      this.view.turnTo(shown.rotation);
      this.edges.replaceChildren();
      this.canvas.width = kSide; // clears it
      this.freshness.forget();
      this.#picture.forget();
    }
    this.#camera = camera;
    if (isLive) this.#follow();
  }

  #follow() {
    if (this.#isHeld) return;
    const { name, steps, proposed, in_force: inForce } = this.#camera;
    const { outline, rotation } = proposed ?? inForce;
    this.#picture.of([name, steps, outline, rotation, inForce?.number, this.view.query]);
  }

  async #load() {
    const { name, proposed, in_force: inForce } = this.#camera, { query } = this.view;
    const asked = performance.now();
    const picture = await pictureOf([["camera", name], ["which", "proposed"], ...query]);
    if (this.#isHeld || this.#camera.name !== name) return picture.close();
    this.freshness.drew(0, asked);
    this.#perspective = new Perspective(Object.fromEntries(query), kSide);
    this.canvas.getContext("2d").drawImage(picture, 0, 0);
    picture.close();
    this.#drawEdges((proposed ?? inForce).edges);
    this.canvas.dataset.number = Number(this.canvas.dataset.number ?? 0) + 1;
  }

  #drawEdges(edges) {
    const lines = edges.map(({ from, to }) => this.#perspective.lineOf(from, to)).filter(Boolean);
    this.edges.replaceChildren(...lines.flatMap((line) => edgeLine(line, this.mayAlign)));
  }

  #pull(event) {
    const gesture = this.gestures.begin();
    if (!gesture || event.button !== 0) return;
    this.#isHeld = true;
    followPull(this.svg, this.edges, event, this.canvas, async (from, to) => {
      if (to && !gesture.isOver()) {
        const [line, shown] = [from, to].map((pixel) => this.#perspective.directionAt(pixel));
        await gesture.give("turn_camera", turnBetween(shown, line));
      }
      this.#isHeld = false;
      this.#picture.forget();
      this.#follow();
    });
  }
}
