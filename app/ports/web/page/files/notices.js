// SPDX-License-Identifier: Apache-2.0
// Header of all pages: the recipe, and what needs a person: alarms that stand or are not acknowledged, and cameras
// that are not aligned.
import { element, setText } from "./elements/elements.js";
import { texts } from "./texts.js";

// Numbers of proc/signals/alarm.h and app/model/status/watch_status.h, which stay the same.
const kNormal = 0, kSuppressed = 6;
const kAlarmLevels = [1, 4, 5], kWarningLevels = [2, 3];
const kMoved = [2, 3], kNotRegistered = 4;
const kNotAligned = 2;

function severity({ level, announced }) {
  const isAmong = (levels) => levels.includes(level) || levels.includes(announced);
  return isAmong(kAlarmLevels) ? 2 : isAmong(kWarningLevels) ? 1 : 0;
}

// Alarms that stand or are not acknowledged, the worst first.
function raisedAlarms(alarms) {
  return alarms.filter(({ state }) => state !== kNormal && state !== kSuppressed)
    .sort((one, other) => severity(other) - severity(one));
}

function alignmentNotice({ name, alignment, outline_check: check, outline_offset: percent }) {
  if (alignment === kNotRegistered) return texts.notices.notRegistered(name);
  if (check === kNotAligned) return texts.notices.notAligned(name, percent);
  return kMoved.includes(alignment) ? texts.notices.moved(name) : "";
}

function notice(page) {
  return element("a", { href: `#/${page}`, className: "wrong", hidden: true });
}

function show(link, text) {
  setText(link, text);
  link.hidden = text === "";
}

export class Notices {
  #count = 0; // raised alarms

  // `links`: those of the navigation by page.
  constructor(root, recipe, links) {
    Object.assign(this, { links });
    this.recipe = element("p", { className: "quiet" });
    this.alarms = notice("process");
    this.alignment = notice("align");
    root.append(this.recipe, this.alarms, this.alignment);
    recipe.addEventListener("change", () => setText(this.recipe, texts.notices.recipe(recipe.stated)));
    addEventListener("hashchange", () => this.#entitle());
    this.#entitle();
  }

  status({ alarms = [], cameras }) {
    const raised = raisedAlarms(alarms);
    show(this.alarms, raised.length === 0 ? ""
      : texts.notices.alarms(raised.length, raised[0].name, raised[0].state_text));
    show(this.alignment, cameras.map(alignmentNotice).filter(Boolean).join(". "));
    if (raised.length === this.#count) return;
    this.#count = raised.length;
    this.#entitle();
  }

  // The document's title and the badge of the page with the alarms.
  #entitle() {
    const [shown] = [...this.links].find(([, link]) => link.ariaCurrent === "page") ?? ["live"];
    document.title = texts.notices.title(texts.pages[shown], this.#count);
    setText(this.links.get("process"), texts.notices.badge(texts.pages.process, this.#count));
  }
}
