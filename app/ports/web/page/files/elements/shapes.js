// SPDX-License-Identifier: Apache-2.0
// Shapes over a picture or a chart, and their dragging.
const kClickPx = 3;  // screen px
const kSvg = "http://www.w3.org/2000/svg";

export const kKeys = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

export function drawn(tag, attributes = {}, ...children) {
  const made = document.createElementNS(kSvg, tag);
  place(made, attributes);
  made.append(...children);
  return made;
}

export function place(shape, attributes) {
  for (const [name, value] of Object.entries(attributes)) shape.setAttribute(name, value);
}

// Drags `shape` from `event` on, which pressed it. `onEnd(event, isDone)`: not done if the drag was
// cancelled.
export function followDrag(shape, event, onMove, onEnd) {
  event.preventDefault();
  shape.setPointerCapture(event.pointerId);
  const end = (ended) => {
    for (const [name, listener] of Object.entries(listeners)) shape.removeEventListener(name, listener);
    onEnd(ended, ended.type === "pointerup");
  };
  const listeners = { pointermove: onMove, pointerup: end, pointercancel: end };
  for (const [name, listener] of Object.entries(listeners)) shape.addEventListener(name, listener);
}

// Position in pixels of the picture below `svg`, whose centres are at integers.
export function pixelAt(svg, { width, height }, { clientX, clientY }) {
  const box = svg.getBoundingClientRect();
  return [(clientX - box.left) / box.width * width - 0.5,
          (clientY - box.top) / box.height * height - 0.5];
}

// A line from where `event` pressed `shape` to the pointer, over a picture of that size, until `onEnd(from,
// to, isDone)`, a promise, is settled; pixels. Without `to` it was only clicked or, if not done, cancelled.
export function followPull(svg, shape, event, size, onEnd) {
  const from = pixelAt(svg, size, event), line = drawn("path", { class: "pull" });
  svg.append(line);
  followDrag(shape, event,
    (moved) => place(line, { d: `M${from}L${pixelAt(svg, size, moved)}` }),
    async (ended, isDone) => {
      const isFar = Math.hypot(ended.clientX - event.clientX, ended.clientY - event.clientY) > kClickPx;
      await onEnd(from, isDone && isFar ? pixelAt(svg, size, ended) : null, isDone);
      line.remove();
    });
}

export const pointsText = (pixels) => pixels.map((pixel) => pixel.join(",")).join(" ");

// A line and, over it, a wider one for the pointer.
export function pullableLine(pixels) {
  const points = pointsText(pixels);
  return [drawn("polyline", { points }), drawn("polyline", { points, class: "grip" })];
}
