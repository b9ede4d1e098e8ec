// SPDX-License-Identifier: Apache-2.0
// Axes of a chart and their ticks, at round values and at round local times.
import { decimalText } from "./amounts.js";
import { minuteText } from "./clock.js";

const kTickPx = 30;      // least distance of two ticks of values
const kTimeTickPx = 72;  // the same of times
const kMinuteMs = 60000;
const kMinutes = [1, 2, 5, 10];
const kEdgePx = 4;  // room for a line's width

// The smallest of 1, 2 and 5 times a power of ten that is not below `least`.
export function roundStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return ([1, 2, 5].find((one) => one * power >= least) ?? 10) * power;
}

export const rounded = (value, step) => Number((Math.round(value / step) * step).toPrecision(10));

// Positions of values in a plot, px from its top. The range ends at ticks, so that a new measurement seldom moves
// the others.
export class ValueAxis {
  constructor(values, height) {
    const least = Math.min(...values), most = Math.max(...values);
    const span = most - least || Math.abs(most) / 10 || 1;
    this.height = height;
    this.step = roundStep(span * kTickPx / Math.max(height, kTickPx));
    this.low = rounded(Math.floor(least / this.step) * this.step, this.step);
    this.high = rounded(Math.ceil(most / this.step) * this.step, this.step);
    if (this.high === this.low) this.high += this.step;
  }

  get span() {
    return this.high - this.low;
  }
  y(value) {
    return this.height - kEdgePx - (value - this.low) / this.span * (this.height - 2 * kEdgePx);
  }
  value(y) {
    return this.low + (this.height - kEdgePx - y) / (this.height - 2 * kEdgePx) * this.span;
  }

  // {y, text} of each tick.
  get ticks() {
    const decimals = Math.max(0, -Math.floor(Math.log10(this.step) + 1e-9));
    return Array.from({ length: Math.round(this.span / this.step) + 1 }, (_, n) => {
      const value = this.low + n * this.step;
      return { y: this.y(value), text: decimalText(value, decimals) };
    });
  }
}

// {x, text} of each tick at round seconds from `zero`; `xOf(at)`: place of a time, px.
export function secondTicks(first, last, zero, xOf) {
  const px = (xOf(last) - xOf(first)) / (last - first), step = roundStep(kTimeTickPx / px / 1000);
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9)), ticks = [];
  for (let n = Math.ceil((first - zero) / 1000 / step); zero + n * step * 1000 <= last; ++n) {
    ticks.push({ x: xOf(zero + n * step * 1000), text: decimalText(n * step || 0, decimals) });  // not -0
  }
  return ticks;
}

// {x, text} of each tick in the last `spanMs` before `end`, milliseconds since 1970.
export function timeTicks(width, spanMs, end) {
  const px = width / spanMs, offset = kMinuteMs * new Date(end).getTimezoneOffset();
  const step = kMinuteMs * (kMinutes.find((one) => one * kMinuteMs * px >= kTimeTickPx) ?? kMinutes.at(-1));
  const ticks = [];
  for (let at = Math.ceil((end - spanMs - offset) / step) * step + offset; at <= end; at += step) {
    ticks.push({ x: width - (end - at) * px, text: minuteText(at) });
  }
  return ticks;
}
