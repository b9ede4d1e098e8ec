// SPDX-License-Identifier: Apache-2.0
// Exports of an event, or of a range of it: the appliance makes a file, which the browser then saves.
import { answerTo, post } from "../appliance/api.js";
import { decimalText } from "../elements/amounts.js";
import { button, element, setText } from "../elements/elements.js";
import { texts } from "../texts.js";

const kAgainMs = 500;
const kFormats = ["mcap", "csv", "tif", "avi", "zip"];
const kWithCamera = ["tif", "avi"];
const kMebibyte = 2 ** 20;

export class EventExport {
  #event = null;
  #camera = "";
  #time = "";  // of the picture that is shown, UTC
  #from = "";  // ends of the range, UTC; empty: the event's
  #to = "";
  #number = 0; // of the export that is followed
  #again = 0;

  // `onRange(from, to)`: the range has changed; milliseconds since 1970, null: an end of the event.
  constructor(onRange) {
    const said = texts.recordings.exports;
    this.onRange = onRange;
    this.format = element("select", { name: "format" },
      ...kFormats.map((value) => element("option", { value }, said.formats[value])));
    this.format.addEventListener("change", () => this.#describe());
    this.draws = element("input", { type: "checkbox", name: "draws" });
    this.drawing = element("label", {}, this.draws, " ", said.draws);
    this.source = element("span", { className: "quiet" });
    this.range = element("output");
    this.make = element("button", {}, said.make);
    this.cancel = button(texts.align.cancel, () => this.#cancel());
    this.bar = element("progress", { "aria-label": said.title, max: 1 });
    this.link = element("a", { className: "button", hidden: true });
    this.link.addEventListener("click", () => this.#save());
    this.said = element("p", { role: "status" });
    this.failed = element("p", { role: "alert", className: "wrong" });
    this.form = this.#makeForm();
    this.root = element("details", { className: "export" }, element("summary", {}, said.title), this.form,
      element("p", { className: "buttons" }, this.bar, this.cancel, this.link), this.said, this.failed);
    this.#isMaking = false;
    this.#describe();
  }

  #makeForm() {
    const said = texts.recordings.exports;
    const form = element("form", {},
      element("p", { className: "buttons" }, element("label", {}, said.format, " ", this.format), this.drawing,
        this.source),
      element("p", { className: "buttons" }, button(said.from, () => this.#mark(this.#time, this.#to)),
        button(said.to, () => this.#mark(this.#from, this.#time)), button(said.whole, () => this.#mark("", "")),
        this.range),
      element("p", { className: "buttons" }, this.make));
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.#begin();
    });
    return form;
  }

  // Null closes it; what is being made goes on. The form is hidden until setReady().
  async open(event) {
    this.#event = event;
    this.form.hidden = true;
    this.#camera = this.#time = "";
    if (!event) return;
    this.#mark("", "");
    if (this.#number > 0) return;
    const status = await this.#status();
    if (status?.state === "making" && this.#number === 0) this.#follow(status.number, false);
  }

  // The event's pictures are known, to which camera and range refer.
  setReady() {
    this.form.hidden = false;
  }

  // The camera and the moment that are shown.
  show(camera, time) {
    this.#camera = camera;
    this.#time = time;
    this.#describe();
  }

  // The end that was set before gives way to one beyond it.
  #mark(from, to) {
    const isTurned = from && to && from > to;
    this.#to = isTurned && to !== this.#time ? "" : to;
    this.#from = isTurned && to === this.#time ? "" : from;
    this.onRange(...[this.#from, this.#to].map((end) => (end ? Date.parse(end) : null)));
    this.#describe();
  }

  #describe() {
    const said = texts.recordings.exports, hasCamera = kWithCamera.includes(this.format.value);
    setText(this.source, hasCamera ? said.camera(this.#camera) : "");
    this.drawing.hidden = this.format.value !== "avi";
    const ends = [this.#from, this.#to].map((end) => (end ? this.#offsetOf(end) : null));
    setText(this.range, this.#from || this.#to ? said.range(...ends) : said.whole);
  }

  #offsetOf(time) {
    const { triggered, first } = this.#event;
    return decimalText((Date.parse(time) - Date.parse(triggered || first)) / 1000, 2);
  }

  set #isMaking(isMaking) {
    this.make.disabled = isMaking;
    this.bar.hidden = this.cancel.hidden = !isMaking;
  }

  async #begin() {
    const format = this.format.value, hasCamera = kWithCamera.includes(format);
    setText(this.failed, "");
    this.make.disabled = true;
    const begun = await answerTo("api/v1/export_recording", { event: this.#event.name, format,
      camera: hasCamera ? this.#camera : "", from: this.#from, to: this.#to,
      draws: format === "avi" && this.draws.checked });
    this.make.disabled = false;
    if (begun.refused) return setText(this.failed, texts.refused(begun.refused));
    await this.#follow(begun.number, true);
  }

  async #cancel() {
    const why = await post("api/v1/cancel_export", { number: this.#number });
    setText(this.failed, why ? texts.refused(why) : "");
  }

  async #status() {
    const answer = await fetch("api/v1/recordings/export").catch(() => null);
    return answer?.ok ? answer.json().catch(() => null) : null;
  }

  // Follows an export until it ends. The file of one's own is saved at once.
  async #follow(number, isOwn) {
    this.#number = number;
    this.link.hidden = true;
    clearTimeout(this.#again);
    const status = await this.#status();
    if (this.#number !== number) return;
    const isMaking = !status || (status.number === number && status.state === "making");
    this.#isMaking = isMaking;
    if (status) this.#show(status, isOwn);
    if (isMaking) this.#again = setTimeout(() => this.#follow(number, isOwn), kAgainMs);
  }

  #show({ number, state, event, file, done, of, bytes, error }, isOwn) {
    const said = texts.recordings.exports;
    if (number !== this.#number) return setText(this.said, "");
    if (of > 0) this.bar.value = done / of;
    else this.bar.removeAttribute("value");
    setText(this.said, state === "making" ? said.making(event, decimalText(bytes / kMebibyte, 1))
      : state === "none" ? said.cancelled : "");
    if (state === "failed") setText(this.failed, texts.refused(error));
    if (state !== "ready") return;
    Object.assign(this.link, { href: `api/v1/recordings/exported?${new URLSearchParams({ number })}`, download: file,
      hidden: false, textContent: said.save(file) });
    if (isOwn) this.link.click();
  }

  // A file can be fetched once.
  #save() {
    setText(this.said, texts.recordings.exports.saved(this.link.download));
    this.link.hidden = true;
  }
}
