// SPDX-License-Identifier: Apache-2.0
// Cards with the figures of the status, each with its state in a line.
import { amountText } from "../elements/amounts.js";
import { isMachineFault } from "../appliance/faults.js";
import { Card } from "../elements/card.js";
import { texts } from "../texts.js";
import { Components } from "./components.js";

const kHealth = ["board_temperature", "processor_load", "memory_available", "disk_free"];

// `kinds`: those of the status in the card. `state(status, figures)`: [its line, whether that needs a user].
const kCards = {
  state: { kinds: ["system"],
    state: ({ system }, figures) => [system.state_text, system.state !== figures.system.state.codes.running] },
  cameras: { kinds: ["cameras"],
    state: ({ cameras }) => {
      const delivering = cameras.filter(({ fault }) => fault === 0).length;
      return [texts.cards.delivering(delivering, cameras.length), delivering < cameras.length];
    } },
  views: { kinds: ["views"],
    state: ({ views }) => [texts.cards.live(views.filter(({ live }) => live).length, views.length), false] },
  health: { kinds: ["health"],
    state: ({ health }, figures) => [texts.cards.health(kHealth.filter((name) => typeof health[name] === "number")
      .map((name) => [name, amountText(health[name], figures.health[name].unit)])), false] },
  machine: { kinds: ["machine"],
    state: ({ machine }) => [machine.quality_text, isMachineFault(machine)] },
};

export const kKindsOfOverview = Object.values(kCards).flatMap(({ kinds }) => kinds);

class StatusCard {
  constructor(name, figures) {
    Object.assign(this, kCards[name], { figures });
    this.card = new Card(name, texts.cards.titles[name]);
    this.components = new Components(figures);
    this.card.append(this.components.root);
    this.root = this.card.root;
  }

  status(status) {
    this.root.hidden = !this.kinds.some((kind) => status[kind]); // no machine is configured
    if (this.root.hidden) return;
    this.card.say(...this.state(status, this.figures));
    if (!this.card.isOpen) return;
    for (const kind of this.kinds) this.components.show(kind, status[kind]);
  }
}

export const overview = (figures) => Object.keys(kCards).map((name) => new StatusCard(name, figures));
