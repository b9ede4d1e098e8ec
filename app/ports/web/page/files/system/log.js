// SPDX-License-Identifier: Apache-2.0
// The newest lines of the appliance's log, updated while the page is shown, filtered by severity and text.
import { patience } from "../appliance/api.js";
import { Card } from "../elements/card.js";
import { momentText, timeZone } from "../elements/clock.js";
import { downloadLink } from "../elements/download.js";
import { element, setText, table } from "../elements/elements.js";
import { texts } from "../texts.js";

const kAgainMs = 1000;
const kMostLines = 1000; // as many as the appliance keeps
const kLevels = ["info", "warning", "error"]; // ascending

export class Log {
  #started = ""; // start of the program that wrote the lines
  #newest = 0;   // number of the newest line, counted from that start
  #lines = []; // {line, row}, the newest first
  #isReading = false;

  // `isShown()`: the page is visible.
  constructor(isShown) {
    this.isShown = isShown;
    this.said = element("p", { role: "status", className: "wrong" });
    this.level = element("select", { name: "level" }, ...kLevels.map((level) => element("option", {}, level)));
    this.wanted = element("input", { type: "search", name: "wanted" });
    this.level.addEventListener("change", () => this.#filter());
    this.wanted.addEventListener("input", () => this.#filter());
    this.table = table([texts.when(timeZone), texts.level, texts.what], texts.log);
    this.card = new Card("log", texts.log);
    this.card.append(element("p", { className: "buttons" },
      element("label", {}, texts.leastLevel, " ", this.level), element("label", {}, texts.filter, " ", this.wanted),
      downloadLink("orbwatch.log", () => this.text)), this.said, this.table.root);
    this.root = this.card.root;
    setInterval(() => this.#read(), kAgainMs);
    addEventListener("hashchange", () => this.#read());
    this.#read();
  }

  // The lines that are shown, the oldest first.
  get text() {
    return this.#lines.filter(({ row }) => !row.hidden).reverse()
      .map(({ line: { time, level, text } }) => `${time} ${level} ${text}\n`).join("");
  }

  async #read() {
    if (this.#isReading || document.hidden || !this.isShown()) return;
    this.#isReading = true;
    const query = new URLSearchParams({ lines: kMostLines, after: this.#newest });
    const answer = await fetch(`api/v1/log?${query}`, patience()).catch(() => null);
    const read = await answer?.json().catch(() => null);
    setText(this.said, read?.error ? texts.refused(read.error) : "");
    if (read?.lines) this.#show(read);
    this.#isReading = false;
  }

  // The newest lines are on top. Lines after a restart were asked for by a number of the program before: the next
  // request has them all.
  #show({ started, lines, newest }) {
    const isRestarted = started !== this.#started && this.#newest > 0;
    this.#started = started;
    if (isRestarted) return this.#clear();
    this.#newest = newest;
    for (const line of lines) this.#add(line);
    for (const { row } of this.#lines.splice(kMostLines)) row.remove();
    this.#summarize();
  }

  #clear() {
    this.#newest = 0;
    this.#lines = [];
    this.table.body.replaceChildren();
  }

  #add(line) {
    const row = element("tr", { className: line.level }, element("td", {}, momentText(line.time)),
      element("td", {}, line.level), element("td", {}, line.text));
    row.hidden = !this.#isWanted(line);
    this.#lines.unshift({ line, row });
    this.table.body.prepend(row);
  }

  #isWanted({ level, text }) {
    return kLevels.indexOf(level) >= this.level.selectedIndex
      && text.toLowerCase().includes(this.wanted.value.toLowerCase());
  }

  #filter() {
    for (const { line, row } of this.#lines) row.hidden = !this.#isWanted(line);
  }

  #summarize() {
    const count = (level) => this.#lines.filter(({ line }) => line.level === level).length;
    this.card.say(texts.cards.log(count("error"), count("warning")), count("error") > 0);
  }
}
