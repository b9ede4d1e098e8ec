// SPDX-License-Identifier: Apache-2.0
// Buttons that end a trial: confirm its configuration, or revert it.
import { answerTo } from "../appliance/api.js";
import { commandButton, oneAtATime } from "../elements/elements.js";
import { texts } from "../texts.js";

const kEnds = {
  confirm_configuration: { label: texts.confirmFiles, done: texts.confirmed },
  revert_configuration: { label: texts.revertFiles, done: texts.reverted },
};

// `onEnd(refused, done)`: the reason of a refusal, or what was done. Returns the buttons.
export function trialEnds(onEnd) {
  return Object.entries(kEnds).map(([route, { label, done }]) => commandButton(label, route, oneAtATime(async () => {
    const { refused } = await answerTo(`api/v1/${route}`, {});
    onEnd(refused, done);
  })));
}
