// A photograph behind the silhouette found in it, and the threshold that finds it.

import { el, svg } from "./dom.js";
import { kept } from "./shelf.js";
import { T } from "./texts.js";

const IMAGE = /\.(png|jpe?g|bmp)$/i;
// Grey in the middle, where the program has not said what it chose.
const MIDDLE = 128;

export const isImage = (drawing) => Boolean(drawing?.id && /\.(png|jpe?g|bmp|tiff?)$/i.test(drawing.name));

// An SVG image that lies where the outline's pixels are.
export class Photo {
  constructor() {
    this.node = svg("image", { class: "photo", preserveAspectRatio: "none", "aria-hidden": "true" });
  }

  async show(drawing) {
    const id = drawing && IMAGE.test(drawing.name) ? drawing.id : null;
    if (id === this.id) return;
    this.id = id;
    this.node.removeAttribute("href");
    if (this.url) URL.revokeObjectURL(this.url);
    const file = id && await kept(id);
    if (!file || this.id !== id) return;
    const blob = new Blob([file.bytes]);
    try {
      const { width, height } = await createImageBitmap(blob);
      this.url = URL.createObjectURL(blob);
      for (const [name, value] of [["href", this.url], ["x", 0], ["y", -height], ["width", width], ["height", height]]) this.node.setAttribute(name, value);
    } catch { /* a picture that the browser cannot show is read all the same */ }
  }
}

export class Threshold {
  constructor(store) {
    this.slider = el("input", { type: "range", min: 0, max: 255, step: 1, id: "photo-threshold",
      oninput: () => store.setOption("threshold", this.slider.value, { live: true }),
      onchange: () => store.setOption("threshold", this.slider.value) });
    this.readout = el("output", { class: "number" });
    this.auto = el("button", { type: "button", class: "link", onclick: () => store.setOption("threshold", null) }, T.chosen);
    this.node = el("div", { class: "photo-row", hidden: true }, el("label", { htmlFor: "photo-threshold" }, T.threshold), this.slider, this.readout, this.auto);
  }

  show(state) {
    this.node.hidden = state.way === "motion" || ![state.driver, state.follower].some(isImage);
    const value = state.options.threshold;
    this.slider.value = value ?? MIDDLE;
    this.slider.style.setProperty("--part", `${(100 * Number(this.slider.value)) / 255}%`);
    this.slider.classList.toggle("idle", value === undefined);
    this.readout.textContent = value ?? "";
    this.auto.hidden = value === undefined;
  }
}
