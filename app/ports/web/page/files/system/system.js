// SPDX-License-Identifier: Apache-2.0
// The appliance itself in cards: its state, its interfaces, and changes of it by the roles that may.
import { element } from "../elements/elements.js";
import { About } from "./about.js";
import { Configuration } from "./configuration.js";
import { Control } from "./control.js";
import { Device } from "./device.js";
import { Interfaces } from "./interfaces.js";
import { Log } from "./log.js";
import { overview } from "./overview.js";
import { OwnPassword } from "./own_password.js";
import { People } from "./people.js";
import { Stages } from "./stages.js";

export class System {
  // `session`: of the user of the page, as /api/v1/session has it.
  constructor(root, views, recipe, figures, session) {
    this.root = root;
    const may = (role) => session.roles.includes(role), isShown = () => !root.hidden;
    this.configuration = may("integrator") ? new Configuration() : null;
    this.parts = [
      ...overview(figures),
      new Stages(),
      new Interfaces(figures, isShown, may("integrator")),
      may("operator") && new Log(isShown),
      may("operator") && new Control(views, recipe, may("integrator")),
      this.configuration,
      session.has_users && may("administrator") && new People(session),
      session.has_users && new OwnPassword(session),
      may("administrator") && new Device(isShown),
      new About(),
    ].filter(Boolean);
    root.append(element("div", { id: "overview" }, ...this.parts.map((part) => part.root)));
  }

  // True: texts of the configuration were typed that are not in the files.
  get isChanged() {
    return this.configuration?.isChanged ?? false;
  }

  status(status) {
    if (this.root.hidden) return;
    for (const part of this.parts) part.status?.(status);
  }
}
