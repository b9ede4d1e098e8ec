// SPDX-License-Identifier: Apache-2.0
// Silence of the pipeline: the appliance repeats the last status, whose figures are no longer measured.
const kSilenceS = 2;

export const isSilent = ({ age }) => age === null || age > kSilenceS;

// Figures are null; codes, which have texts, stay as they were last.
function unmeasured(component) {
  const isFigure = (name) => typeof component[name] === "number" && !Object.hasOwn(component, `${name}_text`);
  return Object.fromEntries(Object.entries(component).map(([name, value]) => [name, isFigure(name) ? null : value]));
}

// The same status without the figures of regions and cameras.
export function withoutFigures(status) {
  const { regions = [], cameras = [] } = status;
  return { ...status, regions: regions.map(unmeasured), cameras: cameras.map(unmeasured) };
}
