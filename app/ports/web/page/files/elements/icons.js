// SPDX-License-Identifier: Apache-2.0
// Icons, drawn in lines of the text's colour over 24 x 24 units.
import { element } from "./elements.js";
import { drawn } from "./shapes.js";

const kPaths = {
  state: "M2 12h5l3-8 4 16 3-8h5",
  control: "M7 4v16l13-8z",
  cameras: "M3 7h4l2-3h6l2 3h4v12H3zM12 9a4 4 0 1 0 0 8a4 4 0 0 0 0-8",
  views: "M2 12s4-7 10-7 10 7 10 7-4 7-10 7-10-7-10-7zM12 9a3 3 0 1 0 0 6a3 3 0 0 0 0-6",
  health: "M10 14V5a2 2 0 0 1 4 0v9a4 4 0 1 1-4 0zM12 9v8",
  machine: "M5 3h14v6l-4 4v4l-3 4-3-4v-4l-4-4zM5 9h14",
  stages: "M12 6a8 8 0 1 0 0 16a8 8 0 0 0 0-16M12 10v4l3 2M9 2h6M12 2v4",
  interfaces: "M9 2v6M15 2v6M6 8h12v3a6 6 0 0 1-12 0zM12 17v5",
  log: "M5 3h14v18H5zM8 8h8M8 12h8M8 16h5",
  configuration: "M4 6h8M16 6h4M4 12h2M10 12h10M4 18h10M18 18h2M14 4v4M8 10v4M16 16v4",
  people: "M9 4a4 4 0 1 0 0 8a4 4 0 0 0 0-8M2 21c0-4 3-6 7-6s7 2 7 6M16 4a4 4 0 0 1 0 8M18 15c3 1 4 3 4 6",
  password: "M8 11a5 5 0 1 0 0 10a5 5 0 0 0 0-10M12 13l9-9M17 8l3 3M14 11l2 2",
  device: "M3 5h18v5H3zM3 14h18v5H3zM7 7.5v.5M7 16.5v.5M11 7.5h6M11 16.5h6",
  about: "M12 2a10 10 0 1 0 0 20a10 10 0 0 0 0-20M12 11v6M12 7v.5",
  "layout-1": "M3 4h18v16H3z",
  "layout-2": "M3 4h18v16H3zM12 4v16",
  "layout-4": "M3 4h18v16H3zM12 4v16M3 12h18",
  "layout-6": "M3 4h18v16H3zM9 4v16M15 4v16M3 12h18",
  "layout-9": "M3 4h18v16H3zM9 4v16M15 4v16M3 9.3h18M3 14.7h18",
  "layout-large": "M3 4h18v16H3zM16 4v16M16 9.3h5M16 14.7h5",
  locked: "M6 11h12v10H6zM8 11V7a4 4 0 0 1 8 0v4",
  unlocked: "M6 11h12v10H6zM8 11V7a4 4 0 0 1 7.5-2",
  back: "M4 4v6h6M4.5 10a8 8 0 1 1 0 6",
  enlarge: "M4 10V4h6M20 14v6h-6M4 4l7 7M20 20l-7-7",
  full: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
};

// Hidden from screen readers: the text beside it says the same.
export function icon(name) {
  return drawn("svg", { viewBox: "0 0 24 24", class: "icon", "aria-hidden": true }, drawn("path", { d: kPaths[name] }));
}

// Button with an icon in place of its label.
export function iconButton(name, label) {
  const button = element("button", { type: "button", className: "icon-button", title: label }, icon(name));
  button.setAttribute("aria-label", label);
  return button;
}
