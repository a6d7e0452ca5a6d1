// A wanted motion: a formula, or a curve whose points are dragged and which becomes one.

import { el } from "./dom.js";
import { T } from "./texts.js";
import { color, onTheme } from "./theme.js";

const POINTS = 12;
const RANGE = [0.25, 2];

// The trigonometric polynomial through even samples, as a formula.
export const formulaOf = (values) => {
  const n = values.length;
  const mean = values.reduce((a, b) => a + b, 0) / n;
  const terms = [];
  for (let k = 1; k <= n / 2; k += 1) {
    let [a, b] = [0, 0];
    values.forEach((v, i) => { a += v * Math.cos((2 * Math.PI * k * i) / n); b += v * Math.sin((2 * Math.PI * k * i) / n); });
    const weight = (k === n / 2 ? 1 : 2) / n / mean;
    for (const [name, part] of [["cos", a * weight], ["sin", b * weight]]) {
      if (Math.abs(part) >= 5e-4) terms.push(`${part < 0 ? "-" : "+"} ${Math.abs(part).toFixed(3)}*${name}(${k === 1 ? "" : `${k}*`}phi)`);
    }
  }
  return ["1", ...terms].join(" ");
};

export class Law {
  constructor(store) {
    this.store = store;
    this.text = el("textarea", { rows: 2, id: "law", spellcheck: false, onchange: () => this.set(this.text.value, false) });
    this.canvas = el("canvas", { tabindex: "0", role: "img", "aria-label": T.lawPoints });
    this.why = el("p", { class: "why", role: "alert", hidden: true });
    this.node = el("section", { class: "panel law" }, el("label", { htmlFor: "law" }, T.law), this.text, this.why, el("p", { class: "calm" }, T.lawHelp), this.canvas);
    this.values = new Array(POINTS).fill(1);
    this.listen();
    onTheme(() => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.canvas);
  }

  set(text, live) { this.store.edit((s) => { s.law = text.trim() || null; }, { live }); }

  show(state, model) {
    this.node.hidden = state.way !== "motion";
    if (this.node.hidden) return;
    if (document.activeElement !== this.text) this.text.value = state.law ?? "";
    const said = model.refused && (model.refused.option === "law" || !model.refused.option) ? model.refused.text : "";
    this.why.textContent = said;
    this.why.hidden = !said;
    const speed = model.sized?.speed;
    if (speed && !this.holding) {
      const turn = (2 * Math.PI) / model.sized.cycle;
      this.values = this.values.map((_, i) => speed[Math.round(((i / POINTS) * turn % 1) * (speed.length - 1))]);
    }
    this.draw();
  }

  place(i) {
    const [low, high] = RANGE;
    return [((i + 0.5) / POINTS) * this.width, this.height * (1 - (this.values[i] - low) / (high - low))];
  }

  draw() {
    const box = this.canvas.getBoundingClientRect();
    if (!box.width) return;
    const ratio = devicePixelRatio || 1;
    [this.width, this.height] = [box.width, box.height];
    this.canvas.width = box.width * ratio;
    this.canvas.height = box.height * ratio;
    const c = this.canvas.getContext("2d");
    c.scale(ratio, ratio);
    const one = this.height * (1 - (1 - RANGE[0]) / (RANGE[1] - RANGE[0]));
    c.strokeStyle = color("edge");
    c.beginPath(); c.moveTo(0, one); c.lineTo(this.width, one); c.stroke();
    c.strokeStyle = color("s0");
    c.lineWidth = 2;
    c.beginPath();
    // The same trigonometric polynomial as the formula.
    for (let x = 0; x <= this.width; x += 3) {
      const at = (x / this.width) * POINTS - 0.5;
      let sum = 0;
      let weight = 0;
      for (let i = 0; i < POINTS; i += 1) {
        const d = (Math.PI * (at - i)) / POINTS;
        const kernel = Math.abs(Math.sin(d)) < 1e-6 ? 1 : Math.sin(POINTS * d) / (POINTS * Math.tan(d));
        sum += kernel * this.values[i];
        weight += kernel;
      }
      const y = this.height * (1 - (sum / weight - RANGE[0]) / (RANGE[1] - RANGE[0]));
      c[x ? "lineTo" : "moveTo"](x, y);
    }
    c.stroke();
    this.values.forEach((_, i) => {
      const [x, y] = this.place(i);
      c.beginPath(); c.arc(x, y, 5, 0, 7);
      c.fillStyle = color("card"); c.fill(); c.stroke();
    });
  }

  listen() {
    const at = (event) => {
      const box = this.canvas.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    const move = (event, live) => {
      const [, y] = at(event);
      const value = RANGE[1] - (y / this.height) * (RANGE[1] - RANGE[0]);
      this.values[this.index] = Math.min(RANGE[1], Math.max(RANGE[0], value));
      this.draw();
      this.store.edit((s) => { s.law = formulaOf(this.values); delete s.options.psi; delete s.options.centrode; delete s.options.preset; delete s.options.ratio; }, { live });
    };
    this.canvas.addEventListener("pointerdown", (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      this.index = Math.min(POINTS - 1, Math.max(0, Math.floor((at(event)[0] / this.width) * POINTS)));
      this.holding = true;
      move(event, true);
    });
    this.canvas.addEventListener("pointermove", (event) => { if (this.holding) move(event, true); });
    this.canvas.addEventListener("pointerup", (event) => { if (this.holding) { move(event, false); this.holding = false; } });
  }
}
