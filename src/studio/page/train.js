// Trains: the pair put on, gear after gear, in a row or by hand.

import { takeTrain } from "./away.js";
import { pathOf, reach } from "./curves.js";
import { el, fill, toast } from "./dom.js";
import { icon } from "./icons.js";
import { clamp, degrees } from "./numbers.js";
import { bare } from "./store.js";
import { T } from "./texts.js";
import { color, onTheme } from "./theme.js";

const LAYOUTS = ["auto", "straight", "zigzag", "arc", "ring", "free"];
const FIRST = { layout: "auto", gears: 4, links: [] };
const MOST = 60;
// Room that the panel at the foot takes, px.
const FOOT = 150;

const turned = (direction) => ((direction + 540) % 360 + 360) % 360 - 180;

export class TrainView {
  constructor(transport, store) {
    Object.assign(this, { transport, store, model: {}, chosen: null, phi: 0, before: 0, axes: [] });
    this.canvas = el("canvas", { tabindex: "0", role: "img", "aria-label": T.trainLabel });
    this.note = el("div", { class: "waiting", hidden: true });
    this.panel = el("div", { class: "strip" });
    this.node = el("div", { class: "train", hidden: true }, this.canvas, this.note, this.panel);
    this.view = { x: 0, y: 0, scale: 1 };
    this.build();
    transport.listen((angle) => this.turn(angle));
    onTheme(() => this.draw());
    new ResizeObserver(() => { if (!this.isOwn) this.fit(); this.draw(); }).observe(this.node);
    this.listen();
  }

  get train() { return this.store.state.train || FIRST; }

  build() {
    this.rows = LAYOUTS.map((layout) => el("button", { type: "button", class: "small", role: "radio", data: { layout }, onclick: () => this.lay(layout) }, T.layouts[layout]));
    this.fewer = el("button", { type: "button", class: "small icon", "aria-label": T.fewerGears, title: T.fewerGears, onclick: () => this.remove() }, "−");
    this.count = el("output", { class: "number" });
    this.add = el("button", { type: "button", class: "small primary", onclick: () => this.more() }, T.addGear);
    this.chips = el("div", { class: "chips", role: "group", "aria-label": T.gearsOfTrain });
    this.status = el("p", { class: "status", role: "status" });
    this.zip = el("button", { type: "button", class: "small", onclick: () => this.take("download") }, icon("save"), T.trainZip);
    this.write = el("button", { type: "button", class: "small", onclick: () => this.take("folder") }, T.trainFolder);
    fill(this.panel,
      el("div", { class: "row" },
        el("div", { class: "row tight", role: "radiogroup", "aria-label": T.trainLayout }, this.rows), el("span", { class: "stretch" }),
        this.fewer, this.count, this.add),
      el("div", { class: "row" }, this.chips, el("span", { class: "stretch" }), this.zip, this.write),
      this.status);
    this.chips.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: 1, ArrowUp: 1, ArrowRight: -1, ArrowDown: -1 }[event.key];
      if (!by || !this.chosen) return;
      event.preventDefault();
      event.stopPropagation();
      this.swing(this.chosen, this.links()[this.chosen - 1].direction + by * (event.shiftKey ? 15 : 1), false);
    });
  }

  open(on) {
    this.node.hidden = !on;
    if (on) { this.panels(); this.want(); }
  }

  show(model) {
    const fresh = model.gears !== this.model.gears;
    this.model = model;
    if (fresh && model.gears) {
      const { outlines, bores } = model.gears;
      this.shapes = [0, 1].map((i) => {
        const path = pathOf(outlines[i]);
        if (bores[i]) path.addPath(pathOf(bores[i]));
        return { path, reach: reach(outlines[i]) };
      });
    }
    if (!this.node.hidden) { this.panels(); this.want(); }
  }

  links() {
    const { train } = this;
    return train.layout === "free" ? train.links : (this.data?.links || []).map((l) => ({ ...l }));
  }

  edit(train, live = false) { this.store.edit((s) => { s.train = train; }, { live }); this.panels(); this.want(); }

  lay(layout) {
    const { gears } = this.train;
    this.isOwn = false;
    this.edit({ layout, gears, links: layout === "free" ? this.links().slice(0, gears - 1) : [] });
  }

  more() {
    const { layout, gears } = this.train;
    if (gears >= MOST) return;
    this.isOwn = false;
    if (layout !== "free") { this.edit({ layout, gears: gears + (layout === "ring" ? 2 : 1), links: [] }); return; }
    const links = this.links();
    const on = this.chosen ?? links.length;
    // A branch turns away from what hangs there already.
    const last = links[on - 1]?.direction ?? 0;
    const direction = links.some((l) => l.on === on) ? turned(last + 120) : last;
    this.chosen = links.length + 1;
    this.edit({ layout, gears: links.length + 2, links: [...links, { on, direction }] });
  }

  remove() {
    const { layout, gears } = this.train;
    const least = layout === "ring" ? 4 : 2;
    if (gears <= least) return;
    this.isOwn = false;
    if (layout !== "free") { this.edit({ layout, gears: gears - (layout === "ring" ? 2 : 1), links: [] }); return; }
    const links = this.links().slice(0, -1);
    if (this.chosen > links.length) this.chosen = null;
    this.edit({ layout, gears: links.length + 1, links });
  }

  // Hangs a gear in another direction; from now on the train is put by hand.
  swing(gear, direction, live) {
    const links = this.links();
    if (!links[gear - 1]) return;
    links[gear - 1] = { ...links[gear - 1], direction: Math.round(10 * turned(direction)) / 10 };
    this.placeAxes(links);
    this.edit({ layout: "free", gears: links.length + 1, links }, live);
    this.draw();
  }

  // The axes follow at once; how the gears turn comes from the server.
  placeAxes(links) {
    const distance = this.model.sized?.distance || 1;
    const axes = [[0, 0]];
    for (const { on, direction } of links) {
      const [x, y] = axes[on] || [0, 0];
      axes.push([x + distance * Math.cos((direction * Math.PI) / 180), y + distance * Math.sin((direction * Math.PI) / 180)]);
    }
    this.axes = axes;
  }

  panels() {
    const { layout, gears } = this.train;
    for (const row of this.rows) {
      const on = row.dataset.layout === layout;
      row.setAttribute("aria-checked", String(on));
      row.classList.toggle("on", on);
    }
    this.count.textContent = T.gearCount(gears);
    const count = layout === "free" ? gears : this.data?.gears.length || gears;
    if (this.chips.childElementCount !== count) {
      fill(this.chips, Array.from({ length: count }, (_, i) => el("button", { type: "button", class: "chip", "aria-label": i ? T.gearNumber(i + 1) : T.gearFirst, onclick: () => { this.chosen = i || null; this.panels(); this.draw(); } }, String(i + 1))));
    }
    Array.from(this.chips.children).forEach((chip, i) => chip.setAttribute("aria-pressed", String(i === (this.chosen ?? 0))));
    const ready = this.model.stage === "proven";
    this.note.hidden = ready || Boolean(this.data);
    this.note.textContent = this.model.refused ? this.model.refused.text : T.trainComing;
    // For whoever drives the page by a program.
    this.node.dataset.asked = this.data && !this.asking && !this.again ? "yes" : "no";
    this.node.dataset.axes = JSON.stringify(this.axes.map((p) => this.onScreen(p)));
    const { fault, at } = this.data || {};
    const said = this.asking ? null : this.failed || fault;
    this.status.classList.toggle("bad", Boolean(said));
    fill(this.status, said ? sentence(said) : this.asking ? T.trainAsking : this.data ? T.trainStands : "",
      said && !this.failed && Number.isFinite(at) ? el("button", { type: "button", class: "link", onclick: () => { this.transport.play(false); this.phi = at; this.draw(); } }, T.showIt) : null);
    this.zip.disabled = this.write.disabled = !ready || Boolean(said) || this.busy;
  }

  // Asks how the train stands; one question at a time, the newest next.
  async want() {
    if (this.model.stage !== "proven" || this.node.hidden) return;
    const asked = JSON.stringify({ state: bare(this.store.state), train: this.train });
    if (asked === this.answered || asked === this.asking) return;
    if (this.asking) { this.again = true; return; }
    this.asking = asked;
    this.panels();
    try {
      const answer = await fetch("api/train", { method: "POST", headers: { "content-type": "application/json" }, body: asked });
      const said = await answer.json();
      this.failed = answer.ok ? null : said.text;
      if (answer.ok) {
        const had = this.data?.gears.length;
        this.data = said;
        this.placed = asked;
        if (!this.again) this.axes = said.gears.map((g) => g.axis);
        if (had !== said.gears.length || !this.isOwn) this.fit();
      }
      this.answered = asked;
    } catch { /* the connection comes back, and with it the question */ }
    this.asking = null;
    this.panels();
    this.draw();
    if (this.again) { this.again = false; this.want(); }
  }

  async take(place) {
    this.busy = true;
    this.panels();
    this.status.textContent = `${T.making} …`;
    try {
      const said = await takeTrain(this.store.state, this.train, place);
      toast(place === "folder" ? T.written(said.files.length, said.folder) : T.trainTaken);
    } catch (error) {
      toast(error.message, "bad");
    }
    this.busy = false;
    this.panels();
  }

  turn(angle) {
    const whole = this.transport.cycle;
    let by = angle - this.before;
    if (by < -whole / 2) by += whole;
    if (by > whole / 2) by -= whole;
    this.before = angle;
    if (!this.data) return;
    const { cycle } = this.data;
    this.phi = (((this.phi + by) % cycle) + cycle) % cycle;
    this.draw();
  }

  angleOf({ start, angle }) {
    const at = clamp(this.phi / this.data.cycle, 0, 1) * (angle.length - 1);
    const low = Math.min(angle.length - 2, Math.floor(at));
    return start + angle[low] + (angle[low + 1] - angle[low]) * (at - low);
  }

  fit() {
    const box = this.node.getBoundingClientRect();
    if (!this.data || !this.shapes || !box.width) return;
    let [left, right, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
    this.axes.forEach(([x, y], i) => {
      const r = this.shapes[this.data.gears[i]?.side === "follower" ? 1 : 0].reach;
      [left, right, low, high] = [Math.min(left, x - r), Math.max(right, x + r), Math.min(low, y - r), Math.max(high, y + r)];
    });
    const room = Math.max(120, box.height - FOOT - 70);
    const scale = 0.94 * Math.min(box.width / (right - left), room / (high - low));
    this.view = { x: (left + right) / 2, y: (low + high) / 2 - (FOOT - 60) / 2 / scale, scale };
    this.isOwn = false;
  }

  draw() {
    const box = this.node.getBoundingClientRect();
    if (!box.width) return;
    const ratio = devicePixelRatio || 1;
    const [w, h] = [Math.round(box.width * ratio), Math.round(box.height * ratio)];
    if (this.canvas.width !== w || this.canvas.height !== h) [this.canvas.width, this.canvas.height] = [w, h];
    const c = this.canvas.getContext("2d");
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.fillStyle = color("paper");
    c.fillRect(0, 0, w, h);
    if (!this.data || !this.shapes) return;
    const { x, y, scale } = this.view;
    const px = 1 / scale;
    const base = () => c.setTransform(scale * ratio, 0, 0, -scale * ratio, w / 2 - x * scale * ratio, h / 2 + y * scale * ratio);
    const clash = new Set(this.data.clash || []);
    c.lineJoin = "round";
    this.data.gears.forEach((gear, i) => {
      const side = gear.side === "follower" ? 1 : 0;
      const [ax, ay] = this.axes[i] || gear.axis;
      base();
      c.translate(ax, ay);
      c.rotate(this.angleOf(gear));
      c.fillStyle = color(clash.has(i) ? "bad" : side ? "follower" : "driver");
      c.strokeStyle = color(side ? "follower-edge" : "driver-edge");
      c.globalAlpha = clash.has(i) ? 0.55 : 1;
      c.lineWidth = px;
      c.fill(this.shapes[side].path, "evenodd");
      c.globalAlpha = 1;
      c.stroke(this.shapes[side].path);
    });
    base();
    c.strokeStyle = color("ink");
    c.globalAlpha = 0.4;
    c.setLineDash([10 * px, 4 * px]);
    c.lineWidth = px;
    c.beginPath();
    for (const [a, b] of this.data.meshes) {
      if (!this.axes[a] || !this.axes[b]) continue;
      c.moveTo(...this.axes[a]);
      c.lineTo(...this.axes[b]);
    }
    c.stroke();
    c.setLineDash([]);
    c.globalAlpha = 1;
    const size = 11;
    c.textAlign = "center";
    c.textBaseline = "middle";
    c.font = `600 ${size}px system-ui, sans-serif`;
    this.axes.forEach(([ax, ay], i) => {
      c.setTransform(ratio, 0, 0, ratio, w / 2 + (ax - x) * scale * ratio, h / 2 - (ay - y) * scale * ratio);
      const on = i === (this.chosen ?? 0);
      c.beginPath();
      c.arc(0, 0, size, 0, 7);
      c.fillStyle = color(on ? "accent" : "card");
      c.fill();
      c.strokeStyle = color(on ? "card" : "edge");
      c.lineWidth = 1.5;
      c.stroke();
      c.fillStyle = color(on ? "accent-ink" : "ink");
      c.fillText(String(i + 1), 0, 0.5);
    });
  }

  world(event) {
    const box = this.canvas.getBoundingClientRect();
    const { x, y, scale } = this.view;
    return [x + (event.clientX - box.left - box.width / 2) / scale, y - (event.clientY - box.top - box.height / 2) / scale];
  }

  onScreen([px, py]) {
    const { x, y, scale } = this.view;
    return [this.canvas.clientWidth / 2 + (px - x) * scale, this.canvas.clientHeight / 2 - (py - y) * scale];
  }

  gearAt([x, y]) {
    let [best, least] = [-1, Infinity];
    this.axes.forEach(([ax, ay], i) => {
      const off = Math.hypot(x - ax, y - ay) / this.shapes[this.data.gears[i]?.side === "follower" ? 1 : 0].reach;
      if (off < least) [best, least] = [i, off];
    });
    return least < 0.9 ? best : -1;
  }

  listen() {
    const { canvas } = this;
    let hold = null;
    canvas.addEventListener("pointerdown", (event) => {
      if (!this.data || !this.shapes) return;
      canvas.setPointerCapture(event.pointerId);
      const at = this.world(event);
      const gear = this.gearAt(at);
      hold = { at, gear, x: event.clientX, y: event.clientY, off: gear > 0 ? [this.axes[gear][0] - at[0], this.axes[gear][1] - at[1]] : null, moved: false };
      if (gear >= 0) { this.chosen = gear || null; this.panels(); this.draw(); }
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!hold) { canvas.classList.toggle("grab", Boolean(this.data) && this.gearAt(this.world(event)) > 0); return; }
      if (!hold.moved && Math.hypot(event.clientX - hold.x, event.clientY - hold.y) < 4) return;
      hold.moved = true;
      if (hold.gear > 0) { this.isOwn = true; this.hang(hold, event, true); return; }
      this.view.x -= (event.clientX - hold.x) / this.view.scale;
      this.view.y += (event.clientY - hold.y) / this.view.scale;
      [hold.x, hold.y] = [event.clientX, event.clientY];
      this.isOwn = true;
      this.draw();
    });
    const up = (event) => {
      if (hold?.moved && hold.gear > 0) this.hang(hold, event, false);
      hold = null;
    };
    canvas.addEventListener("pointerup", up);
    canvas.addEventListener("pointercancel", up);
    canvas.addEventListener("dblclick", () => { this.fit(); this.draw(); });
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      const [wx, wy] = this.world(event);
      const by = Math.exp(-event.deltaY * 0.0016);
      this.view.x = wx + (this.view.x - wx) / by;
      this.view.y = wy + (this.view.y - wy) / by;
      this.view.scale *= by;
      this.isOwn = true;
      this.draw();
    }, { passive: false });
  }

  hang({ gear, off }, event, live) {
    const at = this.world(event);
    const on = this.links()[gear - 1]?.on ?? gear - 1;
    const [x, y] = this.axes[on];
    this.swing(gear, degrees(Math.atan2(at[1] + off[1] - y, at[0] + off[0] - x)), live);
  }
}

const sentence = (text) => `${text.charAt(0).toUpperCase()}${text.slice(1)} `;
