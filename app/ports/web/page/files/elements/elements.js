// SPDX-License-Identifier: Apache-2.0
// Elements with properties and children; text is never read as HTML.
export function element(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in made) made[name] = value;
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

// Writes only changes, so that a selection or a screen reader is not disturbed.
export function setText(where, text) {
  if (where.textContent !== text) where.textContent = text;
}

export function field(label, properties) {
  return element("label", {}, label, " ", element("input", { required: true, ...properties }));
}

// Passphrase of a backup, which may be empty, with the hidden name that password managers keep it by.
export function passphraseFields(label, autocomplete) {
  return [element("input", { type: "text", hidden: true, readOnly: true, autocomplete: "username", value: "backup" }),
    field(label, { name: "passphrase", type: "password", required: false, autocomplete })];
}

// Table with a heading for each of `titles`, in a horizontally scrollable part reachable by keys: {root,
// body}.
export function table(titles, label = "") {
  const head = element("tr", {}, ...titles.map((title) => element("th", { scope: "col" }, title)));
  const body = element("tbody");
  const root = element("div", { className: "scroll", tabIndex: 0, role: "group" },
    element("table", {}, element("thead", {}, head), body));
  if (label) root.setAttribute("aria-label", label);
  return { root, body };
}

// `act()` is called when it is pressed.
export function button(label, act) {
  const made = element("button", { type: "button" }, label);
  made.addEventListener("click", () => act());
  return made;
}

// `give(name)` is called when it is pressed.
export const commandButton = (label, name, give) => button(label, () => give(name));

// `act` that does nothing, and returns undefined, until its last call has ended: the refusal of a second press would
// replace the answer to the first.
export function oneAtATime(act) {
  let isActing = false;
  return async (...given) => {
    if (isActing) return undefined;
    isActing = true;
    try {
      return await act(...given);
    } finally {
      isActing = false;
    }
  };
}
