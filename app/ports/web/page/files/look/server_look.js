// SPDX-License-Identifier: Apache-2.0
// Looking around without WebGL: the appliance points one of its views, for all users.
import { NewestCommand } from "../appliance/newest_command.js";
import { NewestPicture } from "../appliance/newest_picture.js";
import { element, setText } from "../elements/elements.js";
import { texts } from "../texts.js";
import { offerNames } from "./offer.js";

export class ServerLook {
  #pointed = []; // views that can be pointed, {name, index}

  // `onChoice()`: another view is chosen. `onPicture({age_ms, received, name})`.
  constructor(canvas, gaze, onChoice, onPicture) {
    this.gaze = gaze;
    this.choice = element("select", { name: "pointed" });
    this.choice.addEventListener("change", onChoice);
    this.said = element("p", { className: "wrong", role: "alert" });
    this.command = new NewestCommand("point_view", (why) =>
      setText(this.said, why ? texts.refused(why) : ""));
    gaze.onChange = () => this.#point();
    this.pictures = new NewestPicture((picture, { head, received }) => {
      if (head.name !== this.choice.value) return; // another choice meanwhile
      canvas.width = picture.width;
      canvas.height = picture.height;
      canvas.getContext("2d").drawImage(picture, 0, 0);
      canvas.dataset.number = head.number;
      onPicture({ age_ms: head.age_ms, received, name: head.name });
    });
    this.root = element("div", {}, element("label", {}, texts.lookPointed, " ", this.choice), this.said);
  }

  // A restarted appliance may have other views, or the same ones by other numbers.
  offer(pointed) {
    this.#pointed = pointed;
    offerNames(this.choice, pointed.map(({ name }) => name));
    this.root.hidden = pointed.length === 0;
  }

  get views() {
    return this.choice.value ? [this.choice.value] : [];
  }

  picture(message) {
    if (message.head.name === this.choice.value) this.pictures.show(message);
  }

  #point() {
    const view = this.#pointed.find(({ name }) => name === this.choice.value)?.index;
    if (view === undefined) return;
    const { yaw, pitch, fov: h_fov } = this.gaze;
    this.command.send({ view, yaw, pitch, h_fov });
  }
}
