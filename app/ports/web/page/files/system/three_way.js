// SPDX-License-Identifier: Apache-2.0
// Difference of three texts by lines: one text, and two that were made of it (diff3).

// For each line of [a] the index of its equal in [b], ascending; -1: it has none. By the longest common subsequence.
function matches(a, b) {
  let first = 0;
  while (first < a.length && first < b.length && a[first] === b[first]) ++first;
  let last = 0;
  const rest = Math.min(a.length, b.length) - first;
  while (last < rest && a[a.length - 1 - last] === b[b.length - 1 - last]) ++last;
  const rows = a.length - first - last, columns = b.length - first - last, width = columns + 1;
  // Length of the longest common subsequence of the lines from row and column on.
  const lengths = new Uint32Array((rows + 1) * width);
  for (let i = rows - 1; i >= 0; --i) {
    for (let j = columns - 1; j >= 0; --j) {
      lengths[i * width + j] = a[first + i] === b[first + j] ? 1 + lengths[(i + 1) * width + j + 1]
        : Math.max(lengths[(i + 1) * width + j], lengths[i * width + j + 1]);
    }
  }
  const found = a.map((_, i) => (i < first ? i : i >= first + rows ? i - a.length + b.length : -1));
  for (let i = 0, j = 0; i < rows && j < columns;) {
    if (a[first + i] === b[first + j]) found[first + i++] = first + j++;
    else if (lengths[(i + 1) * width + j] >= lengths[i * width + j + 1]) ++i;
    else ++j;
  }
  return found;
}

// Parts of the texts in order, as lines: {same}, or {line, base, theirs, mine} where one of the two differs from the
// base; `line` of the base, from 1.
export function partsOf(base, theirs, mine) {
  const [before, other, own] = [base, theirs, mine].map((text) => text.split("\n"));
  const inOther = matches(before, other), inOwn = matches(before, own);
  const parts = [];
  let from = [0, 0, 0];
  for (let i = 0; i <= before.length; ++i) {
    const isEnd = i === before.length;
    const to = isEnd ? [i, other.length, own.length] : [i, inOther[i], inOwn[i]];
    if (to.includes(-1)) continue;
    const [b, t, m] = [before, other, own].map((lines, n) => lines.slice(from[n], to[n]));
    if (b.length + t.length + m.length > 0) parts.push({ line: from[0] + 1, base: b, theirs: t, mine: m });
    if (!isEnd) parts.push({ same: [before[i]] });
    from = to.map((index) => index + 1);
  }
  return parts;
}

const isSame = (a, b) => a.join("\n") === b.join("\n");

// The text that counts without a choice: the only one that was changed; null: both were, differently.
export function usualChoice({ base, theirs, mine }) {
  if (isSame(theirs, mine) || isSame(base, theirs)) return "mine";
  return isSame(base, mine) ? "theirs" : null;
}
