// SPDX-License-Identifier: Apache-2.0
// All appliances of the DDS domain, updated while shown.
import { patience, post } from "../appliance/api.js";
import { Cards } from "../elements/cards.js";
import { momentText } from "../elements/clock.js";
import { element, setText } from "../elements/elements.js";
import { texts, translated } from "../texts.js";

const kAgainMs = 1000;

// The appliance writes an alarm as "name: level, state".
const alarmText = (alarm) => alarm?.replace(/: ([a-z ]+), (.+)$/,
  (_, level, state) => `: ${translated(level)}, ${translated(state)}`);

// One appliance, updated in place.
class Card {
  #shown = 0;  // number of the displayed picture

  constructor() {
    this.picture = element("img", { alt: "", width: 160, hidden: true });
    this.link = element("a", { rel: "noreferrer" });
    this.name = element("span");
    this.self = element("span", { className: "quiet" });
    this.state = element("p");
    this.alarm = element("p");
    this.about = element("p", { className: "quiet" });
    this.root = element("li", { className: "appliance" }, this.picture,
      element("div", {}, element("h3", {}, this.link, this.name, " ", this.self), this.state,
        this.alarm, this.about));
  }

  show(appliance) {
    const { name, page, condition, severity, version, prefix } = appliance;
    setText(this.link, page ? name : "");
    if (page) this.link.href = page;
    else this.link.removeAttribute("href");
    setText(this.name, page ? "" : name);
    setText(this.self, appliance.is_self ? texts.fleet.self : "");
    const isGone = appliance.is_gone;
    setText(this.state, isGone ? texts.fleet.gone(momentText(appliance.newest)) : translated(condition));
    this.state.classList.toggle("wrong", isGone || severity !== 0);
    setText(this.alarm, texts.fleet.alarms(appliance.alarms, alarmText(appliance.alarm)));
    this.alarm.classList.toggle("wrong", !isGone && appliance.alarms > 0);
    setText(this.about, texts.fleet.about(version, prefix));
    this.#showPicture(appliance);
  }

  #showPicture({ id, name, pictures }) {
    if (pictures === this.#shown) return;
    this.#shown = pictures;
    this.picture.hidden = pictures === 0;
    this.picture.alt = texts.fleet.picture(name);
    const query = new URLSearchParams({ appliance: id, number: pictures });
    this.picture.src = `api/v1/appliances/picture.jpg?${query}`;
  }
}

export class Fleet {
  #cards;
  #again = 0;

  constructor(root, mayForget) {
    this.root = root;
    this.said = element("p", { role: "status" });
    this.refused = element("p", { role: "alert", className: "wrong" }); // `said` is written anew each second
    this.list = element("ul", { id: "appliances" });
    this.#cards = new Cards(this.list, ({ id }) => id, () => new Card());
    this.forget = element("button", { type: "button", hidden: true }, texts.fleet.forget);
    this.forget.addEventListener("click", () => this.#forget());
    root.append(this.said, this.refused, this.list, mayForget ? this.forget : "");
    addEventListener("hashchange", () => this.#read());
    this.#read();
  }

  async #forget() {
    const refused = await post("api/v1/forget_appliances", {});
    setText(this.refused, refused && texts.refused(refused));
    if (!refused) this.#read();
  }

  async #read() {
    clearTimeout(this.#again);
    if (this.root.hidden) return;
    const answer = document.hidden ? null : await fetch("api/v1/appliances", patience()).catch(() => null);
    const read = await answer?.json().catch(() => null);
    if (read?.error) setText(this.said, texts.refused(read.error));
    else if (read?.missing) setText(this.said, texts.fleet.missing(read.missing));
    else if (read) this.#show(read);
    clearTimeout(this.#again);
    this.#again = setTimeout(() => this.#read(), kAgainMs);
  }

  #show({ appliances, turned_away: turnedAway }) {
    const gone = appliances.filter((one) => one.is_gone).length;
    const alarming = appliances.filter((one) => !one.is_gone && one.alarms > 0).length;
    setText(this.said, texts.fleet.count(appliances.length, gone, alarming, turnedAway > 0));
    this.forget.hidden = gone === 0;
    this.#cards.show(appliances);
  }
}
