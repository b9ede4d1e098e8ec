// SPDX-License-Identifier: Apache-2.0
// Decodes pictures as fast as the browser can: while it decodes one, only the newest waits.
export class NewestPicture {
  #waiting = null;
  #isDecoding = false;

  // `onPicture(bitmap, message)` may be called for some of the messages; the bitmap is closed after.
  constructor(onPicture) {
    this.onPicture = onPicture;
  }

  async show(message) {
    this.#waiting = message;
    if (this.#isDecoding) return;
    this.#isDecoding = true;
    try {
      while (this.#waiting) {
        const next = this.#waiting;
        this.#waiting = null;
        await this.#decode(next);
      }
    } finally {
      this.#isDecoding = false;
    }
  }

  // A picture that cannot be decoded is skipped; the age of the last one shows it.
  async #decode(message) {
    let picture;
    try {
      picture = await createImageBitmap(new Blob([message.body], { type: "image/jpeg" }),
        { colorSpaceConversion: "none", premultiplyAlpha: "none" });
    } catch (error) {
      console.info(`picture of ${message.head.name}: ${error.message}`);
      return;
    }
    try {
      this.onPicture(picture, message);
    } finally {
      picture.close();
    }
  }
}
