// The files of the configuration: changed, checked, tried out, confirmed.
import { answerTo } from "./api.js";
import { element, setText } from "./elements.js";
import { texts } from "./texts.js";

const kPath = "/api/v1/configuration";
const kUsualSeconds = 60;
const kAgainMs = 1000;

// Text fields know no line ends but \n.
const plain = (text) => text.replaceAll("\r\n", "\n");

// One file. What is not touched is never sent, so no byte of it changes.
class FileEditor {
  constructor({ name, text, may_change: mayChange }) {
    this.name = name;
    this.onDisk = text;
    this.area = element("textarea", { rows: 16, spellcheck: false, readOnly: !mayChange, wrap: "off" });
    this.area.setAttribute("aria-label", name);
    this.mark = element("span", {});
    const download = element("a", { className: "button", download: name.split("/").pop() },
      texts.download);
    download.addEventListener("click", () => {
      download.href = URL.createObjectURL(new Blob([this.text]));
      setTimeout(() => URL.revokeObjectURL(download.href), kAgainMs);
    });
    download.href = "#";
    this.root = element("details", {}, element("summary", {}, name, " ", this.mark), this.area,
      element("p", {}, download));
    this.area.addEventListener("input", () => this.#showMark());
    this.take(text);
  }

  // As a text of its own, by whatever way it came.
  take(text) {
    this.base = text;
    this.area.value = text;
    this.#showMark();
  }

  get text() {
    const typed = this.area.value;
    if (typed === plain(this.base)) return this.base;
    return this.base.includes("\r\n") ? typed.replaceAll("\n", "\r\n") : typed;
  }

  get isChanged() {
    return this.text !== this.onDisk;
  }

  #showMark() {
    setText(this.mark, this.isChanged ? texts.changed : "");
  }
}

export class Configuration {
  #editors = new Map();
  #again = 0;
  #trial = null;

  constructor(root) {
    this.said = element("p", { role: "status" });
    this.refusal = element("p", { className: "wrong" });
    this.files = element("div");
    this.difference = element("pre", { tabIndex: 0, hidden: true });
    this.difference.setAttribute("aria-label", texts.difference);
    this.seconds = element("input", {
      type: "number", min: 10, max: 3600, value: kUsualSeconds, name: "seconds" });
    this.upload = element("input", { type: "file", multiple: true, accept: ".toml,.yaml,.yml" });
    this.upload.addEventListener("change", () => this.#takeFiles());
    this.check = this.#button(texts.checkFiles, () => this.#check());
    this.try = this.#button(texts.tryFiles, () => this.#try());
    this.confirm = this.#button(texts.confirmFiles, () => this.#end("confirm", texts.confirmed));
    this.revert = this.#button(texts.revertFiles, () => this.#end("revert", texts.reverted));
    this.waiting = element("p", { hidden: true }, element("strong", { role: "timer" }), " ",
      this.confirm, " ", this.revert);
    this.opened = element("details", { id: "configuration" },
      element("summary", {}, texts.configurationTitle),
      this.said, this.refusal, this.waiting, this.files,
      element("p", {}, element("label", {}, texts.uploadFiles, " ", this.upload)),
      element("p", {}, this.check, " ", element("label", {}, texts.trySeconds, " ", this.seconds),
        " ", this.try),
      this.difference);
    this.opened.addEventListener("toggle", () => this.#refresh());
    root.append(this.opened);
  }

  #button(label, act) {
    const button = element("button", { type: "button" }, label);
    button.addEventListener("click", act);
    return button;
  }

  #say(text, isWrong = false) {
    setText(this.said, text);
    this.said.classList.toggle("wrong", isWrong);
  }

  // While it is open; with a trial again and again, since the appliance restarts meanwhile.
  async #refresh() {
    clearTimeout(this.#again);
    if (!this.opened.open) return;
    const answer = await fetch(kPath).catch(() => null);
    const state = answer && await answer.json().catch(() => null);
    if (answer?.ok && state) this.#show(state);
    else if (state) this.#say(texts.refused(state.error), true);
    if (this.#trial || !answer) this.#again = setTimeout(() => this.#refresh(), kAgainMs);
  }

  #show(state) {
    const hadTrial = this.#trial;
    this.#trial = state.trial;
    setText(this.refusal, state.refusal ? texts.filesRefused(state.refusal) : "");
    this.waiting.hidden = !state.trial;
    if (state.trial) {
      setText(this.waiting.firstChild, texts.goesBack(state.trial.seconds_left));
    } else if (hadTrial) {
      this.#say(texts.filesCount);
    }
    for (const file of state.files) {
      const editor = this.#editors.get(file.name);
      if (!editor) {
        this.#add(new FileEditor(file));
      } else if (editor.onDisk !== file.text) {
        const wasChanged = editor.isChanged;
        editor.onDisk = file.text;
        editor.take(wasChanged ? editor.text : file.text);
      }
    }
  }

  #add(editor) {
    this.#editors.set(editor.name, editor);
    this.files.append(editor.root);
  }

  async #takeFiles() {
    for (const file of this.upload.files) {
      let text;
      try {
        text = new TextDecoder("utf-8", { fatal: true, ignoreBOM: true })
          .decode(await file.arrayBuffer());
      } catch {
        this.#say(texts.notUtf8(file.name), true);
        continue;
      }
      const named = [...this.#editors.values()]
        .find((editor) => editor.name.split("/").pop() === file.name);
      if (!named) this.#add(new FileEditor({ name: file.name, text: "", may_change: true }));
      const editor = named ?? this.#editors.get(file.name);
      editor.take(text);
      editor.root.open = true;
    }
    this.upload.value = "";
  }

  #changed() {
    const changed = [...this.#editors.values()].filter((editor) => editor.isChanged);
    return Object.fromEntries(changed.map((editor) => [editor.name, editor.text]));
  }

  async #send(what, more) {
    const files = this.#changed();
    if (Object.keys(files).length === 0) return this.#say(texts.nothingChanged), null;
    const answer = await answerTo(`/api/v1/${what}_configuration`, { files, ...more });
    this.difference.hidden = Boolean(answer.refused);
    setText(this.difference, answer.difference ?? "");
    if (answer.refused) this.#say(texts.refused(answer.refused), true);
    return answer.refused ? null : answer;
  }

  async #check() {
    const answer = await this.#send("check", {});
    if (answer) this.#say(texts.checked(answer.files.join(", ")));
  }

  async #try() {
    const answer = await this.#send("try", { seconds: Number(this.seconds.value) });
    if (!answer) return;
    this.#say(texts.tried);
    await this.#refresh();
  }

  async #end(what, done) {
    const { refused } = await answerTo(`/api/v1/${what}_configuration`, {});
    this.#say(refused ? texts.refused(refused) : done, Boolean(refused));
    if (!refused) this.#trial = null;
    await this.#refresh();
  }
}
