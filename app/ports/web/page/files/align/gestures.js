// SPDX-License-Identifier: Apache-2.0
// Gestures of the user on the shown camera. All commands of one go to the camera on which it began, however many
// requests they are; choosing another camera ends it, and the rest is not sent.
export class Gestures {
  #chosen = 0;  // number of times that a camera was chosen

  // `camera()`: the shown one, undefined before there is one. `send(camera, command, values)`: a promise; true: done.
  constructor(camera, send) {
    Object.assign(this, { camera, send });
  }

  // Null: there is no camera yet.
  begin() {
    const camera = this.camera(), chosen = this.#chosen;
    if (!camera) return null;
    const isOver = () => chosen !== this.#chosen;
    return { camera: camera.name, isOver,
      give: async (command, values = {}) => !isOver() && this.send(camera, command, values) };
  }

  // A gesture of one command. True: done.
  async give(command, values) {
    return await this.begin()?.give(command, values) ?? false;
  }

  // Another camera is chosen.
  end() {
    ++this.#chosen;
  }
}
