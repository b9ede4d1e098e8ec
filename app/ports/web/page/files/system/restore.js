// SPDX-License-Identifier: Apache-2.0
// A backup is uploaded in parts and checked; what it would change is shown, and restored when that is confirmed.
import { answerTo } from "../appliance/api.js";
import { element, field, passphraseFields, setText, table } from "../elements/elements.js";
import { texts } from "../texts.js";
import { checkBox } from "./check_box.js";
import { upload } from "./upload.js";

const { device } = texts;

const list = (title, lines) => (lines.length === 0 ? [] : [element("p", {}, title),
  element("ul", {}, ...lines.map((line) => element("li", {}, element("code", {}, line))))]);

export class Restore {
  #contents = null; // contents of the checked backup
  #cameras = [];    // {name, address, input} of each
  #changes = 0;     // number of changes of the form: a check of what was in it before counts no more

  constructor() {
    this.said = element("p", { role: "status" });
    this.shown = element("div", { hidden: true });
    this.run = element("button", {}, device.restore.check);
    this.form = element("form", {},
      field(device.restore.file, { name: "file", type: "file", accept: ".zst" }), " ",
      ...passphraseFields(device.passphrase, "current-password"), " ",
      checkBox(device.restore.events, "events", true), " ", this.run);
    this.form.addEventListener("submit", (event) => this.#check(event));
    // The checked contents are not those that would be restored.
    this.form.addEventListener("input", () => this.#forget());
    this.confirm = element("button", { type: "button" }, device.restore.run);
    this.confirm.addEventListener("click", () => this.#restore());
    this.root = element("section", {}, element("h4", {}, device.restore.title),
      element("p", {}, device.restore.help), this.form, this.said, this.shown);
  }

  #say(text, isWrong = false) {
    setText(this.said, text);
    this.said.classList.toggle("wrong", isWrong);
  }

  #forget() {
    ++this.#changes;
    this.#contents = null;
    this.shown.hidden = true;
    this.#say("");
  }

  #body() {
    const { passphrase } = Object.fromEntries(new FormData(this.form));
    const cameras = this.#cameras.filter(({ input, address }) => input.value !== address)
      .map(({ name, input }) => ({ camera: name, address: input.value }));
    return { passphrase: passphrase || null, cameras, events: new FormData(this.form).has("events") };
  }

  // One at a time: parts of two uploads would mix.
  async #check(event) {
    event.preventDefault();
    this.#forget();
    this.#cameras = [];
    this.run.disabled = true;
    const changes = this.#changes, isWanted = () => changes === this.#changes;
    const contents = await this.#read(isWanted);
    this.run.disabled = false;
    if (!isWanted()) return;
    if (contents.refused) return this.#say(texts.refused(contents.refused), true);
    this.#show(contents);
  }

  // Contents of the backup, or the reason as `refused`; null: they are not wanted any more.
  async #read(isWanted) {
    const { file } = Object.fromEntries(new FormData(this.form));
    const onShare = (share) => this.#say(device.restore.sent(share));
    const refused = await upload("api/v1/upload_backup", file, { onShare, isWanted });
    if (!isWanted()) return null;
    return refused ? { refused } : answerTo("api/v1/check_restore", this.#body());
  }

  #show(contents) {
    this.#contents = contents;
    this.#cameras = contents.cameras.map(({ name, key, address }) => ({ name, address,
      label: `${name}: ${key}`, input: element("input", { value: address }) }));
    const changes = table([device.restore.file, device.restore.change], device.restore.changes);
    changes.body.append(...contents.changes.map(({ file, change }) => element("tr", {},
      element("td", {}, element("code", {}, file)),
      element("td", {}, device.restore.words[change] ?? change))));
    this.shown.replaceChildren(changes.root,
      ...list(device.restore.notRestored, contents.not_restored),
      ...list(device.restore.leftOut, contents.left_out),
      ...list(device.restore.notes, contents.notes),
      ...this.#cameras.map(({ label, input }) =>
        element("p", {}, element("label", {}, device.restore.camera, " ", element("code", {}, label), " ", input))),
      element("p", {}, this.confirm));
    this.shown.hidden = false;
    this.#say(device.restore.of(contents));
  }

  async #restore() {
    if (!this.#contents || !confirm(device.restore.asks)) return;
    this.confirm.disabled = this.run.disabled = true;
    const { refused } = await answerTo("api/v1/restore", { ...this.#body(), sha256: this.#contents.sha256 });
    this.confirm.disabled = this.run.disabled = false;
    if (refused) return this.#say(texts.refused(refused), true);
    this.form.reset();
    this.#forget();
    this.#say(device.restarts);
  }
}
