// SPDX-License-Identifier: Apache-2.0
// Names in a select, which a restarted appliance may change.
import { element } from "../elements/elements.js";
import { texts } from "../texts.js";

// Offers these names, "" as none; the chosen one stays chosen if it is among them. Returns true if they differ from
// those before.
export function offerNames(select, names) {
  const before = [...select.options].map(({ value }) => value), chosen = select.value;
  if (before.length === names.length && before.every((name, n) => name === names[n])) return false;
  select.replaceChildren(...names.map((name) => element("option", { value: name }, name || texts.lookNone)));
  if (names.includes(chosen)) select.value = chosen;
  return true;
}
