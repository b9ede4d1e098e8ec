// Looking around where the browser has no WebGL: the appliance points one of its views, for all who
// look at it.
import { command } from "./api.js";
import { element, setText } from "./elements.js";
import { NewestPicture } from "./newest_picture.js";
import { texts } from "./texts.js";

export class ServerLook {
  #isSending = false;
  #hasMore = false;

  // `pointed`: the views that can be pointed, {name, index}; `onPicture({age_ms, received})`.
  constructor(canvas, gaze, pointed, onPicture) {
    this.gaze = gaze;
    this.pointed = pointed;
    this.choice = element("select", { name: "pointed" },
      ...pointed.map(({ name }) => element("option", { value: name }, name)));
    this.said = element("p", { className: "wrong", role: "alert" });
    gaze.onChange = () => this.#point();
    this.pictures = new NewestPicture((picture, { head, received }) => {
      canvas.width = picture.width;
      canvas.height = picture.height;
      canvas.getContext("2d").drawImage(picture, 0, 0);
      canvas.dataset.number = head.number;
      onPicture({ age_ms: head.age_ms, received });
    });
  }

  controls(onChoice) {
    this.choice.addEventListener("change", onChoice);
    return element("div", {}, element("label", {}, texts.lookPointed, " ", this.choice), this.said);
  }

  get views() {
    return this.choice.value ? [this.choice.value] : [];
  }

  picture(message) {
    if (message.head.name === this.choice.value) this.pictures.show(message);
  }

  // One command at a time; while it is carried out only the newest direction waits.
  async #point() {
    this.#hasMore = true;
    if (this.#isSending) return;
    this.#isSending = true;
    while (this.#hasMore) {
      this.#hasMore = false;
      const view = this.pointed.find(({ name }) => name === this.choice.value)?.index;
      if (view === undefined) break;
      const { yaw, pitch, fov: h_fov } = this.gaze;
      const why = await command("point_view", { view, yaw, pitch, h_fov });
      setText(this.said, why ? texts.refused(why) : "");
    }
    this.#isSending = false;
  }
}
