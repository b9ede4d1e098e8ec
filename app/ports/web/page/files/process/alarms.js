// SPDX-License-Identifier: Apache-2.0
// The recipe's alarms, with their acknowledgement.
import { raisedAlarms, severity } from "../appliance/alarms.js";
import { command } from "../appliance/api.js";
import { amountText } from "../elements/amounts.js";
import { element, setText } from "../elements/elements.js";
import { Keyed, titled } from "../elements/figures.js";
import { texts } from "../texts.js";

const kSeverities = ["", "warning", "alarm"];  // classes by severity

// Class of the worst alarm that is active or not acknowledged; empty: none.
export function worstOf(alarms) {
  const [worst] = raisedAlarms(alarms);
  return worst ? kSeverities[severity(worst)] : "";
}

// One alarm, with its button.
class Alarm {
  constructor(name, about, acknowledge) {
    this.unit = about?.unit ?? "";
    this.state = element("span", { className: "state" });
    const button = element("button", { type: "button" }, texts.acknowledge);
    button.setAttribute("aria-label", `${texts.acknowledge} ${name}`);
    button.addEventListener("click", acknowledge);
    this.root = element("li", {}, element("strong", {}, ...titled(name, about)), this.state, button);
  }

  show(alarm) {
    setText(this.state, `${amountText(alarm.value, this.unit)}, ${alarm.level_text}; ${alarm.state_text}`);
    this.root.className = worstOf([alarm]);
  }
}

export class Alarms {
  #alarms = [];

  // `descriptions` of the signals.
  constructor(descriptions) {
    this.said = element("p", { className: "wrong", role: "alert" });
    this.none = element("p", {}, texts.noAlarms);
    this.list = element("ul", { className: "scroll", tabIndex: 0, "aria-label": texts.alarms });
    this.shown = new Keyed(this.list, (name) => {
      const index = this.#alarms.findIndex((alarm) => alarm.name === name);
      return new Alarm(name, descriptions[this.#alarms[index].signal_text], () => this.#acknowledge(index + 1));
    });
    const all = element("button", { type: "button" }, texts.acknowledgeAll);
    all.addEventListener("click", () => this.#acknowledge(0));
    this.root = element("section", { id: "alarms" }, element("h3", {}, texts.alarms), all, this.said, this.none,
      this.list);
  }

  show(alarms) {
    this.#alarms = alarms;
    this.none.hidden = alarms.length > 0;
    this.list.hidden = alarms.length === 0;
    this.shown.keep(alarms.map(({ name }) => name));
    for (const alarm of alarms) this.shown.get(alarm.name).show(alarm);
  }

  // Number from 1; 0: all.
  async #acknowledge(alarm) {
    const why = await command("acknowledge_alarm", { alarm });
    setText(this.said, why ? texts.refused(why) : "");
  }
}
