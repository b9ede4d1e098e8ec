// SPDX-License-Identifier: Apache-2.0
// Version of the appliance that sent the page. After an update it sends another page, which is loaded at the next
// connection.
import { versionOfAppliance } from "./api.js";

export class PageVersion {
  #isStale = false; // the appliance may have been updated since the last check
  #isOutdated = false;

  // `mayReload()`: false while the page has changes that are not sent.
  constructor(version, mayReload) {
    Object.assign(this, { version, mayReload });
  }

  async status() {
    if (this.#isStale) await this.#check();
    if (this.#isOutdated && this.mayReload()) location.reload();
  }

  async #check() {
    this.#isStale = false;
    try {
      this.#isOutdated = await versionOfAppliance() !== this.version;
    } catch (error) {
      console.info(`version: ${error.message}`);
      this.#isStale = true; // retried with the next status
    }
  }

  lost() {
    this.#isStale = true;
  }
}
