// The pair, large: drawn on a canvas, turned, zoomed and grasped.

import { reach } from "./curves.js";
import { el } from "./dom.js";
import { icon } from "./icons.js";
import { clamp } from "./numbers.js";
import { T } from "./texts.js";
import { color, onTheme } from "./theme.js";

const MARGIN = 0.86;
const CLOSE_MODULES = 9;

const ringPath = (flat) => {
  const path = new Path2D();
  if (!flat || flat.length < 6) return path;
  path.moveTo(flat[0], flat[1]);
  for (let i = 2; i < flat.length; i += 2) path.lineTo(flat[i], flat[i + 1]);
  path.closePath();
  return path;
};

export class Stage {
  constructor(transport) {
    this.transport = transport;
    this.canvas = el("canvas", { tabindex: "0", role: "img", "aria-label": T.stageLabel });
    this.node = el("div", { class: "stage" }, this.canvas);
    this.view = { x: 40, y: 0, scale: 4 };
    this.isOwn = false;
    this.isClose = false;
    // Room at the foot that something else takes, px.
    this.foot = 0;
    this.layers = { ghost: true, pitch: true, contact: true };
    this.run = null;
    this.forces = null;
    this.scene = null;
    this.dirty = true;
    new ResizeObserver(() => this.resize()).observe(this.node);
    transport.listen(() => { this.dirty = true; });
    onTheme(() => { this.dirty = true; });
    this.listen();
    const frame = () => {
      if (this.isClose && this.scene) this.follow();
      this.glide();
      if (this.dirty) this.draw();
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  tools() {
    const layer = (name) => el("button", {
      type: "button", title: T.layers[name], "aria-label": T.layers[name], "aria-pressed": String(this.layers[name]),
      onclick: (event) => {
        this.layers[name] = !this.layers[name];
        event.currentTarget.setAttribute("aria-pressed", String(this.layers[name]));
        this.dirty = true;
      },
    }, icon(name));
    const act = (name, run) => el("button", { type: "button", title: T[name], "aria-label": T[name], onclick: run }, icon(name));
    return el("div", { class: "tools" },
      el("div", { class: "group layers" }, layer("ghost"), layer("pitch"), layer("contact")),
      el("div", { class: "group" }, act("mesh", () => this.toMesh()), act("fit", () => this.fit())));
  }

  // Takes the results; keeps the view.
  show(model) {
    const sized = model.sized;
    if (!sized) return;
    const first = !this.scene;
    const known = this.scene;
    const make = (flat, key, i) => (known && known.flat[key]?.[i] === flat ? known[key][i] : ringPath(flat));
    const flat = {
      outlines: model.gears ? model.gears.outlines : [null, null],
      bores: model.gears ? model.gears.bores : [null, null],
      pitch: sized.pitch,
      ghosts: sized.drawings.map((d) => d && d.ring),
    };
    const scene = { flat, distance: sized.distance, module: model.gears?.module ?? sized.distance / 30, psi: sized.psi, cycle: sized.cycle, teeth: model.gears?.teeth };
    for (const key of ["outlines", "bores", "pitch", "ghosts"]) scene[key] = [0, 1].map((i) => make(flat[key][i], key, i));
    scene.reach = [0, 1].map((i) => reach(flat.outlines[i] || flat.pitch[i]));
    scene.contacts = model.contacts || [];
    scene.forces = model.forces || null;
    scene.faded = !model.gears;
    this.scene = scene;
    this.transport.setCycle(sized.cycle);
    this.dirty = true;
    if (first) this.fit(true);
    else if (!this.isOwn) this.keepInView();
  }

  bounds() {
    const { reach: [a, b], distance } = this.scene;
    return { left: Math.min(-a, distance - b), right: Math.max(distance + b, a), height: 2 * Math.max(a, b) };
  }

  fitted() {
    const { left, right, height } = this.bounds();
    const scale = MARGIN * Math.min(this.width / (right - left), (this.height - 70 - this.foot) / height);
    return { x: (left + right) / 2, y: -this.foot / 2 / scale, scale };
  }

  fit(now = false) {
    if (!this.scene || !this.width) return;
    this.isOwn = false;
    this.isClose = false;
    this.goal = this.fitted();
    if (now) { this.view = this.goal; this.goal = null; }
    this.dirty = true;
  }

  // A pair that outgrows the frame, or shrinks to a corner of it, moves the frame once and softly.
  keepInView() {
    const want = this.fitted();
    const off = Math.abs(Math.log(want.scale / this.view.scale));
    const aside = Math.abs(want.x - this.view.x) * this.view.scale;
    if (off > 0.12 || aside > 60) this.goal = want;
  }

  glide() {
    if (!this.goal) return;
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const part = still ? 1 : 0.2;
    const { view, goal } = this;
    view.x += (goal.x - view.x) * part;
    view.y += (goal.y - view.y) * part;
    view.scale *= Math.pow(goal.scale / view.scale, part);
    if (Math.abs(Math.log(goal.scale / view.scale)) < 0.002 && Math.hypot(goal.x - view.x, goal.y - view.y) * view.scale < 0.5) {
      this.view = { ...goal };
      this.goal = null;
    }
    this.dirty = true;
  }

  followerAngle(phi) {
    const { psi, cycle } = this.scene;
    const at = clamp(phi / cycle, 0, 1) * (psi.length - 1);
    const low = Math.min(psi.length - 2, Math.floor(at));
    return psi[low] + (psi[low + 1] - psi[low]) * (at - low);
  }

  // The instant centre of rotation, where the pitch curves touch.
  pitchPoint() {
    const { cycle, distance } = this.scene;
    const phi = this.transport.angle;
    const d = cycle / 2000;
    const speed = (this.followerAngle(Math.min(cycle, phi + d)) - this.followerAngle(Math.max(0, phi - d)))
      / (Math.min(cycle, phi + d) - Math.max(0, phi - d));
    return (distance * speed) / (1 + speed);
  }

  toMesh() {
    if (!this.scene) return;
    this.goal = { x: this.pitchPoint(), y: 0, scale: Math.min(this.width, this.height) / (CLOSE_MODULES * this.scene.module) };
    this.isOwn = true;
    this.isClose = true;
  }

  // The close-up stays on the mesh while the gears turn.
  follow() {
    const x = this.pitchPoint();
    if (this.goal) { this.goal.x = x; return; }
    if (x === this.view.x) return;
    this.view.x = x;
    this.dirty = true;
  }

  poses() {
    const phi = this.transport.angle;
    if (this.run) return this.run(phi);
    return [phi, -this.followerAngle(phi)];
  }

  resize() {
    const box = this.node.getBoundingClientRect();
    if (!box.width || !box.height) return;
    const ratio = devicePixelRatio || 1;
    const had = this.width;
    [this.width, this.height] = [box.width, box.height];
    this.canvas.width = Math.round(box.width * ratio);
    this.canvas.height = Math.round(box.height * ratio);
    if (this.scene && (!had || !this.isOwn)) this.fit(true);
    this.draw();
  }

  draw() {
    this.dirty = false;
    if (!this.width) return;
    const ratio = devicePixelRatio || 1;
    const c = this.canvas.getContext("2d");
    const { x, y, scale } = this.view;
    const base = () => c.setTransform(scale * ratio, 0, 0, -scale * ratio, (this.width / 2 - x * scale) * ratio, (this.height / 2 + y * scale) * ratio);
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.clearRect(0, 0, this.canvas.width, this.canvas.height);
    base();
    this.ruling(c);
    if (!this.scene) return;
    const { distance, outlines, bores, pitch, ghosts, flat } = this.scene;
    const angles = this.poses();
    const px = 1 / scale;
    const axes = [0, distance];
    c.lineJoin = "round";
    for (const i of [0, 1]) {
      base();
      c.translate(axes[i], 0);
      c.rotate(angles[i]);
      const hasTeeth = Boolean(flat.outlines[i]);
      const body = new Path2D(hasTeeth ? outlines[i] : pitch[i]);
      if (flat.bores[i]) body.addPath(bores[i]);
      c.globalAlpha = hasTeeth ? 1 : 0.55;
      c.fillStyle = color(i ? "follower" : "driver");
      c.strokeStyle = color(i ? "follower-edge" : "driver-edge");
      c.lineWidth = px * 1.1;
      c.fill(body, "evenodd");
      c.stroke(body);
      c.globalAlpha = 1;
    }
    for (const i of [0, 1]) {
      base();
      c.translate(axes[i], 0);
      c.rotate(angles[i]);
      if (this.layers.ghost && flat.ghosts[i]) {
        c.strokeStyle = color("ink");
        c.globalAlpha = 0.62;
        c.lineWidth = px * 1.3;
        c.stroke(ghosts[i]);
        c.globalAlpha = 1;
      }
      if (this.layers.pitch) {
        c.setLineDash([6 * px, 4 * px]);
        c.strokeStyle = color("pitch");
        c.lineWidth = px * 1.6;
        c.stroke(pitch[i]);
        c.setLineDash([]);
      }
      if (!flat.bores[i]) this.cross(c, px);
    }
    base();
    c.setLineDash([12 * px, 4 * px, 2 * px, 4 * px]);
    c.strokeStyle = color("ink");
    c.globalAlpha = 0.4;
    c.lineWidth = px;
    c.beginPath();
    c.moveTo(0, 0);
    c.lineTo(distance, 0);
    c.stroke();
    c.setLineDash([]);
    c.globalAlpha = 1;
    if (this.layers.contact && flat.outlines[0]) this.contacts(c, px, angles[0]);
  }

  cross(c, px) {
    c.strokeStyle = color("ink");
    c.lineWidth = px * 1.5;
    c.beginPath();
    c.moveTo(-6 * px, 0); c.lineTo(6 * px, 0);
    c.moveTo(0, -6 * px); c.lineTo(0, 6 * px);
    c.stroke();
  }

  // Lines every 1, 10, 100 mm, as fine as the eye can use.
  ruling(c) {
    const { x, y, scale } = this.view;
    const step = Math.pow(10, Math.ceil(Math.log10(18 / scale)));
    const [w, h] = [this.width / 2 / scale, this.height / 2 / scale];
    c.strokeStyle = color("grid");
    c.lineWidth = 1 / scale;
    c.beginPath();
    for (let gx = Math.floor((x - w) / step) * step; gx < x + w; gx += step) { c.moveTo(gx, y - h); c.lineTo(gx, y + h); }
    for (let gy = Math.floor((y - h) / step) * step; gy < y + h; gy += step) { c.moveTo(x - w, gy); c.lineTo(x + w, gy); }
    c.stroke();
  }

  // Contacts of the nearest pose, turned with the driver so that they stay on its flanks.
  contacts(c, px, turned) {
    const { cycle } = this.scene;
    const angle = ((turned % cycle) + cycle) % cycle;
    const own = this.forces || (this.run ? [] : this.scene.forces);
    const frames = own || this.scene.contacts;
    if (!frames.length) return;
    let low = 0;
    let high = frames.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (frames[middle][0] <= angle) low = middle; else high = middle;
    }
    const frame = Math.abs(frames[low][0] - angle) <= Math.abs(frames[high][0] - angle) ? frames[low] : frames[high];
    const off = angle - frame[0];
    if (Math.abs(off) > (4 * cycle) / frames.length) return;
    const [cos, sin] = [Math.cos(off), Math.sin(off)];
    const length = 46 * px;
    for (let i = 1; i + 3 < frame.length; i += 4) {
      const [x, y, fx, fy] = frame.slice(i, i + 4);
      const [tx, ty] = [cos * x - sin * y, sin * x + cos * y];
      const force = () => { c.beginPath(); c.moveTo(tx, ty); c.lineTo(tx + length * fx, ty + length * fy); c.stroke(); };
      c.lineCap = "round";
      if (own) {
        c.strokeStyle = color("card"); c.lineWidth = 5 * px; force();
        c.strokeStyle = color("force"); c.lineWidth = 2.4 * px; force();
      }
      c.beginPath();
      c.arc(tx, ty, 4 * px, 0, 7);
      c.fillStyle = color("force");
      c.fill();
      c.strokeStyle = color("card");
      c.lineWidth = 1.5 * px;
      c.stroke();
      c.lineCap = "butt";
    }
  }

  world(event) {
    const box = this.canvas.getBoundingClientRect();
    const { x, y, scale } = this.view;
    return [x + (event.clientX - box.left - this.width / 2) / scale, y - (event.clientY - box.top - this.height / 2) / scale];
  }

  // Which gear lies under a point: 0, 1, or -1.
  gearAt([x, y]) {
    if (!this.scene) return -1;
    const { distance, reach: [a, b] } = this.scene;
    const [p, q] = [Math.hypot(x, y) / a, Math.hypot(x - distance, y) / b];
    if (Math.min(p, q) > 0.97) return -1;
    return p < q ? 0 : 1;
  }

  zoom(factor, [wx, wy]) {
    const { view } = this;
    this.goal = null;
    const scale = clamp(view.scale * factor, 0.2, 4000);
    const done = scale / view.scale;
    view.x = wx + (view.x - wx) / done;
    view.y = wy + (view.y - wy) / done;
    view.scale = scale;
    this.isOwn = true;
    if (this.isClose && Math.hypot(wx - view.x, wy - view.y) * scale > 1) this.isClose = false;
    this.dirty = true;
  }

  listen() {
    const pointers = new Map();
    let hold = null;
    const { canvas } = this;
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      if (event.shiftKey) { this.transport.play(false); this.transport.goTo(this.transport.angle + (event.deltaY + event.deltaX) * 0.0012); return; }
      this.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0016)), this.world(event));
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, event);
      const at = this.world(event);
      const gear = this.gearAt(at);
      const isTurn = gear >= 0 && event.button === 0 && !event.shiftKey && pointers.size === 1 && !this.run;
      hold = { at, gear: isTurn ? gear : -1 };
      if (isTurn) this.transport.play(false);
      canvas.classList.add("holding");
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!pointers.has(event.pointerId)) {
        const over = this.gearAt(this.world(event)) >= 0;
        canvas.classList.toggle("turn", over);
        canvas.classList.toggle("grab", !over);
        return;
      }
      if (pointers.size === 2) { this.pinch(pointers, event); hold = null; return; }
      const before = pointers.get(event.pointerId);
      pointers.set(event.pointerId, event);
      if (!hold) return;
      if (hold.gear >= 0) this.turnBy(hold, this.world(event));
      else {
        this.goal = null;
        this.isClose = false;
        this.view.x -= (event.clientX - before.clientX) / this.view.scale;
        this.view.y += (event.clientY - before.clientY) / this.view.scale;
        this.isOwn = true;
        this.dirty = true;
      }
    });
    const up = (event) => {
      pointers.delete(event.pointerId);
      hold = null;
      canvas.classList.remove("holding");
    };
    canvas.addEventListener("pointerup", up);
    canvas.addEventListener("pointercancel", up);
    canvas.addEventListener("dblclick", (event) => {
      if (this.isOwn) this.fit();
      else { this.zoom(1, this.world(event)); const [x, y] = this.world(event); this.goal = { x, y, scale: this.view.scale * 5 }; this.isClose = false; }
    });
  }

  // The gear goes where the hand goes.
  turnBy(hold, now) {
    const centre = hold.gear ? this.scene.distance : 0;
    const angle = ([x, y]) => Math.atan2(y, x - centre);
    let by = angle(now) - angle(hold.at);
    by = Math.atan2(Math.sin(by), Math.cos(by));
    hold.at = now;
    if (hold.gear) {
      const d = this.scene.cycle / 2000;
      const phi = this.transport.angle;
      const speed = (this.followerAngle(Math.min(this.scene.cycle, phi + d)) - this.followerAngle(Math.max(0, phi - d))) / (2 * d);
      by = -by / Math.max(0.05, speed);
    }
    this.transport.goTo(this.transport.angle + by);
  }

  pinch(pointers, event) {
    const spread = () => {
      const [a, b] = Array.from(pointers.values());
      return { size: Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY), x: (a.clientX + b.clientX) / 2, y: (a.clientY + b.clientY) / 2 };
    };
    const before = spread();
    pointers.set(event.pointerId, event);
    const after = spread();
    this.zoom(after.size / Math.max(1, before.size), this.world({ clientX: after.x, clientY: after.y }));
    this.view.x -= (after.x - before.x) / this.view.scale;
    this.view.y += (after.y - before.y) / this.view.scale;
  }
}
