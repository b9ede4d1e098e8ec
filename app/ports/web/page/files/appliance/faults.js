// SPDX-License-Identifier: Apache-2.0
// Numbers of MachineQuality in app/model/machine/machine_status.h, which stay the same: no state, stale.
const kUnknown = [3, 4];

// `machine`: that of the status; undefined: none is configured.
export const isMachineFault = (machine) => kUnknown.includes(machine?.quality);

// Faults of the cameras that a view is made from.
export class Faults {
  #texts = new Map(); // fault by camera, of those that have one

  constructor(views) {
    this.views = views;
  }

  status({ cameras }) {
    this.#texts = new Map(cameras.filter(({ fault }) => fault !== 0)
      .map(({ name, fault_text: text }) => [name, text]));
  }

  // Empty: it delivers.
  ofCamera(name) {
    return this.#texts.has(name) ? `${name}: ${this.#texts.get(name)}` : "";
  }

  // Faults of the cameras of views that are displayed as one picture, each once.
  ofView(...names) {
    const cameras = new Set(names.flatMap((name) => this.views.camerasOf(name)));
    return [...cameras].map((camera) => this.ofCamera(camera)).filter(Boolean).join(". ");
  }
}
