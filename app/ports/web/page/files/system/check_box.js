// SPDX-License-Identifier: Apache-2.0
import { element } from "../elements/elements.js";

export function checkBox(label, name, checked = false) {
  return element("label", {}, element("input", { type: "checkbox", name, checked }), " ", label);
}
