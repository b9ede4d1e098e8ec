// SPDX-License-Identifier: Apache-2.0
// A picture as a file, with its name and the legend of its colours.
import { amountText } from "../elements/amounts.js";
import { element } from "../elements/elements.js";

const kLine = 26, kMargin = 8, kRamp = 120; // px
const kQuality = 0.95;

function addText(context, text, x, y) {
  context.fillText(text, x, y);
  return x + context.measureText(text).width + kMargin;
}

function addLegend(context, { camera, range, unit, stops }, y) {
  let x = addText(context, `${camera} ${amountText(range[0], unit)}`, kMargin, y);
  const ramp = context.createLinearGradient(x, 0, x + kRamp, 0);
  stops.forEach((stop, n) => ramp.addColorStop(n / (stops.length - 1), stop));
  context.fillStyle = ramp;
  context.fillRect(x, y - kLine / 4, kRamp, kLine / 2);
  context.fillStyle = "#fff";
  x = addText(context, amountText(range[1], unit), x + kRamp + kMargin, y);
}

// The view's next picture in full, with its stamp; null: the appliance has none.
export async function nextPicture(view) {
  try {
    const answer = await fetch(`snapshot.jpg?${new URLSearchParams({ view })}`);
    if (!answer.ok) throw new Error(`status ${answer.status}`);
    return { picture: await createImageBitmap(await answer.blob()), stamp: answer.headers.get("X-Timestamp") };
  } catch (error) {
    console.info(`snapshot of ${view}: ${error.message}`);
    return null;
  }
}

// `picture`: a canvas or bitmap; `legends`: see Legend.
export function snapshotOf(name, { picture, stamp }, legends) {
  const all = new OffscreenCanvas(picture.width, picture.height + (1 + legends.length) * kLine);
  const context = all.getContext("2d");
  context.drawImage(picture, 0, 0);
  Object.assign(context, { fillStyle: "#fff", font: "14px system-ui, sans-serif",
    textBaseline: "middle" });
  const row = (n) => picture.height + (n + 0.5) * kLine;
  addText(context, `${name} ${stamp}`, kMargin, row(0));
  legends.forEach((source, n) => addLegend(context, source, row(n + 1)));
  return all.convertToBlob({ type: "image/jpeg", quality: kQuality });
}

// `shown`: {picture, stamp}.
export async function saveSnapshot(name, shown, legends) {
  const href = URL.createObjectURL(await snapshotOf(name, shown, legends));
  element("a", { href, download: `${name}-${shown.stamp}.jpg` }).click();
  URL.revokeObjectURL(href);
}
