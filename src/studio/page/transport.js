// Which angle the driver stands at, and how it turns.

import { el } from "./dom.js";
import { icon } from "./icons.js";
import { degrees, shown } from "./numbers.js";
import { T } from "./texts.js";

const SECONDS_PER_TURN = 12;
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];

export class Transport {
  constructor() {
    this.angle = 0;
    this.cycle = 2 * Math.PI;
    this.speed = 1;
    this.playing = false;
    this.listeners = new Set();
    this.button = el("button", { type: "button", class: "play primary", onclick: () => this.play(!this.playing) });
    this.slider = el("input", {
      type: "range", min: 0, max: 360, step: 0.25, value: 0, "aria-label": T.driverAngle,
      oninput: () => { this.play(false); this.goTo((Number(this.slider.value) * Math.PI) / 180); },
    });
    this.readout = el("output", { class: "number" });
    this.choice = el("select", { "aria-label": T.speed, onchange: () => { this.speed = Number(this.choice.value); } },
      SPEEDS.map((s) => el("option", { value: s, selected: s === 1 }, T.times(s))));
    this.node = el("div", { class: "transport" }, this.button, this.slider, this.readout, this.choice);
    this.play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
    this.show();
  }

  listen(listener) { this.listeners.add(listener); }

  setCycle(cycle) {
    if (Math.abs(cycle - this.cycle) < 1e-9) return;
    this.cycle = cycle;
    this.angle = Math.min(this.angle, cycle);
    this.slider.max = degrees(cycle).toFixed(2);
    this.show();
  }

  play(on) {
    if (on && !this.playing) {
      let before = performance.now();
      const step = (now) => {
        if (!this.playing) return;
        const elapsed = Math.min(0.1, Math.max(0, (now - before) / 1000));
        before = now;
        this.goTo((this.angle + (elapsed * this.speed * 2 * Math.PI) / SECONDS_PER_TURN) % this.cycle);
        requestAnimationFrame(step);
      };
      requestAnimationFrame(step);
    }
    this.playing = on;
    this.button.replaceChildren(icon(on ? "pause" : "play"));
    this.button.setAttribute("aria-label", on ? T.pause : T.play);
    this.button.title = on ? T.pause : T.play;
  }

  goTo(angle) {
    const round = angle % this.cycle;
    this.angle = round < 0 ? round + this.cycle : angle > this.cycle ? round : angle;
    this.show();
  }

  show() {
    this.slider.value = String(degrees(this.angle));
    this.slider.style.setProperty("--part", `${(100 * this.angle) / this.cycle}%`);
    this.readout.textContent = `${shown(degrees(this.angle), 1)}°`;
    for (const listener of this.listeners) listener(this.angle);
  }
}
