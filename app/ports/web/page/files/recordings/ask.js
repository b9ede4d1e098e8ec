// SPDX-License-Identifier: Apache-2.0
// Requests about events.
const kAgainMs = 1000;
const kBusy = 503;

// The answer, also a refusal; null: it is not wanted any more. A busy appliance is asked again.
export async function ask(path, query, isWanted) {
  const address = `api/v1/recordings/${path}?${new URLSearchParams(query)}`;
  for (;;) {
    const answer = await fetch(address).catch(() => null);
    const read = answer && answer.status !== kBusy ? await answer.json().catch(() => null) : null;
    if (!isWanted()) return null;
    if (read) return read;
    await new Promise((done) => setTimeout(done, kAgainMs));
  }
}
