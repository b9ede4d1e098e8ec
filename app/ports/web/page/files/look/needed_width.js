// SPDX-License-Identifier: Apache-2.0
import { directionOf, dot } from "../elements/directions.js";

// Width of a ball's picture that has a pixel for each of the screen in the middle of a view; 0: the full picture has
// less. `mesh`: head of /api/v1/sphere; `gaze`: see Gaze; `across`: width of the view, device px.
export function neededWidth({ width, facing, u: radius }, gaze, across) {
  const onScreen = across / 2 / gaze.view.tangent; // px per radian
  // A mirror ball turns the direction by twice the turn of its surface.
  const halfWay = Math.sqrt(Math.max(0, 1 + dot(facing, directionOf(gaze))) / 2); // cosine of half the angle
  const inPicture = Math.hypot(...radius) / 2 * halfWay;
  return onScreen < inPicture ? Math.ceil(width * onScreen / inPicture) : 0;
}
