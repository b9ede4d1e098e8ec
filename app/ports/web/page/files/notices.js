// SPDX-License-Identifier: Apache-2.0
// Header of all pages: the recipe, and what needs a person: alarms that stand or are not acknowledged, cameras
// that are not aligned, a machine whose state is not known, a board whose supply is too weak or that is too hot, a
// configuration that is on trial or refused.
import { raisedAlarms } from "./appliance/alarms.js";
import { isMachineFault } from "./appliance/faults.js";
import { element, setText } from "./elements/elements.js";
import { trialEnds } from "./system/trial_end.js";
import { texts } from "./texts.js";

// Numbers of app/model/status/watch_status.h, which stay the same.
const kMoved = [2, 3], kNotRegistered = 4;
const kNotAligned = 2;
// Bits of Throttling in app/model/status/health.h, those that apply now.
const kUnderVoltage = 1, kSlowedDown = 14;

function alignmentNotice({ name, alignment, outline_check: check, outline_offset: percent }) {
  if (alignment === kNotRegistered) return texts.notices.notRegistered(name);
  if (check === kNotAligned) return texts.notices.notAligned(name, percent);
  return kMoved.includes(alignment) ? texts.notices.moved(name) : "";
}

function powerNotice({ throttling }) {
  if (throttling & kUnderVoltage) return texts.notices.underVoltage;
  return throttling & kSlowedDown ? texts.notices.throttled : "";
}

function notice(page) {
  return element("a", { href: `#/${page}`, className: "wrong", hidden: true });
}

function show(link, text) {
  setText(link, text);
  link.hidden = text === "";
}

// The trial that runs, with its end, for users who look at other pages meanwhile.
class TrialNotice {
  constructor(mayChange) {
    this.text = element("span", { className: "wrong" });
    this.said = element("span", { className: "wrong" });
    const buttons = mayChange
      ? trialEnds((refused) => setText(this.said, refused ? texts.refused(refused) : "")) : [];
    this.root = element("p", { hidden: true }, this.text, ...buttons.flatMap((one) => [" ", one]), " ",
      this.said);
  }

  show(seconds) {
    this.root.hidden = seconds === 0;
    setText(this.text, seconds > 0 ? texts.notices.trial(seconds) : "");
    if (seconds === 0) setText(this.said, "");
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
    this.machine = notice("system");
    this.power = notice("system");
    this.trial = new TrialNotice(mayChange);
    root.append(this.recipe, this.alarms, this.alignment, this.configuration, this.machine, this.power,
      this.trial.root);
    recipe.addEventListener("change", () => setText(this.recipe, texts.notices.recipe(recipe.stated)));
    addEventListener("hashchange", () => this.#entitle());
    this.#entitle();
  }

  status({ alarms = [], cameras, health, machine, system }) {
    show(this.machine, isMachineFault(machine) ? texts.notices.machine : "");
    show(this.power, powerNotice(health));
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
    const link = this.links.get("process"); // none on the screen of the panel
    if (link) setText(link, texts.notices.badge(texts.pages.process, this.#count));
  }
}
