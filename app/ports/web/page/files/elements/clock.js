// SPDX-License-Identifier: Apache-2.0
// The one clock of the page: local time of the browser.
import { kLanguages, language } from "../texts/language.js";

const kDate = { year: "numeric", month: "2-digit", day: "2-digit" };
const kTime = { hour: "2-digit", minute: "2-digit" };
const kSeconds = { ...kTime, second: "2-digit" };
const kForm = kLanguages[language].dates;
const moments = new Intl.DateTimeFormat(kForm, { ...kDate, ...kSeconds });
const seconds = new Intl.DateTimeFormat(kForm, kSeconds);
const minutes = new Intl.DateTimeFormat(kForm, kTime);

// `time`: milliseconds since 1970, or a text of ISO 8601.
export const momentText = (time) => moments.format(new Date(time));
export const secondText = (time) => seconds.format(new Date(time));
export const minuteText = (time) => minutes.format(new Date(time));

export const timeZone = moments.resolvedOptions().timeZone;

// Milliseconds since 1970 of a time of performance.now().
export const wallTime = (at) => Date.now() + at - performance.now();
