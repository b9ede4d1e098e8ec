// SPDX-License-Identifier: Apache-2.0
// Directions in the machine's frame, as x, y, z: yaw from +Y towards +X, pitch up, in degrees.
export const kDeg = Math.PI / 180;

export function directionOf({ yaw, pitch }) {
  return [Math.sin(yaw * kDeg) * Math.cos(pitch * kDeg), Math.cos(yaw * kDeg) * Math.cos(pitch * kDeg),
          Math.sin(pitch * kDeg)];
}

export function anglesOf([x, y, z]) {
  return { yaw: Math.atan2(x, y) / kDeg, pitch: Math.asin(z / Math.hypot(x, y, z)) / kDeg };
}

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) =>
  [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

// Axes of an upright picture in that direction.
export function axesOf({ yaw, pitch }) {
  const forward = directionOf({ yaw, pitch }), right = [Math.cos(yaw * kDeg), -Math.sin(yaw * kDeg), 0];
  return { right, up: cross(right, forward), forward };
}

// Applies the smallest rotation from one unit vector to another to vector v.
function turned(v, from, to) {
  const axis = cross(from, to), cosine = dot(from, to), share = dot(axis, v) / (1 + cosine);
  const sideways = cross(axis, v);
  return v.map((part, k) => cosine * part + sideways[k] + share * axis[k]);
}

// Arguments of turn_camera that move the content of one direction to the other one.
export function turnBetween(from, to) {
  const [right, forward, up] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => turned(axis, from, to));
  return { ...anglesOf(forward), roll: Math.atan2(-right[2], up[2]) / kDeg };
}
