// SPDX-License-Identifier: Apache-2.0
// A view from one camera alone, or from two at one moment, to judge alignments: its direction, and its
// pictures.
import { patience } from "../appliance/api.js";
import { Framing } from "../appliance/framing.js";
import { element } from "../elements/elements.js";
import { texts } from "../texts.js";

export const kSide = 480;  // px
export const kStaleMs = 5000;  // over a slow link a picture comes every few seconds

// Direction of a view, as fields of a form and arguments of a query; degrees.
export class ViewFields {
  // Last valid numbers, by name.
  values = { yaw: 0, pitch: -20, h_fov: 80 };

  constructor(onChange) {
    const ends = { yaw: [-180, 180], pitch: [-90, 90], h_fov: [5, 150] };
    this.inputs = Object.fromEntries(Object.entries(this.values).map(([name, value]) =>
      [name, element("input", { type: "number", name, value, min: ends[name][0], max: ends[name][1],
        step: 5, required: true })]));
    this.root = element("p", {}, ...Object.entries(this.inputs).map(([name, input]) =>
      element("label", {}, texts.compare[name], " ", input)));
    for (const [name, input] of Object.entries(this.inputs)) {
      input.addEventListener("change", () => {
        const value = input.valueAsNumber, [least, most] = ends[name];
        if (!(value >= least && value <= most)) return;
        this.values[name] = value;
        onChange();
      });
    }
  }

  turnTo({ yaw, pitch }) {
    for (const [name, value] of Object.entries({ yaw, pitch })) {
      this.values[name] = this.inputs[name].value = Math.round(value);
    }
  }

  get query() {
    return Object.entries(this.values);
  }
}

async function answerOf(route, query) {
  const all = new URLSearchParams([...query, ["width", kSide], ["height", kSide]]);
  const answer = await fetch(`api/v1/alignment/${route}?${all}`, patience());
  if (!answer.ok) throw new Error((await answer.json()).error);
  return answer;
}

export async function pictureOf(query) {
  return createImageBitmap(await (await answerOf("view.jpg", query)).blob());
}

// Pictures of the first camera and of another one, made from frames of one set: its stamp, and its age when they
// were received, in performance.now().
export async function pairOf(query) {
  const bytes = new Uint8Array(await (await answerOf("pair", query)).arrayBuffer());
  const received = performance.now(), messages = new Framing().push(bytes);
  const pictures = await Promise.all(messages.map(({ body }) =>
    createImageBitmap(new Blob([body], { type: "image/jpeg" }))));
  const { stamp, age_ms } = messages[0].head;
  return { pictures, stamp, age_ms, received };
}

// Line below a picture. `more` comes first.
export function caption(...more) {
  return element("figcaption", {}, ...more, element("span", { className: "quiet" }, texts.align.stretched));
}

export function viewCanvas(label) {
  const canvas = element("canvas", { role: "img", "aria-label": label });
  canvas.width = canvas.height = kSide;
  return canvas;
}
