// SPDX-License-Identifier: Apache-2.0
// Upload of a file in parts, each a request with its place in the file and its bytes in Base64.
import { answerTo } from "../appliance/api.js";

// Bytes of a request, less than `max_body_bytes` of [web] in Base64.
const kPart = 30000;

const base64 = (bytes) => btoa(String.fromCharCode(...bytes));

// Null: it has arrived; otherwise the reason. `more(file)`: further members of each request; `onShare(share)` is called
// with the share that has arrived.
export async function upload(path, file, onShare, more = () => ({})) {
  for (let offset = 0; offset === 0 || offset < file.size; offset += kPart) {
    const bytes = new Uint8Array(await file.slice(offset, offset + kPart).arrayBuffer());
    const { refused } = await answerTo(path, { offset, bytes: base64(bytes), ...more(file) });
    if (refused) return refused;
    onShare(Math.min(1, (offset + kPart) / file.size));
  }
  return null;
}
