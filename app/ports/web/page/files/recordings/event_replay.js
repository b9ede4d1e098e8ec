// SPDX-License-Identifier: Apache-2.0
// A recipe tried on an event: the appliance measures it again, and lists what would have been otherwise.
import { answerTo, post } from "../appliance/api.js";
import { amountText, decimalText } from "../elements/amounts.js";
import { button, element, setText, table } from "../elements/elements.js";
import { titled } from "../elements/figures.js";
import { parsed, texts } from "../texts.js";

const kAgainMs = 500;
const kDigits = 2;  // of seconds from the trigger

async function read(path) {
  const answer = await fetch(`api/v1/${path}`).catch(() => null);
  return answer?.ok ? answer.text().then(parsed).catch(() => null) : null;
}

export class EventReplay {
  #event = null;
  #number = 0;  // of the replay that is followed
  #again = 0;
  #figures;

  // `figures`: descriptions by kind of component. `choose(moment)` shows a moment of the event, milliseconds since
  // 1970; `onResult(number)`: the replay of this number has measured the event, 0: none has.
  constructor(figures, { choose, onResult }) {
    const said = texts.recordings.replays;
    this.#figures = figures;
    Object.assign(this, { choose, onResult });
    this.recipe = element("select", { name: "recipe" });
    this.begin = element("button", {}, said.begin);
    this.cancel = button(texts.align.cancel, () => this.#cancel());
    this.bar = element("progress", { "aria-label": said.title, max: 1 });
    this.said = element("p", { role: "status" });
    this.failed = element("p", { role: "alert", className: "wrong" });
    this.result = element("div", { className: "replayed" });
    const form = element("form", { className: "buttons" },
      element("label", {}, said.recipe, " ", this.recipe), this.begin, this.bar, this.cancel);
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.#begin();
    });
    this.root = element("details", { className: "replay" }, element("summary", {}, said.title),
      element("p", { className: "quiet" }, said.help), form, this.said, this.failed, this.result);
    this.#isMeasuring = false;
  }

  // Null closes it; what is being measured goes on.
  async open(event) {
    this.#event = event;
    this.#number = 0;
    clearTimeout(this.#again);
    this.#isMeasuring = false;
    this.#clear();
    if (!event) return;
    const [recipes, status] = await Promise.all([read("recipe"), read("recordings/replay")]);
    if (this.#event !== event || this.#number > 0) return;
    if (recipes) this.#list(recipes);
    const isOwn = status?.state === "done" && status.event === event.name;
    if (isOwn || status?.state === "measuring") this.#follow(status.number);
  }

  #list({ number, recipes }) {
    this.recipe.replaceChildren(
      ...recipes.map((one) => element("option", { value: one.number }, texts.notices.recipe(one))),
      element("option", { value: 0 }, texts.recordings.replays.recorded));
    this.recipe.value = number;
  }

  #clear() {
    setText(this.said, "");
    setText(this.failed, "");
    this.result.replaceChildren();
    this.onResult(0);
  }

  set #isMeasuring(isMeasuring) {
    this.begin.disabled = isMeasuring;
    this.bar.hidden = this.cancel.hidden = !isMeasuring;
  }

  async #begin() {
    const event = this.#event;
    this.#clear();
    this.begin.disabled = true;
    const begun = await answerTo("api/v1/replay_recording", { event: event.name, recipe: Number(this.recipe.value) });
    this.begin.disabled = false;
    if (this.#event !== event) return;
    if (begun.refused) return setText(this.failed, texts.refused(begun.refused));
    await this.#follow(begun.number);
  }

  async #cancel() {
    const why = await post("api/v1/cancel_replay", { number: this.#number });
    setText(this.failed, why ? texts.refused(why) : "");
  }

  // Follows a replay until it ends.
  async #follow(number) {
    this.#number = number;
    clearTimeout(this.#again);
    const status = await read("recordings/replay");
    if (this.#number !== number) return;
    const isMeasuring = !status || (status.number === number && status.state === "measuring");
    this.#isMeasuring = isMeasuring;
    if (status) await this.#show(status);
    if (isMeasuring && this.#number === number) this.#again = setTimeout(() => this.#follow(number), kAgainMs);
  }

  async #show({ number, state, event, done, of, error }) {
    const said = texts.recordings.replays;
    if (number !== this.#number) return setText(this.said, "");
    if (of > 0) this.bar.value = done / of;
    else this.bar.removeAttribute("value");
    setText(this.said, state === "measuring" ? said.measuring(event, done, of)
      : state === "none" ? said.cancelled : "");
    if (state === "failed") setText(this.failed, texts.refused(error));
    if (state !== "done" || event !== this.#event.name) return;
    const result = await read(`recordings/replayed?${new URLSearchParams({ number })}`);
    if (!result || number !== this.#number) return;
    this.#showResult(result);
    this.onResult(number);
  }

  #showResult({ sets, without_pictures: without, is_settled: isSettled, alarms, signals }) {
    const said = texts.recordings.replays, differing = alarms.filter(({ differs }) => differs).length;
    setText(this.said, [said.result(sets, differing, signals.length), without > 0 ? said.without(without) : "",
      isSettled ? "" : said.unsettled].filter(Boolean).join(" "));
    const shown = table([texts.alarm, said.then, said.now], texts.alarms);
    shown.body.append(...alarms.map((alarm) => this.#alarmRow(alarm)));
    this.result.replaceChildren(...(alarms.length > 0 ? [shown.root] : []));
    if (signals.length === 0) return;
    const others = table([texts.signal, said.largest, said.first, said.sets], said.signals);
    others.body.append(...signals.map((signal) => this.#signalRow(signal)));
    this.result.append(others.root);
  }

  #alarmRow({ name, was_watched: wasWatched, is_watched: isWatched, differs, recorded, computed, more }) {
    const said = texts.recordings.replays, figure = name.slice(name.lastIndexOf(": ") + 2);
    const cell = (isThere, raised) => element("td", {}, ...(!isThere ? [said.absent]
      : raised.length === 0 ? [said.never] : raised.map((one) => this.#raised(one))));
    return element("tr", { className: differs ? "differs" : "" },
      element("th", { scope: "row" }, ...titled(name, this.#figures.regions?.[figure])),
      cell(wasWatched, recorded), element("td", {}, ...cell(isWatched, computed).childNodes,
        more > 0 ? ` ${said.more(more)}` : ""));
  }

  #raised({ level_text: level, from, to }) {
    const said = texts.recordings.replays;
    return this.#link(from, said.raised(level, this.#offsetOf(from), this.#offsetOf(to)));
  }

  #signalRow({ region, figure, unit, sets, largest, recorded, computed, largest_at: largestAt, first_at: firstAt }) {
    const said = texts.recordings.replays;
    const values = said.values(amountText(recorded, unit), amountText(computed, unit));
    return element("tr", {},
      element("th", { scope: "row" }, `${region}: `, ...titled(figure, this.#figures.regions?.[figure])),
      element("td", {}, this.#link(largestAt, largest === null ? values : `${amountText(largest, unit)} (${values})`)),
      element("td", {}, this.#link(firstAt, `${this.#offsetOf(firstAt)} s`)),
      element("td", { className: "figure" }, String(sets)));
  }

  // Shows the moment when it is pressed.
  #link(time, label) {
    return button(label, () => this.choose(Date.parse(time)));
  }

  #offsetOf(time) {
    const { triggered, first } = this.#event;
    return decimalText((Date.parse(time) - Date.parse(triggered || first)) / 1000, kDigits);
  }
}
