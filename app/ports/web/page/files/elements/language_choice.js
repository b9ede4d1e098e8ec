// SPDX-License-Identifier: Apache-2.0
// Choice of the page's language, in the header.
import { texts } from "../texts.js";
import { chooseLanguage, kLanguages, language } from "../texts/language.js";
import { element } from "./elements.js";

export function languageChoice() {
  const choice = element("select", { id: "language", ariaLabel: texts.language },
    ...Object.entries(kLanguages).map(([value, { name }]) => element("option", { value, lang: value }, name)));
  choice.value = language;
  choice.addEventListener("change", () => chooseLanguage(choice.value));
  return choice;
}
