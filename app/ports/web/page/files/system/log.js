// SPDX-License-Identifier: Apache-2.0
// The newest lines of the appliance's log, updated while shown.
import { momentText, timeZone } from "../elements/clock.js";
import { element, setText, table } from "../elements/elements.js";
import { texts } from "../texts.js";

const kAgainMs = 1000;
const kMostShown = 500;
const kLevels = ["info", "warning", "error"];

export class Log {
  #newest = 0;
  #again = 0;
  #asked = 0;  // request number, so that answers for another level are ignored

  constructor(root) {
    this.said = element("p", { role: "status", className: "wrong" });
    this.level = element("select", { name: "level" },
      ...kLevels.map((level) => element("option", {}, level)));
    this.level.addEventListener("change", () => this.#begin());
    this.lines = table([texts.when(timeZone), texts.level, texts.what], texts.log);
    this.opened = element("details", { id: "log" }, element("summary", {}, texts.log),
      element("label", {}, texts.leastLevel, " ", this.level), this.said, this.lines.root);
    this.opened.addEventListener("toggle", () => this.#begin());
    root.append(this.opened);
  }

  #begin() {
    this.#newest = 0;
    this.lines.body.replaceChildren();
    this.#read(++this.#asked);
  }

  async #read(asked) {
    clearTimeout(this.#again);
    if (!this.opened.open || asked !== this.#asked) return;
    const query = new URLSearchParams({
      lines: kMostShown, level: this.level.value, after: this.#newest });
    const answer = document.hidden ? null : await fetch(`api/v1/log?${query}`).catch(() => null);
    const read = await answer?.json().catch(() => null);
    if (asked !== this.#asked) return;
    setText(this.said, read?.error ? texts.refused(read.error) : "");
    if (read?.lines) this.#show(read);
    this.#again = setTimeout(() => this.#read(asked), kAgainMs);
  }

  // The newest lines are on top. After a restart the appliance counts from 1 again.
  #show({ lines, newest }) {
    if (newest < this.#newest) return this.#begin();
    for (const line of lines) {
      this.lines.body.prepend(element("tr", { className: line.level },
        element("td", {}, momentText(line.time)), element("td", {}, line.level),
        element("td", {}, line.text)));
    }
    this.#newest = newest;
    while (this.lines.body.rows.length > kMostShown) this.lines.body.deleteRow(-1);
  }
}
