// SPDX-License-Identifier: Apache-2.0
// Login and logout, and the first password.
import { patience, post, read } from "../appliance/api.js";
import { element, field, oneAtATime, setText } from "../elements/elements.js";
import { texts } from "../texts.js";

const kRetryMs = 500;
const kPasswordMs = 30000; // others' passwords are checked first, each for a second on a slow board
const kFirstUser = "admin";
const account = document.getElementById("account");
const section = document.getElementById("access");
let isAsking = false;  // askAgain() waits for the appliance
let admitted = null;    // session of the user for whom the page was made

export const session = () => read("api/v1/session");

// `send(values)` returns the reason of a refusal, or nothing; then `onDone()` is called.
function showForm(title, fields, action, send, onDone = () => location.reload()) {
  const refusal = element("p", { role: "alert", className: "wrong" });
  const form = element("form", {}, ...fields, element("button", {}, action), refusal);
  const submit = oneAtATime(async () => {
    setText(refusal, "");
    const refused = await send(Object.fromEntries(new FormData(form)));
    if (refused) setText(refusal, texts.refused(refused));
    else onDone();
  });
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    submit();
  });
  setText(document.getElementById("access-title"), title);
  section.querySelector("form")?.remove();
  section.append(form);
  section.hidden = false;
  form.querySelector("input").focus();
}

const postPassword = (path, body) => post(path, body, patience(kPasswordMs));
const logIn = (values) => postPassword("api/v1/login", values);

function showLogin(onDone) {
  showForm(texts.logInTitle, [
    field(texts.user, { name: "user", autocomplete: "username" }),
    field(texts.password, { name: "password", type: "password", autocomplete: "current-password" }),
  ], texts.logIn, logIn, onDone);
}

export function newPasswordFields(characters) {
  const properties = { type: "password", autocomplete: "new-password", minLength: characters };
  return [
    field(texts.newPassword(characters), { name: "password", ...properties }),
    field(texts.passwordAgain, { name: "again", ...properties }),
  ];
}

// Form on a computer other than the appliance.
function showFirstCode(characters) {
  showForm(texts.firstPasswordTitle, [
    element("p", {}, texts.whereTheCodeIs(kFirstUser)),
    field(texts.code, { name: "code", autocomplete: "one-time-code" }),
    ...newPasswordFields(characters),
  ], texts.setPassword, async ({ code, password, again }) => {
    if (password !== again) return texts.passwordsDiffer;
    return postPassword("api/v1/set_first_password", { code, password });
  });
}

function showFirstPassword(characters) {
  showForm(texts.firstPasswordTitle, [
    field(texts.user, { name: "user", value: kFirstUser, autocomplete: "username" }),
    ...newPasswordFields(characters),
  ], texts.setPassword, async ({ user, password, again }) => {
    if (password !== again) return texts.passwordsDiffer;
    const refused = await postPassword("api/v1/set_user", { user, role: "administrator", password });
    return refused || logIn({ user, password });
  });
}

function showAccount({ user, role, has_users: hasUsers, password_characters: characters }) {
  const name = hasUsers ? texts.account(user, role) : texts.noPassword;
  const button = element("button", { type: "button" }, hasUsers ? texts.logOut : texts.setPassword);
  button.addEventListener("click", async () => {
    if (!hasUsers) return showFirstPassword(characters);
    const refused = await post("api/v1/logout", {});
    if (refused) setText(account.firstChild, texts.refused(refused));
    else location.reload();
  });
  account.replaceChildren(element("span", {}, name), " ", button);
}

// Retries for ever, because the appliance may start later than the page.
async function presentSession(onNoAnswer) {
  for (;;) {
    try {
      return await session();
    } catch {
      onNoAnswer();
      await new Promise((resolve) => setTimeout(resolve, kRetryMs));
    }
  }
}

// Returns the session once the user may see the page; until then shows a form. `say(why)`: reason why nothing is shown
// yet; empty: a form is.
export async function admit(say) {
  const present = await presentSession(() => say(texts.connecting));
  if (present.role) {
    admitted = present;
    showAccount(present);
    return present;
  }
  say("");
  if (present.has_users) showLogin();
  else showFirstCode(present.password_characters);
  return new Promise(() => {});
}

// After a lost connection: asks for a new login if the session has ended, over the page, so that nothing typed is
// lost. The page is made again for another user. One question at a time, because a late answer to another one would
// replace the form while it is filled in.
export async function askAgain() {
  if (!section.hidden || isAsking) return;
  isAsking = true;
  const present = await session().catch(() => null);
  isAsking = false;
  if (!present || present.role || !section.hidden) return;
  showLogin(async () => {
    const next = await presentSession(() => {});
    if (next.user !== admitted.user || next.role !== admitted.role) return location.reload();
    section.hidden = true;
    showAccount(next);
  });
}
