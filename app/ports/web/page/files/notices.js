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

function show(notice, text) {
  setText(notice, text);
  notice.hidden = text === "";
}

// The trial that runs, with its end, for users who look at other pages meanwhile. Screen readers announce it once, and
// not each second of its countdown, which is therefore outside the notices.
class TrialNotice {
  // `mayEnd`: the user may end it here.
  constructor(mayEnd) {
    this.announced = element("p", { className: "spoken" });
    this.left = element("span", { className: "wrong", role: "timer" });
    this.said = element("span", { className: "wrong", role: "alert" });
    const buttons = mayEnd
      ? trialEnds((refused) => setText(this.said, refused ? texts.refused(refused) : "")) : [];
    this.root = element("p", { id: "trial", hidden: true }, this.left, ...buttons.flatMap((one) => [" ", one]), " ",
      this.said);
  }

  show(seconds) {
    const runs = seconds > 0;
    this.root.hidden = !runs;
    setText(this.announced, runs ? texts.notices.onTrial : "");
    setText(this.left, runs ? texts.notices.trial(seconds) : "");
    if (!runs) setText(this.said, "");
  }
}

export class Notices {
  #count = 0; // raised alarms
  #silence = ""; // reason why the status is not renewed; empty: it is

  // `links`: those of the navigation by page; a notice is a link where its page is among them. `mayChange`: the user
  // may end a trial.
  constructor(root, recipe, links, mayChange) {
    Object.assign(this, { links });
    this.recipe = element("p", { className: "quiet" });
    this.alarms = this.#notice("process");
    this.alignment = this.#notice("align");
    this.configuration = this.#notice("system");
    this.machine = this.#notice("system");
    this.power = this.#notice("system");
    this.trial = new TrialNotice(mayChange && links.has("system"));
    root.append(this.recipe, this.alarms, this.alignment, this.configuration, this.machine, this.power,
      this.trial.announced);
    root.after(this.trial.root);
    recipe.addEventListener("change", () => setText(this.recipe, texts.notices.recipe(recipe.stated)));
    addEventListener("hashchange", () => this.#entitle());
    this.#entitle();
  }

  #notice(page) {
    const properties = { className: "wrong", hidden: true };
    return this.links.has(page) ? element("a", { href: `#/${page}`, ...properties }) : element("span", properties);
  }

  // `silence`: reason why the pipeline's last status is repeated; empty: it is a new one.
  status({ alarms = [], cameras, health, machine, system }, silence) {
    show(this.machine, isMachineFault(machine) ? texts.notices.machine : "");
    show(this.power, powerNotice(health));
    show(this.configuration, system.configuration_refused ? texts.notices.refused : "");
    this.trial.show(system.trial_left);
    const raised = raisedAlarms(alarms);
    show(this.alarms, raised.length === 0 ? ""
      : texts.notices.alarms(raised.length, raised[0].name, raised[0].state_text));
    show(this.alignment, cameras.map(alignmentNotice).filter(Boolean).join(". "));
    this.#count = raised.length;
    this.silent(silence);
  }

  // States in the title why the status is not renewed; empty: it is.
  silent(why) {
    this.#silence = why;
    this.#entitle();
  }

  // The document's title and the badge of the page with the alarms. Alarms of an old status are not counted.
  #entitle() {
    const [shown] = [...this.links].find(([, link]) => link.ariaCurrent === "page") ?? ["live"];
    const count = this.#silence ? 0 : this.#count;
    const title = [this.#silence, texts.notices.title(texts.pages[shown], count)].filter(Boolean).join(" – ");
    if (document.title !== title) document.title = title;
    const link = this.links.get("process"); // none on the screen of the panel
    if (link) setText(link, texts.notices.badge(texts.pages.process, count));
  }
}
