// SPDX-License-Identifier: Apache-2.0
// Cause of an event as a text in the page's language.
import { amountText } from "../elements/amounts.js";
import { texts } from "../texts.js";

const kNamed = ["alarm", "line"]; // kinds whose cause has a name

// `signals`: descriptions by name. Events of an earlier version have such a cause only as an English text.
export function causeText({ trigger, cause, alarm, line }, signals = {}) {
  const said = texts.recordings;
  if (alarm) {
    const { region, signal, level_text: level, value, unit } = alarm;
    return said.raised(region, signals[signal]?.title || signal, level, value === null ? "" : amountText(value, unit));
  }
  if (line) return said.lineActive(line);
  return kNamed.includes(trigger) ? cause : said.kinds[trigger] ?? cause;
}
