// SPDX-License-Identifier: Apache-2.0
// A loupe under the pointer: the picture four times as large as on the screen, with a cross in the middle.
import { element } from "../elements/elements.js";

const kZoom = 4, kSidePx = 160;

export class Loupe {
  #centre = null;  // pixel of the picture

  // `picture`: a canvas, with the loupe in the same element.
  constructor(picture) {
    this.picture = picture;
    this.root = element("canvas", { className: "loupe", ariaHidden: "true", hidden: true, width: kSidePx,
      height: kSidePx });
  }

  show(pixel) {
    this.#centre = pixel;
    this.root.hidden = false;
    this.refresh();
  }

  hide() {
    this.#centre = null;
    this.root.hidden = true;
  }

  // To be called when the picture has changed, too.
  refresh() {
    if (!this.#centre) return;
    const { width, height, clientWidth } = this.picture;
    const [x, y] = this.#centre.map((place) => place + 0.5);
    const side = kSidePx / kZoom * width / clientWidth;
    this.root.style.left = `${100 * x / width}%`;
    this.root.style.top = `${100 * y / height}%`;
    const brush = this.root.getContext("2d");
    brush.imageSmoothingEnabled = false;
    brush.fillRect(0, 0, kSidePx, kSidePx);
    brush.drawImage(this.picture, x - side / 2, y - side / 2, side, side, 0, 0, kSidePx, kSidePx);
    this.#drawCross(brush);
  }

  #drawCross(brush) {
    const middle = kSidePx / 2;
    brush.strokeStyle = "#ff7ad9";
    brush.beginPath();
    brush.moveTo(0, middle);
    brush.lineTo(kSidePx, middle);
    brush.moveTo(middle, 0);
    brush.lineTo(middle, kSidePx);
    brush.stroke();
  }
}
