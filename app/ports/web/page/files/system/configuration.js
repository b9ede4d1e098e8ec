// SPDX-License-Identifier: Apache-2.0
// The files of the configuration, to be changed as texts.
import { Card } from "../elements/card.js";
import { downloadLink } from "../elements/download.js";
import { element, setText } from "../elements/elements.js";
import { texts } from "../texts.js";
import { Merge } from "./merge.js";
import { Trial } from "./trial.js";

// Text fields support only \n as line end.
const plain = (text) => text.replaceAll("\r\n", "\n");

// One file. Unchanged files are never sent, so that no byte of them changes. `base` is the text of the appliance that
// is changed here, and `basis` its checksum; `source` is the text that the field was filled with, with its line ends.
class FileEditor {
  constructor({ name, text, may_change: mayChange, checksum }) {
    this.name = name;
    this.onDisk = text;
    this.checksum = checksum;  // checksum of the file on the disk
    this.area = element("textarea", { rows: 16, spellcheck: false, readOnly: !mayChange, wrap: "off" });
    this.area.setAttribute("aria-label", name);
    this.mark = element("span", {});
    const download = downloadLink(name.split("/").pop(), () => this.text);
    this.reload = element("button", { type: "button", hidden: true }, texts.reloadFile);
    this.reload.addEventListener("click", () => this.#takeFromDisk());
    this.merge = new Merge(name, (merged) => this.#takeFromDisk(merged));
    this.root = element("details", {}, element("summary", {}, name, " ", this.mark), this.area,
      this.merge.root, element("p", {}, download, " ", this.reload));
    this.area.addEventListener("input", () => this.#showMark());
    this.#takeFromDisk();
  }

  // Sets an uploaded text with its line ends. It is a change of `base` like a typed one.
  take(text) {
    this.source = text;
    this.area.value = text;
    this.#showMark();
  }

  // Changes by another user do not replace a change made here.
  update({ text, checksum }) {
    const mayFollow = !this.isChanged || this.text === text;
    this.onDisk = text;
    this.checksum = checksum;
    if (mayFollow) this.#takeFromDisk();
    else this.#showMark();
  }

  // Bases the text on the file on the disk: it is that file, or `merged`, which has its changes and gets its line ends.
  #takeFromDisk(merged = this.onDisk) {
    this.base = this.onDisk;
    this.basis = this.checksum;
    this.source = this.onDisk;
    this.area.value = merged;
    this.#showMark();
  }

  get text() {
    const typed = this.area.value;
    if (typed === plain(this.source)) return this.source;
    return this.source.includes("\r\n") ? typed.replaceAll("\n", "\r\n") : typed;
  }

  get isChanged() {
    return this.text !== this.onDisk;
  }

  #showMark() {
    const isOutdated = this.basis !== this.checksum;
    this.reload.hidden = !isOutdated;
    if (isOutdated) this.merge.show(plain(this.base), plain(this.onDisk), this.area.value);
    else this.merge.hide();
    setText(this.mark, isOutdated ? texts.changedElsewhere : this.isChanged ? texts.changed : "");
  }
}

export class Configuration {
  #editors = new Map();

  constructor() {
    this.card = new Card("configuration", texts.configurationTitle);
    this.root = this.card.root;
    this.trial = new Trial("configuration", () => this.#changed(), () => this.card.isOpen,
      { onState: (state) => this.#show(state) });
    this.refusal = element("p", { className: "wrong" });
    this.files = element("div");
    this.upload = element("input", { type: "file", multiple: true, accept: ".toml,.yaml,.yml" });
    this.upload.addEventListener("change", () => this.#takeFiles());
    this.card.append(this.refusal, this.trial.head, this.files,
      element("p", {}, element("label", {}, texts.uploadFiles, " ", this.upload)), this.trial.foot);
    this.card.whenOpened(() => this.trial.refresh());
  }

  status({ system }) {
    const isRefused = system.configuration_refused;
    this.card.say(isRefused ? texts.notices.refused
      : system.trial_left > 0 ? texts.notices.trial(system.trial_left) : texts.filesCount, isRefused);
  }

  // True: texts were typed that are not in the files.
  get isChanged() {
    return this.#changed() !== null;
  }

  #show(state) {
    setText(this.refusal, state.refusal ? texts.filesRefused(state.refusal) : "");
    for (const file of state.files) {
      const editor = this.#editors.get(file.name);
      if (!editor) {
        this.#add(new FileEditor(file));
      } else if (editor.onDisk !== file.text) {
        editor.update(file);
      }
    }
  }

  #add(editor) {
    this.#editors.set(editor.name, editor);
    this.files.append(editor.root);
  }

  // Null: the reason is shown.
  async #textOf(file) {
    const bytes = await file.arrayBuffer().catch(() => null);
    try {
      if (bytes) return new TextDecoder("utf-8", { fatal: true, ignoreBOM: true }).decode(bytes);
    } catch {
      // Another encoding.
    }
    this.trial.say((bytes ? texts.notUtf8 : texts.unreadable)(file.name), true);
    return null;
  }

  async #takeFiles() {
    for (const file of this.upload.files) {
      const text = await this.#textOf(file);
      if (text === null) continue;
      const named = [...this.#editors.values()]
        .find((editor) => editor.name.split("/").pop() === file.name);
      if (!named) this.#add(new FileEditor({ name: file.name, text: "", may_change: true }));
      const editor = named ?? this.#editors.get(file.name);
      editor.take(text);
      editor.root.open = true;
    }
    this.upload.value = "";
  }

  // Null: no changes.
  #changed() {
    const changed = [...this.#editors.values()].filter((editor) => editor.isChanged);
    if (changed.length === 0) return null;
    const known = changed.filter((editor) => editor.basis);
    return {
      files: Object.fromEntries(changed.map((editor) => [editor.name, editor.text])),
      based_on: Object.fromEntries(known.map((editor) => [editor.name, editor.basis])),
    };
  }
}
