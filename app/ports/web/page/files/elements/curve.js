// SPDX-License-Identifier: Apache-2.0
// The curve of a figure on a canvas: of its last ten minutes, or of any other time.
import { kHistoryMs } from "../appliance/history.js";

const kGapMs = 2000;  // silence that counts as a gap

// {at, low, high} of the last ten minutes, oldest first.
export const pointsOf = (history, now) => history.points.filter(({ at }) => at >= now - kHistoryMs);

export const valuesOf = (points) =>
  points.flatMap(({ low, high }) => [low, high]).filter((value) => value !== null);

// The measured point at that time, null if there is none.
export function pointAt(points, at) {
  let nearest = null;
  for (const point of points) {
    if (!nearest || Math.abs(point.at - at) <= Math.abs(nearest.at - at)) nearest = point;
  }
  return nearest && nearest.low !== null && Math.abs(nearest.at - at) < kGapMs ? nearest : null;
}

// Clears the canvas; returns its context in CSS pixels.
export function freshBrush(canvas) {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = canvas.clientWidth * ratio;
  canvas.height = canvas.clientHeight * ratio;
  const brush = canvas.getContext("2d");
  brush.scale(ratio, ratio);
  return brush;
}

// Place of a time in the last ten minutes, px; `now` is at the right end.
export const recentX = (width, now) => (at) => width * (1 + (at - now) / kHistoryMs);

// `xOf(at)`: place of a time, px. A silence of `gapMs` is a gap.
export function strokeCurve(brush, points, axis, xOf, gapMs = kGapMs) {
  brush.beginPath();
  let before = null;
  for (const point of points) {
    const x = xOf(point.at);
    const isDrawn = before !== null && before.low !== null && point.at - before.at < gapMs;
    before = point;
    if (point.low === null) continue;
    if (!isDrawn) brush.moveTo(x, axis.y(point.low));
    brush.lineTo(x, axis.y(point.low));
    brush.lineTo(x, axis.y(point.high));
  }
  brush.stroke();
}
