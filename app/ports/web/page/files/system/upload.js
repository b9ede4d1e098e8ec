// SPDX-License-Identifier: Apache-2.0
// Upload of a file in parts, each a request with its place in the file and its bytes in Base64.
import { answerTo } from "../appliance/api.js";
import { texts } from "../texts.js";

// Bytes of a request, less than `max_body_bytes` of [web] in Base64.
const kPart = 30000;

const base64 = (bytes) => btoa(String.fromCharCode(...bytes));

// Null: the file has changed, or its disk was removed. Browsers refuse to read it then, or read less.
async function partOf(file, offset, length) {
  const bytes = await file.slice(offset, offset + length).arrayBuffer().catch(() => null);
  return bytes?.byteLength === length ? new Uint8Array(bytes) : null;
}

// Null: it has arrived; otherwise the reason. `onShare(share)` is called with the share that has arrived; `more`:
// further members of each request; `isWanted()`: false ends it, the reason is empty then.
export async function upload(path, file, { onShare, more = {}, isWanted = () => true }) {
  const { size } = file; // of a removed one it is 0 later
  for (let offset = 0; offset === 0 || offset < size; offset += kPart) {
    const bytes = await partOf(file, offset, Math.min(kPart, size - offset));
    if (!bytes) return texts.unreadable(file.name);
    const { refused } = await answerTo(path, { offset, bytes: base64(bytes), ...more });
    if (refused) return refused;
    if (!isWanted()) return "";
    onShare(Math.min(1, (offset + kPart) / size));
  }
  return null;
}
