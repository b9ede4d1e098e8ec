import { Align } from "./align/align.js";
import { describeFigures } from "./appliance/api.js";
import { Stream } from "./appliance/stream.js";
import { element, setText } from "./elements/elements.js";
import { Live } from "./live/live.js";
import { Look } from "./look/look.js";
import { Process } from "./process/process.js";
import { admit, askAgain } from "./system/access.js";
import { Configuration } from "./system/configuration.js";
import { Fleet } from "./system/fleet.js";
import { Interfaces, showAbout } from "./system/interfaces.js";
import { Log } from "./system/log.js";
import { People } from "./system/people.js";
import { System } from "./system/system.js";
import { texts } from "./texts.js";

const kRetryMs = 500;
const kSilenceS = 2;
const condition = document.getElementById("condition");

function say(text, isWrong) {
  setText(condition, text);
  condition.classList.toggle("wrong", isWrong);
}

function addPages() {
  const names = Object.keys(texts.pages);
  const links = new Map();
  for (const name of names) {
    setText(document.getElementById(`${name}-title`), texts.pages[name]);
    links.set(name, element("a", { href: `#/${name}` }, texts.pages[name]));
  }
  document.getElementById("nav").append(...links.values());
  const turn = () => {
    const asked = location.hash.slice(2);
    const shown = names.includes(asked) ? asked : names[0];
    for (const name of names) {
      document.getElementById(name).hidden = name !== shown;
      if (name === shown) links.get(name).setAttribute("aria-current", "page");
      else links.get(name).removeAttribute("aria-current");
    }
  };
  addEventListener("hashchange", turn);
  turn();
}

// For ever: the appliance may start later than the page.
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
  say(isSilent ? texts.silent : state_text, isSilent || state !== 1);
}

const { role, has_users: hasUsers } = await admit(() => say(texts.connecting, true));
addPages();
const figures = await figuresOfAppliance();
const mayChange = ["integrator", "administrator"].includes(role);
// That of the pages with pictures of views, if one of them is shown.
const shown = () => [live, look, process].find(({ isShown }) => isShown);
const choose = () => stream.choose(shown()?.views ?? []);
const live = new Live(document.getElementById("live"), choose, role !== "viewer");
const look = new Look(document.getElementById("look"), choose);
const align = new Align(document.getElementById("align"), figures.cameras ?? {});
const process = new Process(document.getElementById("process"), figures, mayChange, choose);
const system = new System(document.getElementById("system"), figures);
if (role !== "viewer") new Log(document.getElementById("system"));
showAbout(document.getElementById("system"));
if (mayChange) {
  new Interfaces(document.getElementById("system"));
  new Configuration(document.getElementById("system"));
}
if (hasUsers && role === "administrator") new People(document.getElementById("system"));
new Fleet(document.getElementById("fleet"), role !== "viewer");
const stream = new Stream(
  (message) => {
    if (message.head.kind === "view") return shown()?.picture(message);
    const status = JSON.parse(new TextDecoder().decode(message.body));
    showCondition(status);
    live.status(status);
    look.status(status);
    align.status(status, message.received);
    process.status(status, message.received);
    system.status(status);
  },
  () => {
    say(texts.connecting, true);
    live.lost();
    look.lost();
    askAgain();
  },
);
addEventListener("hashchange", choose);
choose();
