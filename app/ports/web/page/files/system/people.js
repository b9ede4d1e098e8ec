// SPDX-License-Identifier: Apache-2.0
// Users, tokens of programs and the audit, for administrators.
import { answerTo, post } from "../appliance/api.js";
import { Card } from "../elements/card.js";
import { momentText, timeZone } from "../elements/clock.js";
import { element, field, setText, table } from "../elements/elements.js";
import { texts } from "../texts.js";

const kShownEntries = 50;

function roleField(roles) {
  const select = element("select", { name: "role" }, ...roles.map((role) => element("option", {}, role)));
  return element("label", {}, texts.role, " ", select);
}

export class People {
  // `session`: who uses the page, as /api/v1/session has it.
  constructor({ roles, password_characters: characters }) {
    this.said = element("p", { role: "status" });
    this.users = table([texts.user, texts.role, ""], texts.people);
    this.tokens = table([texts.program, texts.role, ""], texts.programs);
    this.done = table([texts.when(timeZone), texts.who, texts.from, texts.what, texts.before, texts.after,
                       texts.result], texts.audit);
    this.card = new Card("people", texts.peopleTitle, texts.cards.people);
    this.card.append(this.said,
      element("h3", {}, texts.people), this.users.root,
      this.#form(texts.setUser, "api/v1/set_user", [
        field(texts.user, { name: "user", autocomplete: "off" }), roleField(roles),
        field(texts.newPassword(characters), {
          name: "password", type: "password", minLength: characters,
          autocomplete: "new-password" })]),
      element("h3", {}, texts.programs), this.tokens.root,
      this.#form(texts.createToken, "api/v1/create_token", [
        field(texts.program, { name: "name", autocomplete: "off" }), roleField(roles)]),
      element("h3", {}, texts.audit), this.done.root);
    this.card.whenOpened(() => this.#refresh());
    this.root = this.card.root;
  }

  #form(action, path, fields) {
    const form = element("form", {}, ...fields, element("button", {}, action));
    form.addEventListener("submit", async (event) => {
      event.preventDefault();
      const { refused, token } = await answerTo(path, Object.fromEntries(new FormData(form)));
      if (!refused) form.reset();
      await this.#say(refused, token ? texts.newToken(token) : texts.done);
    });
    return form;
  }

  async #say(refused, done) {
    this.#show(refused ? texts.refused(refused) : done, Boolean(refused));
    await this.#refresh();
  }

  #show(text, isWrong) {
    setText(this.said, text);
    this.said.classList.toggle("wrong", isWrong);
  }

  #row({ name, role }, action, path, body) {
    const button = element("button", { type: "button" }, action);
    button.setAttribute("aria-label", `${action} ${name}`);
    button.addEventListener("click", async () => this.#say(await post(path, body), texts.done));
    return element("tr", {}, element("th", { scope: "row" }, name), element("td", {}, role),
      element("td", {}, button));
  }

  async #refresh() {
    const answers = await Promise.all(["users", "audit"].map((what) => fetch(`api/v1/${what}`)));
    const refused = answers.find((answer) => !answer.ok);
    if (refused) {
      const { error } = await refused.json();
      return this.#show(texts.refused(error), true);
    }
    const [people, audit] = await Promise.all(answers.map((answer) => answer.json()));
    this.users.body.replaceChildren(...people.users.map((one) =>
      this.#row(one, texts.remove, "api/v1/remove_user", { user: one.name })));
    this.tokens.body.replaceChildren(...people.tokens.map((one) =>
      this.#row(one, texts.revoke, "api/v1/revoke_token", { name: one.name })));
    const entries = audit.entries.slice(-kShownEntries).reverse();
    this.done.body.replaceChildren(...entries.map((entry) => element("tr", {},
      element("td", {}, momentText(entry.time)),
      ...["who", "from", "what", "before", "after", "result"].map((key) =>
        element("td", {}, entry[key] ?? "")))));
  }
}
