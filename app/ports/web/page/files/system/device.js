// SPDX-License-Identifier: Apache-2.0
// Support file, backup, restore, factory reset and update of the whole device, for administrators.
import { answerTo } from "../appliance/api.js";
import { decimalText } from "../elements/amounts.js";
import { Card } from "../elements/card.js";
import { element, field, passphraseFields, setText } from "../elements/elements.js";
import { texts } from "../texts.js";
import { checkBox } from "./check_box.js";
import { Restore } from "./restore.js";
import { Update } from "./update.js";

const { device } = texts;

// Typed to confirm; the appliance demands the same.
const kResetWords = "factory reset";

const kMebibyte = 1 << 20;

// A file that the appliance makes and the browser then saves. `bodyOf(values)` is the request's body.
class MadeFile {
  constructor(kind, path, parts, bodyOf) {
    Object.assign(this, { kind, path, bodyOf });
    this.said = element("p", { role: "status" });
    this.report = element("pre", { hidden: true });
    this.button = element("button", {}, device[kind].make);
    this.form = element("form", {}, ...parts.flatMap((part) => [part, " "]), this.button);
    this.form.addEventListener("submit", (event) => this.#make(event));
    this.root = element("section", {}, element("h4", {}, device[kind].title), element("p", {}, device[kind].help),
      this.form, this.said, this.report);
  }

  async #make(event) {
    event.preventDefault();
    this.button.disabled = true;
    this.#say(device.making);
    const { refused, bytes, report } = await answerTo(this.path, this.bodyOf(new FormData(this.form)));
    this.button.disabled = false;
    this.report.hidden = Boolean(refused);
    if (refused) return this.#say(texts.refused(refused), true);
    setText(this.report, report);
    this.#say(device.made(decimalText(bytes / kMebibyte, 1)));
    this.form.reset();
    element("a", { href: `api/v1/device_file?file=${this.kind}`, download: "" }).click();
  }

  #say(text, isWrong = false) {
    setText(this.said, text);
    this.said.classList.toggle("wrong", isWrong);
  }
}

class Reset {
  constructor() {
    this.said = element("p", { role: "status" });
    this.form = element("form", {},
      field(device.reset.confirmation(kResetWords), { name: "confirmation", autocomplete: "off" }), " ",
      element("button", {}, device.reset.run));
    this.form.addEventListener("submit", (event) => this.#reset(event));
    this.root = element("section", {}, element("h4", {}, device.reset.title),
      element("p", {}, device.reset.help), this.form, this.said);
  }

  async #reset(event) {
    event.preventDefault();
    const { refused } = await answerTo("api/v1/factory_reset", Object.fromEntries(new FormData(this.form)));
    setText(this.said, refused ? texts.refused(refused) : device.restarts);
    this.said.classList.toggle("wrong", Boolean(refused));
    if (!refused) this.form.reset();
  }
}

export class Device {
  // `isShown()`: whether its page is open.
  constructor(isShown) {
    this.card = new Card("device", device.title, texts.cards.device);
    const support = new MadeFile("support", "api/v1/make_support_file",
      [checkBox(device.support.pictures, "pictures")], (values) => ({ pictures: values.has("pictures") }));
    // An empty passphrase leaves the secrets out.
    const backup = new MadeFile("backup", "api/v1/make_backup",
      [...passphraseFields(device.passphrase, "new-password"), checkBox(device.backup.events, "events")],
      (values) => ({ passphrase: values.get("passphrase") || null, events: values.has("events") }));
    this.card.append(...[support, backup, new Restore(), new Reset(),
      new Update(() => isShown() && this.card.isOpen)].map((part) => part.root));
    this.root = this.card.root;
  }
}
