// Other pairs that the same drawings make, small and turning; one click takes one.

import { pathOf, reach } from "./curves.js";
import { el, fill } from "./dom.js";
import { shown } from "./numbers.js";
import { T } from "./texts.js";
import { color, onTheme } from "./theme.js";

const [WIDTH, HEIGHT] = [112, 62];

class Small {
  constructor(pair, number, store) {
    Object.assign(this, { pair, number });
    this.canvas = el("canvas", { "aria-hidden": "true" });
    const text = pair.likeness.map((s) => `${shown(100 * s, 0)} %`).join(" · ");
    const take = () => store.edit((s) => {
      for (const key of ["driver-axis", "follower-axis", "orientation", "choose"]) delete s.options[key];
      if (number > 1) s.options.choose = String(number);
    });
    this.node = el("button", { type: "button", title: T.alternative(number), "aria-label": `${T.alternative(number)}: ${text}, ${shown(pair.torque, 2)} ×`, onclick: take },
      this.canvas, el("span", { class: "figures" }, el("span", {}, text), el("span", {}, `${shown(pair.torque, 1)} ×`)));
    this.paths = { pitch: pair.pitch.map(pathOf), ghosts: pair.ghosts.map(pathOf) };
    const [a, b] = [0, 1].map((i) => Math.max(reach(pair.pitch[i]), reach(pair.ghosts[i])));
    this.box = { left: -a, right: 1 + b, height: 2 * Math.max(a, b) };
  }

  draw(angle) {
    const ratio = devicePixelRatio || 1;
    if (this.canvas.width !== WIDTH * ratio) [this.canvas.width, this.canvas.height] = [WIDTH * ratio, HEIGHT * ratio];
    const c = this.canvas.getContext("2d");
    const { left, right, height } = this.box;
    const scale = 0.94 * ratio * Math.min(WIDTH / (right - left), HEIGHT / height);
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.clearRect(0, 0, this.canvas.width, this.canvas.height);
    const { psi, cycle } = this.pair;
    const at = ((angle % cycle) / cycle) * (psi.length - 1);
    const low = Math.min(psi.length - 2, Math.floor(at));
    const turns = [angle, -(psi[low] + (psi[low + 1] - psi[low]) * (at - low))];
    for (const i of [0, 1]) {
      c.setTransform(scale, 0, 0, -scale, (WIDTH * ratio) / 2 + scale * (i - (left + right) / 2), (HEIGHT * ratio) / 2);
      c.rotate(turns[i]);
      c.fillStyle = color(i ? "follower" : "driver");
      c.fill(this.paths.pitch[i]);
      c.strokeStyle = color("ink");
      c.globalAlpha = 0.6;
      c.lineWidth = (0.8 * ratio) / scale;
      c.stroke(this.paths.ghosts[i]);
      c.globalAlpha = 1;
    }
  }
}

export class Alternatives {
  constructor(store, transport) {
    Object.assign(this, { store, transport, pairs: [] });
    this.node = el("section", { class: "alternatives", "aria-label": T.alternatives, hidden: true });
    transport.listen((angle) => { if (!this.node.hidden) for (const pair of this.pairs) pair.draw(angle); });
    onTheme(() => { for (const pair of this.pairs) pair.draw(transport.angle); });
  }

  show(model) {
    if (model.alternatives !== this.known) {
      this.known = model.alternatives;
      this.pairs = (model.alternatives || []).map((pair, i) => new Small(pair, i + 1, this.store));
      fill(this.node, this.pairs.map((p) => p.node));
      for (const pair of this.pairs) pair.draw(this.transport.angle);
    }
    // The strip keeps its place while pairs are looked for: the stage must not jump.
    this.node.hidden = this.store.state.way !== "design" || this.store.state.options.symmetric !== undefined;
    if (!this.pairs.length && !this.node.hidden && !this.node.querySelector(".calm")) fill(this.node, el("p", { class: "calm" }, T.alternativesComing));
    const { options } = this.store.state;
    const held = ["driver-axis", "follower-axis", "orientation"].some((key) => options[key] !== undefined);
    for (const { node, number } of this.pairs) node.setAttribute("aria-pressed", String(!held && number === Number(options.choose || 1)));
  }
}
