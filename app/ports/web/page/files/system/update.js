// SPDX-License-Identifier: Apache-2.0
// Update of a device with two slots: running version and its trial, upload and installation with their progress.
import { answerTo, read } from "../appliance/api.js";
import { button, element, field, setText } from "../elements/elements.js";
import { texts } from "../texts.js";
import { upload } from "./upload.js";

const { device } = texts;
const { update } = device;

const kAgainMs = 1000;
const kAll = 100;

export class Update {
  #again = 0;
  #isSending = false;
  #hasAnswer = false;  // what the page said about its own command stays until the next command or installation

  // `isShown()`: false while the card is closed or another page is open; nothing is read then.
  constructor(isShown) {
    this.isShown = isShown;
    this.state = element("p", {});
    this.said = element("p", { role: "status" });
    this.bar = element("progress", { max: kAll, hidden: true, "aria-label": update.title });
    this.run = element("button", {}, update.run);
    this.form = element("form", {},
      field(update.file, { name: "file", type: "file", accept: ".raucb" }), " ", this.run);
    this.form.addEventListener("submit", (event) => this.#send(event));
    this.offer = element("div", { hidden: true }, this.form);
    this.restart = button(update.restart, () => this.#restart());
    this.restart.hidden = true;
    this.root = element("section", { id: "update" }, element("h4", {}, update.title), this.state, this.offer, this.bar,
      this.said, this.restart);
    this.#read();
  }

  #say(text, isWrong = false) {
    setText(this.said, text);
    this.said.classList.toggle("wrong", isWrong);
  }

  // Reads again until the device turns out to have no slots.
  async #read() {
    clearTimeout(this.#again);
    const answer = this.isShown() && await read("api/v1/update").catch(() => null);
    if (answer) this.#show(answer);
    if (!answer || answer.has_slots) this.#again = setTimeout(() => this.#read(), kAgainMs);
  }

  #show(answer) {
    if (!answer.has_slots) return setText(this.state, update.byPackages);
    setText(this.state, [update.running(answer), update.trial(answer), answer.refusal].filter(Boolean).join(" "));
    const isInstalling = answer.work === "checking" || answer.work === "installing";
    this.offer.hidden = Boolean(answer.refusal);
    this.run.disabled = this.#isSending || isInstalling;
    this.restart.hidden = answer.trial !== "installed" || answer.work !== "none";
    this.bar.hidden = answer.work === "none";
    this.bar.value = answer.percent;
    if (isInstalling) {
      this.#hasAnswer = false;
      return this.#say(update.work[answer.work](answer));
    }
    if (this.#isSending || this.#hasAnswer) return;
    this.#say(answer.failure && texts.refused(answer.failure), Boolean(answer.failure));
  }

  #answer(text, isWrong) {
    this.#hasAnswer = true;
    this.#say(text, isWrong);
  }

  async #send(event) {
    event.preventDefault();
    const { file } = Object.fromEntries(new FormData(this.form));
    this.#isSending = this.run.disabled = true;
    this.#hasAnswer = false;
    this.bar.hidden = false;
    const onShare = (share) => {
      this.bar.value = kAll * share;
      this.#say(device.restore.sent(share));
    };
    const refused = await upload("api/v1/upload_update", file, { onShare, more: { size: file.size } }) ||
      (await answerTo("api/v1/install_update", {})).refused;
    this.#isSending = this.run.disabled = false;
    if (refused) return this.#answer(texts.refused(refused), true);
    this.form.reset();
    this.#say("");
    this.#read();
  }

  async #restart() {
    if (!confirm(update.asks)) return;
    const { refused } = await answerTo("api/v1/restart_device", {});
    this.#answer(refused ? texts.refused(refused) : device.restarts, Boolean(refused));
    if (!refused) this.restart.hidden = true;
  }
}
