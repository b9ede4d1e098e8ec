// SPDX-License-Identifier: Apache-2.0
// Language of the page: the one chosen on it in this browser, else the browser's first one that the page has.
import { keep, kept } from "../elements/kept.js";

// `file`: its texts; none if they are in the bundle. `dates`: locale of dates; that of Sweden writes them as ISO 8601
// does.
export const kLanguages = {
  en: { name: "English", dates: "sv-SE" },
  de: { name: "Deutsch", dates: "de-DE", file: "./texts/de.js" },
  ja: { name: "日本語", dates: "ja-JP", file: "./texts/ja.js" },
};
const kKept = "language";

export const language = [kept(kKept), ...navigator.languages.map((tag) => tag.slice(0, 2)), "en"]
  .find((one) => Object.hasOwn(kLanguages, one));
document.documentElement.lang = language;

// Loads the page again.
export function chooseLanguage(name) {
  keep(kKept, name);
  location.reload();
}
