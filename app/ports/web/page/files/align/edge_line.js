// SPDX-License-Identifier: Apache-2.0
import { drawn, pointsText, pullableLine } from "../elements/shapes.js";

// An edge of the scene over a picture; only users who may align can drag it.
export const edgeLine = (pixels, mayAlign) =>
  (mayAlign ? pullableLine(pixels) : [drawn("polyline", { points: pointsText(pixels) })]);
