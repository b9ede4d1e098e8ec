// What the colours of one-channel cameras mean.
import { element } from "./elements.js";
import { texts } from "./texts.js";

// Others show what they see as it is.
export const coloured = (sources) => sources.filter(({ is_radiometric: isRadiometric, colour_map: map }) =>
  isRadiometric || map !== "grey");

export function legend(sources) {
  return element("div", {}, ...coloured(sources).map((source) => {
    const ramp = element("span", { className: "ramp" });
    ramp.style.background = `linear-gradient(to right, ${source.stops.join(", ")})`;
    const [first, last] = source.range;
    return element("p", { className: "legend" }, `${source.camera} ${texts.amount(first, source.unit)}`,
      ramp, texts.amount(last, source.unit));
  }));
}
