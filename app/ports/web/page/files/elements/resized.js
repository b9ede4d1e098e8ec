// SPDX-License-Identifier: Apache-2.0
// Sizes of elements, once they no longer change.
const kSettleMs = 300;

// Calls `act()` after the first size, and after each change.
export function followSize(element, act) {
  let settle = 0;
  new ResizeObserver(() => {
    clearTimeout(settle);
    settle = setTimeout(act, kSettleMs);
  }).observe(element);
}
