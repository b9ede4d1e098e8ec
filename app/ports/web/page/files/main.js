// SPDX-License-Identifier: Apache-2.0
import { Align } from "./align/align.js";
import { describeAppliance } from "./appliance/api.js";
import { AskedWidths } from "./appliance/asked_widths.js";
import { Faults } from "./appliance/faults.js";
import { PageVersion } from "./appliance/page_version.js";
import { isSilent, withoutFigures } from "./appliance/silence.js";
import { Stream } from "./appliance/stream.js";
import { Views } from "./appliance/views.js";
import { element, setText } from "./elements/elements.js";
import { languageChoice } from "./elements/language_choice.js";
import { Live } from "./live/live.js";
import { Look } from "./look/look.js";
import { Notices } from "./notices.js";
import { Operator } from "./process/operator.js";
import { Process } from "./process/process.js";
import { Recipe } from "./process/recipe.js";
import { Recordings } from "./recordings/recordings.js";
import { admit, askAgain } from "./system/access.js";
import { Fleet } from "./system/fleet.js";
import { System } from "./system/system.js";
import { parsed, texts } from "./texts.js";

const kRetryMs = 500;
const condition = document.getElementById("condition");

function say(text, isWrong) {
  setText(condition, text);
  condition.classList.toggle("wrong", isWrong);
}

// Returns the links of the navigation by page.
function addTabs() {
  const links = new Map();
  for (const { name } of tabs) {
    const title = texts.pages[name];
    const heading = element("h2", { id: `${name}-title` }, title);
    const labelled = { id: name, "aria-labelledby": heading.id, hidden: true };
    document.querySelector("main").append(element("section", labelled, heading));
    links.set(name, element("a", { href: `#/${name}` }, title));
  }
  document.getElementById("nav").append(...links.values());
  const turn = () => {
    const asked = location.hash.slice(2);
    const shown = links.has(asked) ? asked : tabs[0].name;
    for (const [name, link] of links) {
      document.getElementById(name).hidden = name !== shown;
      if (name === shown) link.setAttribute("aria-current", "page");
      else link.removeAttribute("aria-current");
    }
  };
  addEventListener("hashchange", turn);
  turn();
  return links;
}

// Retries for ever, because the appliance may start later than the page.
async function describedAppliance() {
  for (;;) {
    try {
      return await describeAppliance();
    } catch {
      say(texts.connecting, true);
      await new Promise((resolve) => setTimeout(resolve, kRetryMs));
    }
  }
}

// `silence`: reason why the status is old; `refused`: reason why views are not sent; empty: none.
function showCondition({ state, state_text: text }, silence, refused) {
  const isRight = !silence && !refused && state === figures.system.state.codes.running;
  say([silence || text, refused && texts.refused(refused)].filter(Boolean).join(". "), !isRight);
}

// Tabs in the order of the navigation. The object that make() returns may have status(status, now), which has as
// `silence` the reason why nothing is measured, empty: it is; picture(); lost(why); views, each with the width in which
// it is displayed, device px, 0: in full; and isChanged: it has changes that are not sent.
const kTabs = [
  { name: "live", make: (section) => new Live(section, views, faults, choose, isAtLeast("operator")) },
  { name: "look", make: (section) => new Look(section, faults, choose) },
  { name: "align", make: (section) => new Align(section, faults, figures.cameras, isAtLeast) },
  { name: "process", make: (section) => new Process(section, faults, recipe, figures, isAtLeast, choose) },
  { name: "recordings", make: (section) => new Recordings(section, figures, isAtLeast) },
  { name: "system", make: (section) => new System(section, views, recipe, figures, session) },
  { name: "fleet", make: (section) => new Fleet(section, isAtLeast("operator")) },
];
// The only one at the address /operator.
const kOperator = { name: "operator",
  make: (section) => new Operator(section, faults, recipe, figures, isAtLeast("operator"), choose) };
const isOperator = location.pathname.endsWith("/operator");
const tabs = isOperator ? [kOperator] : kTabs;
document.body.classList.toggle("operator", isOperator);

document.getElementById("account").after(languageChoice());
document.getElementById("nav").ariaLabel = texts.navigation;
const session = await admit((why) => say(why, why !== ""));
// True: the user of the page may do what this role may.
const isAtLeast = (role) => session.roles.includes(role);
const links = addTabs();
const views = new Views(), faults = new Faults(views), recipe = new Recipe();
const notices = new Notices(document.getElementById("notices"), recipe, links,
  isAtLeast("integrator"));
const { version, figures } = await describedAppliance();
const made = [];
const hasUnsent = () => made.some((tab) => tab.isChanged);
const pageVersion = new PageVersion(version, () => !hasUnsent());
// The shown tab with pictures of views, if any.
const shown = () => made.find((tab) => tab.views && tab.isShown);
const widths = new AskedWidths(views);
const choose = () => stream.choose(widths.of(shown()?.views ?? []));
for (const { name, make } of tabs) made.push(make(document.getElementById(name)));

function showStatus(status, received) {
  const silence = isSilent(status) ? texts.silent : "";
  document.body.classList.toggle("stale", silence !== "");
  showCondition(status.system, silence, stream.refused);
  views.status();
  pageVersion.status();
  faults.status(status);
  recipe.status(status);
  notices.status(status, silence);
  const measured = silence ? withoutFigures(status) : status;
  for (const tab of made) tab.status?.({ ...measured, silence }, received);
}

// The appliance may restart before the next status: what is known may be old then.
function showLoss(why) {
  document.body.classList.add("stale");
  views.lost();
  pageVersion.lost();
  for (const tab of made) tab.lost?.(why);
}

const stream = new Stream({
  onMessage: (message) => {
    if (message.head.kind === "view") shown()?.picture(message);
    else showStatus(parsed(new TextDecoder().decode(message.body)), message.received);
  },
  onLost: (refused) => {
    const why = refused ? texts.refused(refused) : texts.connecting;
    say(why, true);
    notices.silent(why);
    showLoss(why);
    askAgain();
  },
  onPaused: () => showLoss(texts.connecting),
});
addEventListener("hashchange", choose);
views.addEventListener("change", choose);
// The browser asks before unsent changes are lost.
addEventListener("beforeunload", (event) => {
  if (hasUnsent()) event.preventDefault();
});
choose();
