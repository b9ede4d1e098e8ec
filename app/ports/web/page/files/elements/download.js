// SPDX-License-Identifier: Apache-2.0
// Link that saves a text as a file.
import { element } from "./elements.js";
import { texts } from "../texts.js";

const kKeptMs = 1000;  // lifetime of the text, for the browser to read it

// `text()` is called when it is pressed.
export function downloadLink(name, text) {
  const link = element("a", { className: "button", href: "#", download: name }, texts.download);
  link.addEventListener("click", () => {
    link.href = URL.createObjectURL(new Blob([text()]));
    setTimeout(() => URL.revokeObjectURL(link.href), kKeptMs);
  });
  return link;
}
