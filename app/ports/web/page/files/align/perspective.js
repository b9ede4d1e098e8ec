// SPDX-License-Identifier: Apache-2.0
// A square view of the room from the ball's centre, with the projection of /api/v1/alignment/view.jpg.
import { axesOf, dot, kDeg } from "../elements/directions.js";

// Share of a line's length; parts nearer to the viewer's plane are omitted.
const kNear = 0.01;

export class Perspective {
  // Degrees; the picture's side in pixels, whose centres are at integers.
  constructor({ yaw, pitch, h_fov: fov }, side) {
    Object.assign(this, axesOf({ yaw, pitch }));  // right, up, forward
    this.middle = (side - 1) / 2;
    this.focal = side / 2 / Math.tan(fov / 2 * kDeg);
  }

  // Pixel of a point in front.
  pixelOf(point) {
    const scale = this.focal / dot(point, this.forward);
    return [this.middle + scale * dot(point, this.right), this.middle - scale * dot(point, this.up)];
  }

  directionAt([u, v]) {
    const x = (u - this.middle) / this.focal, y = (this.middle - v) / this.focal;
    const length = Math.hypot(x, y, 1);
    return this.forward.map((part, k) => (part + x * this.right[k] + y * this.up[k]) / length);
  }

  // Ends, as pixels, of the part in front of the viewer of the line between two points; null: none.
  lineOf(from, to) {
    const along = to.map((part, k) => part - from[k]);
    const near = kNear * Math.hypot(...along), begin = dot(from, this.forward), end = dot(to, this.forward);
    if (begin <= near && end <= near) return null;
    const cut = (near - begin) / (end - begin), point = from.map((part, k) => part + cut * along[k]);
    return [begin <= near ? point : from, end <= near ? point : to].map((one) => this.pixelOf(one));
  }
}
