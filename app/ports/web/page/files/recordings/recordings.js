// SPDX-License-Identifier: Apache-2.0
// Events with the cameras' pictures from before and after a trigger, kept by the recorder.
import { command, post } from "../appliance/api.js";
import { decimalText } from "../elements/amounts.js";
import { Cards } from "../elements/cards.js";
import { momentText, timeZone } from "../elements/clock.js";
import { button, element, setText } from "../elements/elements.js";
import { parsed, texts } from "../texts.js";
import { causeText } from "./cause.js";
import { Viewer } from "./viewer.js";

const kAgainMs = 2000;
const kTypingMs = 200; // from the last key to the request
const kPage = 100; // events
const kMost = 1000; // that the appliance sends at once
const kKinds = ["alarm", "command", "laser_on", "layer", "line"];
const kMebibyte = 2 ** 20;

const pathOf = (file, name) => `api/v1/recordings/${file}?${new URLSearchParams({ event: name })}`;

// One event, updated in place. `change(path, body)` requests a change, `look(event, title)` shows its pictures;
// `signals`: descriptions by name.
class Card {
  #event = null;

  constructor({ name }, { change, look }, may, signals) {
    const said = texts.recordings;
    Object.assign(this, { name, signals });
    this.picture = element("img", { width: 160, loading: "lazy", hidden: true });
    this.cause = element("h3");
    this.when = element("p");
    this.machine = element("p");
    this.about = element("p", { className: "quiet" });
    this.wrong = element("p", { className: "wrong" });
    this.look = button(said.look, () => look(this.#event, this.cause.textContent));
    this.pin = button("", () => change("pin_recording", { event: name, is_pinned: !this.isPinned }));
    this.save = element("a", { className: "button", download: `${name}.mcap`, href: pathOf("event.mcap", name) },
      texts.download);
    const remove = button(texts.remove, () =>
      confirm(said.removeAsks(this.cause.textContent)) && change("remove_recording", { event: name }));
    this.root = element("li", { className: "appliance" }, this.picture,
      element("div", {}, this.cause, this.when, this.machine, this.wrong, this.about,
        element("p", { className: "buttons" }, this.look, may("operator") ? this.pin : "", this.save,
          may("integrator") ? remove : "")));
  }

  show(event) {
    const said = texts.recordings, moment = Date.parse(event.triggered || event.first);  // NaN without a summary
    this.#event = event;
    this.isPinned = event.is_pinned;
    setText(this.cause, causeText(event, this.signals));
    setText(this.when, moment ? momentText(moment) : "");
    setText(this.machine, said.machine(event.part, event.layer));
    setText(this.about, said.about(event.pictures, decimalText(event.bytes / kMebibyte, 1)));
    setText(this.wrong, [event.is_finished ? "" : said.unfinished, event.is_interrupted ? said.interrupted : "",
      event.has_beginning ? "" : said.noBeginning, event.lost > 0 ? said.lost(event.lost) : ""]
      .filter(Boolean).join(" "));
    setText(this.pin, event.is_pinned ? said.unpin : said.pin);
    this.look.disabled = this.pin.disabled = !event.is_finished;
    this.save.hidden = !event.is_finished;
    if (event.is_finished && this.picture.hidden) this.#showPicture();
  }

  #showPicture() {
    this.picture.hidden = false;
    this.picture.alt = texts.recordings.picture(this.cause.textContent);
    this.picture.addEventListener("error", () => { this.picture.hidden = true; }, { once: true });
    this.picture.src = pathOf("trigger.jpg", this.name);
  }
}

export class Recordings {
  #cards;
  #limit = kPage;
  #address = ""; // of the list that is shown
  #tag = ""; // of that list
  #again = 0;

  // `figures`: descriptions of figures by kind of component. `may(role)`: true if the user may do what the role may.
  constructor(root, figures, may) {
    this.root = root;
    this.said = element("p", { role: "status" });
    this.refused = element("p", { role: "alert", className: "wrong" });
    this.record = button(texts.recordings.record, () => this.#tell(command("record_event", {})));
    this.kind = element("select", { name: "kind" }, element("option", { value: "" }, texts.recordings.all),
      ...kKinds.map((kind) => element("option", { value: kind }, texts.recordings.kinds[kind])));
    this.part = element("input", { name: "part", type: "search" });
    this.layer = element("input", { name: "layer", type: "number", step: 1 });
    this.since = element("input", { name: "since", type: "datetime-local" });
    this.until = element("input", { name: "until", type: "datetime-local" });
    this.filters = element("form", { className: "buttons" },
      ...[["kind", this.kind], ["part", this.part], ["layer", this.layer]].map(([name, input]) =>
        element("label", {}, texts.recordings.filters[name], " ", input)),
      ...[["since", this.since], ["until", this.until]].map(([name, input]) =>
        element("label", {}, texts.recordings.filters[name](timeZone), " ", input)));
    this.filters.addEventListener("input", () => this.#search());
    this.filters.addEventListener("submit", (event) => event.preventDefault());
    this.list = element("ul", { id: "events" });
    this.more = button(texts.recordings.more, () => this.#showMore());
    this.narrow = element("p", { className: "quiet", hidden: true }, texts.recordings.narrow(kMost));
    this.viewer = new Viewer(figures);
    const asked = {
      change: (path, body) => this.#tell(post(`api/v1/${path}`, body)),
      look: (event, title) => this.viewer.open(event, title),
    };
    this.#cards = new Cards(this.list, ({ name }) => name, (event) => new Card(event, asked, may, figures.regions));
    root.append(this.viewer.root, element("p", { className: "buttons" }, may("operator") ? this.record : ""),
      this.filters, this.said, this.refused, this.list, this.more, this.narrow);
    this.more.hidden = true;
    addEventListener("hashchange", () => this.#read());
    this.#read();
  }

  async #tell(done) {
    const why = await done;
    setText(this.refused, why ? texts.refused(why) : "");
    this.#read();
  }

  #search() {
    this.#limit = kPage;
    clearTimeout(this.#again);
    this.#again = setTimeout(() => this.#read(), kTypingMs);
  }

  #showMore() {
    this.#limit = Math.min(this.#limit + kPage, kMost);
    this.#read();
  }

  // Address of the events that the filters leave.
  #wanted() {
    const moment = ({ value }) => (value ? new Date(value).toISOString() : "");
    const asked = { trigger: this.kind.value, part: this.part.value.trim(), layer: this.layer.value,
      from: moment(this.since), to: moment(this.until), limit: this.#limit };
    return `api/v1/recordings?${new URLSearchParams(Object.entries(asked).filter(([, value]) => value !== ""))}`;
  }

  async #read() {
    clearTimeout(this.#again);
    if (this.root.hidden) return;
    const address = this.#wanted();
    const tag = address === this.#address ? this.#tag : "";
    const answer = document.hidden ? null
      : await fetch(address, { headers: tag ? { "If-None-Match": tag } : {} }).catch(() => null);
    if (address !== this.#wanted()) return; // its answer is awaited
    if (answer && answer.status !== 304) await this.#take(answer, address);
    clearTimeout(this.#again);
    this.#again = setTimeout(() => this.#read(), kAgainMs);
  }

  // A list that differs, or the reason why there is none.
  async #take(answer, address) {
    const read = await answer.text().then(parsed).catch(() => null);
    this.#address = address;
    this.#tag = read?.events ? answer.headers.get("ETag") ?? "" : "";
    if (read?.error) setText(this.said, texts.refused(read.error));
    else if (read?.missing) setText(this.said, texts.recordings.missing(read.missing));
    else if (read) this.#show(read);
    this.record.hidden = this.filters.hidden = Boolean(read?.missing);
  }

  #show({ events, matching, total, has_older: hasOlder }) {
    setText(this.said, texts.recordings.count(matching, total));
    this.#cards.show(events);
    this.more.hidden = !hasOlder || this.#limit === kMost;
    this.narrow.hidden = !hasOlder || this.#limit < kMost;
  }
}
