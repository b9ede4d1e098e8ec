// SPDX-License-Identifier: Apache-2.0
// Users, tokens of programs and the audit, for administrators.
import { answerTo, patience, post } from "../appliance/api.js";
import { Card } from "../elements/card.js";
import { momentText, timeZone } from "../elements/clock.js";
import { element, field, oneAtATime, setText, table } from "../elements/elements.js";
import { texts } from "../texts.js";

const kShownEntries = 50;

async function read(what) {
  const answer = await fetch(`api/v1/${what}`, patience());
  const members = await answer.json();
  if (!answer.ok) throw new Error(members.error);
  return members;
}

function roleField(roles) {
  const select = element("select", { name: "role" }, ...roles.map((role) => element("option", {}, role)));
  return element("label", {}, texts.role, " ", select);
}

export class People {
  // `session`: who uses the page, as /api/v1/session has it.
  constructor({ roles, password_characters: characters }) {
    this.said = element("p", { role: "status" });
    // A text of its own: `said` may be showing a token, which is not shown again.
    this.stale = element("p", { role: "alert", className: "wrong" });
    this.users = table([texts.user, texts.role, ""], texts.people);
    this.tokens = table([texts.program, texts.role, ""], texts.programs);
    this.done = table([texts.when(timeZone), texts.who, texts.from, texts.what, texts.before, texts.after,
                       texts.result], texts.audit);
    this.card = new Card("people", texts.peopleTitle, texts.cards.people);
    this.card.append(this.said, this.stale,
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
    const send = oneAtATime(answerTo);
    form.addEventListener("submit", async (event) => {
      event.preventDefault();
      const answer = await send(path, Object.fromEntries(new FormData(form)));
      if (!answer) return; // pressed again
      const { refused, token } = answer;
      if (!refused) form.reset();
      await this.#say(refused, token ? texts.newToken(token) : texts.done);
    });
    return form;
  }

  async #say(refused, done) {
    setText(this.said, refused ? texts.refused(refused) : done);
    this.said.classList.toggle("wrong", Boolean(refused));
    await this.#refresh();
  }

  #row({ name, role }, action, path, body) {
    const button = element("button", { type: "button" }, action);
    button.setAttribute("aria-label", `${action} ${name}`);
    button.addEventListener("click", oneAtATime(async () => this.#say(await post(path, body), texts.done)));
    return element("tr", {}, element("th", { scope: "row" }, name), element("td", {}, role),
      element("td", {}, button));
  }

  async #refresh() {
    try {
      this.#show(...await Promise.all([read("users"), read("audit")]));
      setText(this.stale, "");
    } catch (error) {
      setText(this.stale, texts.refused(error.message));
    }
  }

  #show(people, audit) {
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
