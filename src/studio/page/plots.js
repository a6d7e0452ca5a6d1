// Curves over the driver's angle, with a line where the gears stand; hovering turns them.

import { el, fill } from "./dom.js";
import { degrees, shown } from "./numbers.js";
import { T } from "./texts.js";
import { color, onTheme } from "./theme.js";

const PAD = 6;

class Plot {
  constructor(transport) {
    this.transport = transport;
    this.canvas = el("canvas", { tabindex: "0", role: "img" });
    this.name = el("span");
    this.readout = el("output");
    this.node = el("figure", { class: "plot" }, el("figcaption", {}, this.name, this.readout), this.canvas);
    const aim = (event) => {
      const box = this.canvas.getBoundingClientRect();
      const part = (event.clientX - box.left - PAD) / (box.width - 2 * PAD);
      transport.play(false);
      transport.goTo(Math.min(0.99999, Math.max(0, part)) * transport.cycle);
    };
    this.canvas.addEventListener("pointermove", (event) => { if (event.pointerType === "mouse" || event.buttons) aim(event); });
    this.canvas.addEventListener("pointerdown", aim);
    new ResizeObserver(() => { this.picture = null; this.draw(); }).observe(this.canvas);
  }

  // series: [{ y: numbers evenly over the cycle }]
  set({ title, unit, series, places, zero }) {
    this.name.textContent = title;
    this.canvas.setAttribute("aria-label", title);
    Object.assign(this, { unit, series, places });
    const all = series.flatMap((s) => s.y);
    let [low, high] = [Math.min(...all), Math.max(...all)];
    if (zero) [low, high] = [Math.min(0, low), Math.max(0, high)];
    const span = high - low || Math.max(1e-6, Math.abs(high) * 0.1);
    this.range = [low - span * 0.08, high + span * 0.08];
    this.picture = null;
    this.draw();
  }

  x(part) { return PAD + part * (this.width - 2 * PAD); }
  y(value) { return this.height - ((value - this.range[0]) / (this.range[1] - this.range[0])) * this.height; }

  // The curves without the line that moves.
  paint(c, ratio) {
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    if (this.range[0] < 0 && this.range[1] > 0) {
      c.strokeStyle = color("edge");
      c.beginPath(); c.moveTo(0, this.y(0)); c.lineTo(this.width, this.y(0)); c.stroke();
    }
    this.series.forEach(({ y }, i) => {
      c.strokeStyle = color(`s${i}`);
      c.lineWidth = 1.6;
      c.lineJoin = "round";
      c.beginPath();
      y.forEach((value, k) => c[k ? "lineTo" : "moveTo"](this.x(k / (y.length - 1)), this.y(value)));
      c.stroke();
    });
  }

  draw() {
    const box = this.canvas.getBoundingClientRect();
    if (!this.series || !box.width) return;
    const ratio = devicePixelRatio || 1;
    const c = this.canvas.getContext("2d");
    if (!this.picture) {
      [this.width, this.height] = [box.width - 2, box.height - 2];
      this.canvas.width = Math.round(this.width * ratio);
      this.canvas.height = Math.round(this.height * ratio);
      this.picture = document.createElement("canvas");
      [this.picture.width, this.picture.height] = [this.canvas.width, this.canvas.height];
      this.paint(this.picture.getContext("2d"), ratio);
    }
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.clearRect(0, 0, this.canvas.width, this.canvas.height);
    c.drawImage(this.picture, 0, 0);
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    const part = this.transport.angle / this.transport.cycle;
    c.strokeStyle = color("soft");
    c.lineWidth = 1;
    c.beginPath(); c.moveTo(this.x(part), 0); c.lineTo(this.x(part), this.height); c.stroke();
    const values = this.series.map(({ y }, i) => {
      const value = y[Math.round(part * (y.length - 1))];
      c.fillStyle = color(`s${i}`);
      c.beginPath(); c.arc(this.x(part), this.y(value), 3, 0, 7); c.fill();
      return shown(value, this.places);
    });
    this.readout.textContent = `${values.join(" / ")}${this.unit}`;
  }
}

export class Plots {
  constructor(transport) {
    this.transport = transport;
    this.plots = {};
    this.body = el("div");
    this.node = el("section", { class: "panel" }, el("h2", {}, T.plots), this.body);
    transport.listen(() => this.turn());
    onTheme(() => { for (const plot of Object.values(this.plots)) { plot.picture = null; plot.draw(); } });
  }

  turn() {
    if (this.node.offsetParent) for (const plot of Object.values(this.plots)) plot.draw();
  }

  show(model) {
    const { sized, analysed } = model;
    if (!sized) return;
    const given = { speed: { title: T.plotSpeed, unit: "", series: [{ y: sized.speed }], places: 3 },
      psi: { title: T.plotPsi, unit: "°", series: [{ y: sized.psi.map(degrees) }], places: 1 } };
    if (analysed) {
      given.error = { title: T.plotError, unit: "°", series: [{ y: analysed.error.map(degrees) }], places: 3 };
      given.backlash = { title: T.plotBacklash, unit: "°", series: [{ y: analysed.backlash.map(degrees) }], places: 3, zero: true };
    }
    const run = model.runs?.find((r) => !r.backward && !r.motor) || model.runs?.[0];
    if (run) given.torque = { title: T.plotTorque, unit: " N mm", series: overCycle(run, sized.cycle), places: 0, zero: true };
    given.slope = { title: T.plotSlope, unit: "°", series: [{ y: sized.slope.map(degrees) }], places: 1, zero: true };
    const keys = Object.keys(given);
    if (keys.join() !== Object.keys(this.plots).join()) {
      this.plots = Object.fromEntries(keys.map((key) => [key, this.plots[key] || new Plot(this.transport)]));
      fill(this.body, Object.values(this.plots).map((p) => p.node));
    }
    for (const key of keys) this.plots[key].set(given[key]);
  }
}

// Torque of a run over one cycle: what was asked for by psi' and what it was.
const overCycle = (run, cycle) => {
  const count = 360;
  const lists = [new Array(count + 1).fill(0), new Array(count + 1).fill(0)];
  run.driver.forEach((angle, i) => {
    const at = Math.round((((angle % cycle) + cycle) % cycle / cycle) * count);
    lists[0][at] = run.ideal[i];
    lists[1][at] = run.torque[i];
  });
  for (const list of lists) for (let i = 1; i <= count; i += 1) if (!list[i]) list[i] = list[i - 1];
  for (const list of lists) if (!list[0]) list[0] = list[count];
  return lists.map((y) => ({ y }));
};
