// SPDX-License-Identifier: Apache-2.0
// Viewing direction, turned by mouse, wheel, fingers and keys.
import { anglesOf, axesOf, kDeg } from "../elements/directions.js";

const kNarrowest = 5, kWidest = 140; // degrees
const kKeyShare = 0.05; // share of the field of view per key
const kZoom = 1.1; // zoom factor per key
const kWheelZoom = 0.0015; // exponent per pixel of the wheel

const clamp = (value, low, high) => Math.min(high, Math.max(low, value));

export class Gaze {
  yaw = 0; // degrees, from +Y towards +X
  pitch = 0;
  fov = 90; // horizontal
  roll = 0; // roll of the displayed picture

  #home = null;

  constructor(onChange, { narrowest = kNarrowest, widest = kWidest } = {}) {
    this.onChange = onChange;
    this.narrowest = narrowest;
    this.widest = widest;
  }

  // Looks in the camera's best direction, unless the user has turned it already.
  begin(direction) {
    if (this.#home) return;
    this.#home = { ...anglesOf(direction), fov: 90 };
    this.reset();
  }
  get home() {
    return this.#home;
  }
  set home({ yaw, pitch, fov }) {
    this.#home = { yaw, pitch, fov };
  }
  reset() {
    const { yaw, pitch, fov } = this.#home ?? { yaw: 0, pitch: 0, fov: 90 };
    this.look(yaw, pitch, fov);
  }

  look(yaw, pitch, fov) {
    this.yaw = ((((yaw + 180) % 360) + 360) % 360) - 180;
    this.pitch = clamp(pitch, -90, 90);
    this.fov = clamp(fov, this.narrowest, this.widest);
    this.onChange();
  }
  turn(yaw, pitch) {
    this.look(this.yaw + yaw, this.pitch + pitch, this.fov);
  }
  // Turns as if the picture were moved, degrees along its own axes.
  drag(right, up) {
    const roll = this.roll * kDeg, c = Math.cos(roll), s = Math.sin(roll);
    this.turn(-(right * c + up * s), -(up * c - right * s));
  }
  zoom(factor) {
    this.look(this.yaw, this.pitch, this.fov / factor);
  }

  // Column vectors right, up and forward, and the tangent of half the field of view.
  get view() {
    const { right, up, forward } = axesOf(this);
    return { axes: [...right, ...up, ...forward], tangent: Math.tan((this.fov * kDeg) / 2) };
  }
}

export function followGestures(canvas, gaze) {
  followFingers(canvas, gaze);
  followWheel(canvas, gaze);
  followKeys(canvas, gaze);
}

// Mouse, pen and fingers. `isMeant(event)`: false leaves a pointer that goes down to the page.
export function followFingers(canvas, gaze, isMeant = () => true) {
  const fingers = new Map(); // positions by pointer
  const spread = () => {
    const [a, b] = [...fingers.values()];
    return b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (!isMeant(event)) return;
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = fingers.get(event.pointerId);
    if (!last) return;
    const before = spread();
    const here = { x: event.offsetX, y: event.offsetY };
    fingers.set(event.pointerId, here);
    const share = gaze.fov / canvas.clientWidth / fingers.size;
    gaze.drag((here.x - last.x) * share, (last.y - here.y) * share);
    if (before > 0 && spread() > 0) gaze.zoom(spread() / before);
  });
  for (const end of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
  }
}

// `isMeant()`: false lets the wheel scroll the page.
export function followWheel(canvas, gaze, isMeant = () => true) {
  canvas.addEventListener("wheel", (event) => {
    if (!isMeant()) return;
    event.preventDefault();
    gaze.zoom(Math.exp(-event.deltaY * kWheelZoom));
  }, { passive: false });
}

// `withShift`: arrows turn only with shift.
export function followKeys(canvas, gaze, withShift = false) {
  canvas.addEventListener("keydown", (event) => {
    const step = gaze.fov * kKeyShare;
    const done = {
      ArrowLeft: () => gaze.turn(-step, 0),
      ArrowRight: () => gaze.turn(step, 0),
      ArrowUp: () => gaze.turn(0, step),
      ArrowDown: () => gaze.turn(0, -step),
      "+": () => gaze.zoom(kZoom),
      "-": () => gaze.zoom(1 / kZoom),
      Home: () => gaze.reset(),
    }[event.key];
    if (!done || event.ctrlKey || event.altKey || event.metaKey) return;
    if (withShift && event.key.startsWith("Arrow") && !event.shiftKey) return;
    event.preventDefault();
    done();
  });
}
