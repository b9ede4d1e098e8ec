// SPDX-License-Identifier: Apache-2.0
// Events of alarms, kept by the appliance.
import { amountText } from "../elements/amounts.js";
import { momentText, timeZone } from "../elements/clock.js";
import { element, table } from "../elements/elements.js";
import { parsed, texts } from "../texts.js";

export class AlarmHistory {
  #count = null;  // number of all events at the last request

  constructor() {
    this.none = element("p", {}, texts.noAlarmEvents);
    this.titles = [texts.when(timeZone), texts.alarm, texts.event, texts.level, texts.value, texts.limit, texts.who];
    const { root: scrolled, body } = table(this.titles, texts.alarmHistory);
    this.table = scrolled;
    this.body = body;
    this.table.classList.add("cards");
    this.root = element("details", { id: "alarm-history" }, element("summary", {}, texts.alarmHistory),
      this.none, this.table);
    this.#show([]);
  }

  // Requests them if there are newer ones than shown; `count`: number of all since the start.
  async refresh(count) {
    if (count === this.#count) return;
    this.#count = count;
    const answer = await fetch("api/v1/history/alarms").catch(() => null);
    const read = answer?.ok ? await answer.text().then(parsed).catch(() => null) : null;
    if (count !== this.#count) return; // a newer request counts
    if (read) this.#show(read.alarms.reverse());
    else this.#count = null;
  }

  // The appliance may restart, and then counts from 0 again.
  lost() {
    this.#count = null;
  }

  #show(events) {
    this.none.hidden = events.length > 0;
    this.table.hidden = events.length === 0;
    this.body.replaceChildren(...events.map((event) => {
      const cells = [momentText(event.time), event.name, event.event_text, event.level_text,
        amountText(event.value, event.unit), amountText(event.limit, event.unit), event.by ?? ""];
      return element("tr", {}, ...cells.map((text, n) => element("td", { "data-title": this.titles[n] }, text)));
    }));
  }
}
