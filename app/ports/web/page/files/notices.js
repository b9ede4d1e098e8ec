// SPDX-License-Identifier: Apache-2.0
// Header of all pages: the recipe, and what needs a person: alarms that stand or are not acknowledged, cameras
// that are not aligned, a configuration that is on trial or refused.
import { post } from "./appliance/api.js";
import { element, setText } from "./elements/elements.js";
import { texts } from "./texts.js";

// Numbers of proc/signals/alarm.h and app/model/status/watch_status.h, which stay the same.
const kNormal = 0, kSuppressed = 6;
const kAlarmLevels = [1, 4, 5], kWarningLevels = [2, 3];
const kMoved = [2, 3], kNotRegistered = 4;
const kNotAligned = 2;

export function severity({ level, announced }) {
  const isAmong = (levels) => levels.includes(level) || levels.includes(announced);
  return isAmong(kAlarmLevels) ? 2 : isAmong(kWarningLevels) ? 1 : 0;
}

// Alarms that stand or are not acknowledged, the worst first.
export function raisedAlarms(alarms) {
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

// The trial that runs, with its end: a person looks at other pages meanwhile.
class TrialNotice {
  constructor(mayChange) {
    this.text = element("span", { className: "wrong" });
    this.said = element("span", { className: "wrong" });
    const buttons = mayChange ? [this.#button("confirm", texts.confirmFiles),
      this.#button("revert", texts.revertFiles)] : [];
    this.root = element("p", { hidden: true }, this.text, ...buttons.flatMap((one) => [" ", one]), " ",
      this.said);
  }

  show(seconds) {
    this.root.hidden = seconds === 0;
    setText(this.text, seconds > 0 ? texts.notices.trial(seconds) : "");
    if (seconds === 0) setText(this.said, "");
  }

  #button(what, label) {
    const button = element("button", { type: "button" }, label);
    button.addEventListener("click", async () => {
      const refused = await post(`api/v1/${what}_configuration`, {});
      setText(this.said, refused ? texts.refused(refused) : "");
    });
    return button;
  }
}

export class Notices {
  #count = 0; // raised alarms

  // `links`: those of the navigation by page. `mayChange`: the user may end a trial.
  constructor(root, recipe, links, mayChange) {
    Object.assign(this, { links });
    this.recipe = element("p", { className: "quiet" });
    this.alarms = notice("process");
    this.alignment = notice("align");
    this.configuration = notice("system");
    this.trial = new TrialNotice(mayChange);
    root.append(this.recipe, this.alarms, this.alignment, this.configuration, this.trial.root);
    recipe.addEventListener("change", () => setText(this.recipe, texts.notices.recipe(recipe.stated)));
    addEventListener("hashchange", () => this.#entitle());
    this.#entitle();
  }

  status({ alarms = [], cameras, system }) {
    show(this.configuration, system.configuration_refused ? texts.notices.refused : "");
    this.trial.show(system.trial_left);
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
