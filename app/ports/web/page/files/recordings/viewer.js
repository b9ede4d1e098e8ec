// SPDX-License-Identifier: Apache-2.0
// Pictures of one event, one after the other, beginning with that of the trigger, and its signals.
import { decimalText } from "../elements/amounts.js";
import { secondText } from "../elements/clock.js";
import { button, element, setText } from "../elements/elements.js";
import { texts } from "../texts.js";
import { EventExport } from "./event_export.js";
import { EventRegions } from "./event_regions.js";
import { EventReplay } from "./event_replay.js";
import { EventSignals } from "./event_signals.js";

const kDigits = 2;  // of seconds from the trigger
const kAgainMs = 1000;

export class Viewer {
  #event = null;
  #cameras = {};  // by camera: {utc, times, parts} of its pictures; parts of the camera's whole picture
  #times = [];    // of the chosen camera, milliseconds since 1970
  #path = "";     // of the picture that was asked for last
  #isLoading = false;
  #again = 0;

  // `figures`: descriptions of figures by kind of component.
  constructor(figures) {
    const said = texts.recordings;
    this.heading = element("h3");
    this.camera = element("select", { name: "camera" });
    this.camera.addEventListener("change", () => this.#choose());
    this.picture = element("img", { className: "frame" });
    this.picture.addEventListener("load", () => this.#end(""));
    this.picture.addEventListener("error", () => this.#end(said.noPicture));
    this.regions = new EventRegions();
    this.place = element("input", { type: "range", min: 0, step: 1, "aria-label": said.place });
    this.place.addEventListener("input", () => this.#show());
    this.when = element("output");
    this.failed = element("p", { role: "alert", className: "wrong" });
    this.signals = new EventSignals(figures,
      { choose: (moment) => this.#choose(moment), step: (by) => this.#step(by) });
    this.stage = element("div", { className: "stage" },
      element("div", { className: "seen" }, this.picture, this.regions.svg), this.place,
      element("p", { className: "buttons steps" }, button(said.before, () => this.#step(-1)),
        button(said.after, () => this.#step(1)), this.when), this.signals.root);
    this.exports = new EventExport((from, to) => this.signals.setRange(from, to));
    this.replay = new EventReplay(figures,
      { choose: (moment) => this.#choose(moment), onResult: (number) => this.signals.setReplay(number) });
    this.root = element("section", { id: "viewer", hidden: true }, this.heading,
      element("p", { className: "buttons" }, element("label", {}, texts.align.camera, " ", this.camera), this.regions.label,
        button(said.close, () => this.close())),
      this.stage, this.failed, this.regions.said, this.replay.root, this.exports.root);
  }

  open(event, title) {
    this.#event = event;
    this.root.hidden = false;
    setText(this.heading, title);
    setText(this.failed, "");
    this.#clear();
    this.signals.open(event);
    this.regions.open(event);
    this.exports.open(event);
    this.replay.open(event);
    return this.#read(event);
  }

  // Removes the event before, until the pictures of the new one are known.
  #clear() {
    this.stage.hidden = true;
    this.#cameras = {};
    this.#times = [];
    this.#path = "";
    this.#isLoading = false;
    this.camera.replaceChildren();
    this.picture.removeAttribute("src");
    this.picture.alt = "";
    this.place.value = this.place.max = 0;
    setText(this.when, "");
  }

  async #read(event) {
    clearTimeout(this.#again);
    const answer = await fetch(`api/v1/recordings/frames?${new URLSearchParams({ event: event.name })}`)
      .catch(() => null);
    const read = await answer?.json().catch(() => null);
    if (this.#event !== event) return;
    if (!read?.cameras) {
      setText(this.failed, texts.refused(read?.error ?? texts.recordings.noPicture));
      this.#again = setTimeout(() => this.#read(event), kAgainMs);
      return;
    }
    this.#cameras = Object.fromEntries(read.cameras.map(({ camera, times, parts }) =>
      [camera, { utc: times, times: times.map((time) => Date.parse(time)), parts }]));
    this.camera.replaceChildren(...read.cameras.map(({ camera }) => element("option", { value: camera }, camera)));
    setText(this.failed, "");
    this.stage.hidden = false;
    this.exports.setReady();
    this.#choose(Date.parse(event.triggered || event.first));
    this.root.scrollIntoView({ block: "nearest" });
    this.place.focus({ preventScroll: true });
  }

  close() {
    this.#event = null;
    clearTimeout(this.#again);
    this.signals.open(null);
    this.regions.open(null);
    this.exports.open(null);
    this.replay.open(null);
    this.root.hidden = true;
  }

  // Shows the picture of the camera that is nearest to the moment of the one before.
  #choose(moment = this.#times[this.place.valueAsNumber]) {
    this.#times = this.#cameras[this.camera.value]?.times ?? [];
    this.place.max = Math.max(0, this.#times.length - 1);
    const off = this.#times.map((time) => Math.abs(time - moment));
    this.place.value = Math.max(0, off.indexOf(Math.min(...off)));
    this.#show();
  }

  #step(by) {
    const last = Number(this.place.max);
    this.place.value = Math.min(last, Math.max(0, this.place.valueAsNumber + by));
    this.#show();
  }

  #show() {
    const frame = this.place.valueAsNumber, time = this.#times[frame];
    if (time === undefined) return;
    const offset = (time - Date.parse(this.#event.triggered || this.#event.first)) / 1000;
    setText(this.when, texts.recordings.moment(
      frame + 1, this.#times.length, secondText(time), decimalText(offset, kDigits)));
    const camera = this.camera.value, { utc, parts } = this.#cameras[camera];
    this.signals.setMoment(time);
    this.regions.show(camera, time, parts.findLast(({ first }) => first <= frame));
    this.exports.show(camera, utc[frame]);
    this.picture.alt = texts.recordings.frame(this.camera.value, frame + 1);
    if (!this.#isLoading) this.#load();
  }

  // Loads one picture at a time, then the newest that was asked for. What a busy appliance refuses is asked for again.
  #load() {
    clearTimeout(this.#again);
    const query = new URLSearchParams(
      { event: this.#event.name, camera: this.camera.value, frame: this.place.value });
    const path = `api/v1/recordings/frame.jpg?${query}`;
    if (path === this.#path) return;
    this.#path = path;
    this.#isLoading = true;
    this.picture.src = path;
  }

  // The picture may be that of the event before.
  #end(failure) {
    this.#isLoading = false;
    if (!this.#event || this.#times.length === 0) return;
    setText(this.failed, failure);
    if (!failure) return this.#load();
    this.#path = "";
    this.#again = setTimeout(() => this.#load(), kAgainMs);
  }
}
