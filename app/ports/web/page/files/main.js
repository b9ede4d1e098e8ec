// SPDX-License-Identifier: Apache-2.0
import { Align } from "./align/align.js";
import { describeFigures } from "./appliance/api.js";
import { AskedWidths } from "./appliance/asked_widths.js";
import { Faults } from "./appliance/faults.js";
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
const kSilenceS = 2;
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
async function figuresOfAppliance() {
  for (;;) {
    try {
      return await describeFigures();
    } catch {
      say(texts.connecting, true);
      await new Promise((resolve) => setTimeout(resolve, kRetryMs));
    }
  }
}

function showCondition(status) {
  const isSilent = status.age === null || status.age > kSilenceS;
  const { state, state_text } = status.system;
  say(isSilent ? texts.silent : state_text, isSilent || state !== figures.system.state.codes.running);
}

// Tabs in the order of the navigation. The object that make() returns may have status(), picture(), lost(), views, each
// with the width in which it is displayed, device px, 0: in full; and isChanged: it has changes that are not sent.
const kTabs = [
  { name: "live", make: (section) => new Live(section, views, faults, choose, isAtLeast("operator")) },
  { name: "look", make: (section) => new Look(section, choose) },
  { name: "align", make: (section) => new Align(section, faults, figures.cameras) },
  { name: "process",
    make: (section) => new Process(section, faults, recipe, figures, isAtLeast("integrator"), choose) },
  { name: "recordings", make: (section) => new Recordings(section, figures, isAtLeast) },
  { name: "system", make: (section) => new System(section, views, recipe, figures, session) },
  { name: "fleet", make: (section) => new Fleet(section, isAtLeast("operator")) },
];
// The only one at the address /operator.
const kOperator = { name: "operator", make: (section) => new Operator(section, faults, recipe, figures, choose) };
const isOperator = location.pathname.endsWith("/operator");
const tabs = isOperator ? [kOperator] : kTabs;
document.body.classList.toggle("operator", isOperator);

document.getElementById("account").after(languageChoice());
document.getElementById("nav").ariaLabel = texts.navigation;
const session = await admit(() => say(texts.connecting, true));
// True: the user of the page may do what this role may.
const isAtLeast = (role) => session.roles.includes(role);
const links = addTabs();
const views = new Views(), faults = new Faults(views), recipe = new Recipe();
const notices = new Notices(document.getElementById("notices"), recipe, links,
  isAtLeast("integrator"));
const figures = await figuresOfAppliance();
const made = [];
// The shown tab with pictures of views, if any.
const shown = () => made.find((tab) => tab.views && tab.isShown);
const widths = new AskedWidths(views);
const choose = () => stream.choose(widths.of(shown()?.views ?? []));
for (const { name, make } of tabs) made.push(make(document.getElementById(name)));
const stream = new Stream(
  (message) => {
    if (message.head.kind === "view") return shown()?.picture(message);
    const status = parsed(new TextDecoder().decode(message.body));
    showCondition(status);
    views.status();
    faults.status(status);
    recipe.status(status);
    notices.status(status);
    for (const tab of made) tab.status?.(status, message.received);
  },
  () => {
    say(texts.connecting, true);
    views.lost();
    for (const tab of made) tab.lost?.();
    askAgain();
  },
);
addEventListener("hashchange", choose);
views.addEventListener("change", choose);
// The browser asks before unsent changes are lost.
addEventListener("beforeunload", (event) => {
  if (recipe.body || made.some((tab) => tab.isChanged)) event.preventDefault();
});
choose();
