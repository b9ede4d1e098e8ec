// SPDX-License-Identifier: Apache-2.0
// New texts of the configuration: checked, tried out, confirmed or reverted. The appliance restarts with them
// meanwhile.
import { answerTo, patience } from "../appliance/api.js";
import { commandButton, element, oneAtATime, setText } from "../elements/elements.js";
import { texts } from "../texts.js";
import { trialEnds } from "./trial_end.js";

const kPath = "api/v1/configuration";
const kUsualSeconds = 60;
const kAgainMs = 1000;

export class Trial {
  #again = 0;
  #trial = null;

  // `what` is sent to check_WHAT and try_WHAT; `changes()` makes the body, null: no changes. `isShown()`: the
  // page is visible. `onState(state)`: called repeatedly with the files. `onTried(changes)`: called with what is tried,
  // which may have changed since.
  constructor(what, changes, isShown, { onState = () => {}, onTried = () => {} } = {}) {
    Object.assign(this, { what, changes, isShown, onState, onTried });
    this.said = element("p", { role: "status" });
    this.difference = element("pre", { tabIndex: 0, hidden: true });
    this.difference.setAttribute("aria-label", texts.difference);
    this.seconds = element("input", {
      type: "number", min: 10, max: 3600, value: kUsualSeconds, name: "seconds" });
    const ends = trialEnds((refused, done) => this.#ended(refused, done));
    this.waiting = element("p", { hidden: true }, element("strong", { role: "timer" }),
      ...ends.flatMap((button) => [" ", button]));
    this.head = element("div", { className: "trial" }, this.said, this.waiting);
    this.foot = element("div", { className: "trial" }, element("p", {},
      commandButton(texts.checkFiles, "check", oneAtATime(() => this.#check())), " ",
      element("label", {}, texts.trySeconds, " ", this.seconds), " ",
      commandButton(texts.tryFiles, "try", oneAtATime(() => this.#try()))), this.difference);
  }

  say(text, isWrong = false) {
    setText(this.said, text);
    this.said.classList.toggle("wrong", isWrong);
  }

  // Repeated during a trial, because the appliance restarts meanwhile.
  async refresh() {
    clearTimeout(this.#again);
    if (!this.isShown()) return;
    const answer = await fetch(kPath, patience()).catch(() => null);
    const state = answer && await answer.json().catch(() => null);
    const isRestarting = !state || answer.status >= 500;
    if (answer?.ok && state) this.#show(state);
    else if (!isRestarting) this.say(texts.refused(state.error), true);
    if (this.#trial || isRestarting) this.#again = setTimeout(() => this.refresh(), kAgainMs);
  }

  #show(state) {
    const hadTrial = this.#trial;
    this.#trial = state.trial;
    this.waiting.hidden = !state.trial;
    if (state.trial) {
      setText(this.waiting.firstChild, texts.goesBack(state.trial));
    } else if (hadTrial) {
      this.say(texts.filesCount);
    }
    this.onState(state);
  }

  async #send(verb, more) {
    const changes = this.changes();
    if (!changes) return this.say(texts.nothingChanged), null;
    const answer = await answerTo(`api/v1/${verb}_${this.what}`, { ...changes, ...more });
    this.difference.hidden = Boolean(answer.refused);
    setText(this.difference, answer.difference ?? "");
    if (!answer.refused) return { ...answer, changes };
    this.say(texts.refused(answer.refused), true);
    await this.refresh();  // another user may have changed a file
    return null;
  }

  async #check() {
    const answer = await this.#send("check", {});
    if (answer) this.say(texts.checked(answer.files.join(", ")));
  }

  async #try() {
    const answer = await this.#send("try", { seconds: Number(this.seconds.value) });
    if (!answer) return;
    this.say(texts.tried);
    this.onTried(answer.changes);
    await this.refresh();
  }

  #ended(refused, done) {
    this.say(refused ? texts.refused(refused) : done, Boolean(refused));
    if (!refused) this.#trial = null;
    return this.refresh();
  }
}
