// SPDX-License-Identifier: Apache-2.0
// The recipe's alarms, with their acknowledgement.
import { raisedAlarms, severity } from "../appliance/alarms.js";
import { command } from "../appliance/api.js";
import { amountText } from "../elements/amounts.js";
import { button, element, setText } from "../elements/elements.js";
import { Keyed, titled } from "../elements/figures.js";
import { texts } from "../texts.js";

const kSeverities = ["", "warning", "alarm"];  // classes by severity

// Class of the worst alarm that is active or not acknowledged; empty: none.
export function worstOf(alarms) {
  const [worst] = raisedAlarms(alarms);
  return worst ? kSeverities[severity(worst)] : "";
}

function acknowledgement(name, acknowledge) {
  const made = button(texts.acknowledge, acknowledge);
  made.setAttribute("aria-label", `${texts.acknowledge} ${name}`);
  return made;
}

// One alarm, with its button.
class Alarm {
  // `acknowledge()` is called by its button; null: the user may not, and there is none.
  constructor(name, about, acknowledge) {
    this.unit = about?.unit ?? "";
    this.state = element("span", { className: "state" });
    this.root = element("li", {}, element("strong", {}, ...titled(name, about)), this.state,
      ...(acknowledge ? [acknowledgement(name, acknowledge)] : []));
  }

  show(alarm) {
    setText(this.state, `${amountText(alarm.value, this.unit)}, ${alarm.level_text}; ${alarm.state_text}`);
    this.root.className = worstOf([alarm]);
  }
}

export class Alarms {
  #alarms = [];

  // `descriptions` of the signals. `mayAcknowledge`: the user may acknowledge alarms.
  constructor(descriptions, mayAcknowledge) {
    this.said = element("p", { className: "wrong", role: "alert" });
    this.none = element("p", {}, texts.noAlarms);
    this.list = element("ul", { className: "scroll", tabIndex: 0, "aria-label": texts.alarms });
    this.shown = new Keyed(this.list, (name) => {
      const index = this.#alarms.findIndex((alarm) => alarm.name === name);
      return new Alarm(name, descriptions[this.#alarms[index].signal_text],
        mayAcknowledge ? () => this.#acknowledge(index + 1) : null);
    });
    const all = mayAcknowledge ? [button(texts.acknowledgeAll, () => this.#acknowledge(0))] : [];
    this.root = element("section", { id: "alarms" }, element("h3", {}, texts.alarms), ...all, this.said, this.none,
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
