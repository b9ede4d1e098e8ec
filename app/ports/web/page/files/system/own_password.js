// SPDX-License-Identifier: Apache-2.0
// Change of the logged-in user's own password.
import { post } from "../appliance/api.js";
import { Card } from "../elements/card.js";
import { element, field, oneAtATime, setText } from "../elements/elements.js";
import { texts } from "../texts.js";
import { newPasswordFields } from "./access.js";

export class OwnPassword {
  constructor({ user, role, password_characters: characters }) {
    this.said = element("p", { role: "status" });
    // Password managers store the password for the name in the same form.
    const name = field(texts.user, { defaultValue: user, readOnly: true, autocomplete: "username" });
    this.form = element("form", {}, name,
      field(texts.presentPassword, { name: "old", type: "password", autocomplete: "current-password" }),
      ...newPasswordFields(characters), element("button", {}, texts.changePassword));
    const change = oneAtATime(() => this.#change());
    this.form.addEventListener("submit", (event) => {
      event.preventDefault();
      change();
    });
    this.card = new Card("password", texts.ownPassword, texts.account(user, role));
    this.card.append(this.form, this.said);
    this.root = this.card.root;
  }

  async #change() {
    const { old, password, again } = Object.fromEntries(new FormData(this.form));
    const why = password === again ? await post("api/v1/set_password", { old, new: password })
      : texts.passwordsDiffer;
    setText(this.said, why ? texts.refused(why) : texts.passwordChanged);
    this.said.classList.toggle("wrong", why !== "");
    if (!why) this.form.reset();
  }
}
