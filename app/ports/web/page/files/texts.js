// SPDX-License-Identifier: Apache-2.0
// Texts in the user's language. English ones are in the bundle, others are loaded when they are wanted.
import { texts as english } from "./texts/en.js";
import { kLanguages, language } from "./texts/language.js";

const { file } = kLanguages[language];
const loaded = file ? await import(file).catch(() => null) : null;  // null: English, or no connection

export const texts = loaded?.texts ?? english;

// A text of the appliance, which is English: the title of a signal, or the text of a code. It stays as it is when it
// has no translation.
export const translated = (text) => loaded?.words[text] ?? text;

// Members of an answer; texts of codes are translated.
export const parsed = (json) => JSON.parse(json, loaded
  && ((name, value) => (name.endsWith("_text") ? translated(value) : value)));
