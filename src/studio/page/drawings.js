// The two drawings with their axes, which can be dragged, and what can be done with them.

import { el, fill, svg, toast } from "./dom.js";
import { icon } from "./icons.js";
import { clamp } from "./numbers.js";
import { Photo, Threshold } from "./photo.js";
import { adopt } from "./shelf.js";
import { T } from "./texts.js";

const SIDES = ["driver", "follower"];
const FINE = 4;

const pathOf = (flat) => {
  let d = "";
  for (let i = 0; i < flat.length; i += 2) d += `${i ? "L" : "M"}${flat[i]} ${-flat[i + 1]}`;
  return `${d}z`;
};

class Card {
  constructor(side, owner) {
    Object.assign(this, { side, owner });
    const index = SIDES.indexOf(side);
    this.index = index;
    this.shape = svg("path", { class: "fill" });
    this.photo = new Photo();
    this.turned = svg("g", {}, this.photo.node, this.shape);
    this.axis = svg("g", { class: "axis", tabindex: "0", role: "button", "aria-label": T.axisOf(side) },
      svg("circle", { class: "area", r: 14 }), svg("circle", { r: 5.5 }), svg("path", { d: "M-9 0h18M0 -9v18" }));
    this.knob = svg("g", { class: "knob", tabindex: "0", role: "slider", "aria-label": T.knob, "aria-valuemin": -180, "aria-valuemax": 180 },
      svg("circle", { r: 5 }));
    this.knobLine = svg("line", {});
    this.picture = svg("svg", { "aria-label": side, role: "group" }, this.turned, index ? svg("g", { class: "knob" }, this.knobLine) : null, this.axis, index ? this.knob : null);
    this.board = el("div", { class: "board" }, this.picture);
    this.name = el("button", { type: "button", class: "plain small name", title: T.change, onclick: () => owner.onChange(side) });
    this.figure = el("output", { class: "number" });
    this.node = el("div", { class: `card ${side}` }, this.board,
      el("div", { class: "title" }, this.name,
        el("button", { type: "button", class: "plain small icon", title: T.mirror, "aria-label": `${T.mirror}: ${T[side]}`, onclick: () => owner.mirror(side) }, icon("mirror"))),
      el("div", { class: "role" }, el("span", {}, T[side]), this.figure));
    this.listen();
  }

  // Where a point of the screen lies in the drawing.
  point(event) {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.picture.getScreenCTM().inverse());
    return [at.x, -at.y];
  }

  listen() {
    const drag = (node, move) => {
      node.addEventListener("pointerdown", (event) => {
        if (!this.bounds) return;
        event.preventDefault();
        event.stopPropagation();
        node.setPointerCapture(event.pointerId);
        node.focus();
        const moved = (e) => move(this.point(e), true);
        const done = (e) => {
          node.removeEventListener("pointermove", moved);
          node.removeEventListener("pointerup", done);
          node.removeEventListener("pointercancel", done);
          move(this.point(e), false);
        };
        node.addEventListener("pointermove", moved);
        node.addEventListener("pointerup", done);
        node.addEventListener("pointercancel", done);
      });
    };
    drag(this.axis, (at, live) => this.owner.moveAxis(this.side, this.inside(at), live));
    this.axis.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!by || !this.at) return;
      event.preventDefault();
      event.stopPropagation();
      const step = (this.size / 200) * (event.shiftKey ? 8 : 1);
      this.owner.moveAxis(this.side, this.inside([this.at[0] + by[0] * step, this.at[1] + by[1] * step]), false);
    });
    drag(this.knob, ([x, y], live) => {
      const angle = (Math.atan2(y - this.middle[1], x - this.middle[0]) * 180) / Math.PI - 90;
      this.owner.turn(((angle + 540) % 360) - 180, live);
    });
    this.knob.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: 1, ArrowUp: 1, ArrowRight: -1, ArrowDown: -1 }[event.key];
      if (!by) return;
      event.preventDefault();
      event.stopPropagation();
      this.owner.turn(this.angle + by * (event.shiftKey ? 15 : 1), false);
    });
  }

  inside([x, y]) {
    const [left, low, right, high] = this.bounds;
    return [clamp(x, left, right), clamp(y, low, high)];
  }

  read(drawing) {
    if (!drawing) return;
    this.bounds = drawing.bounds;
    const [left, low, right, high] = drawing.bounds;
    this.size = Math.max(right - left, high - low);
    this.middle = [(left + right) / 2, (low + high) / 2];
    const half = this.size * 0.64;
    this.picture.setAttribute("viewBox", `${this.middle[0] - half} ${-this.middle[1] - half} ${2 * half} ${2 * half}`);
    this.shape.setAttribute("d", pathOf(drawing.raw));
    this.unit = (2 * half) / 136;
    this.axis.setAttribute("visibility", "hidden");
  }

  show(drawing, sized, options) {
    this.photo.show(drawing).then(() => this.shape.classList.toggle("over-photo", this.photo.node.hasAttribute("href")));
    this.name.textContent = drawing ? drawing.name.replace(/\.\w+$/, "") : T.empty;
    if (!this.bounds) return;
    const key = this.owner.way === "mate" ? "axis" : `${this.side}-axis`;
    const held = options[key];
    const at = held ? held.split(",").map(Number) : sized?.drawings[this.index]?.axis;
    this.axis.classList.toggle("held", Boolean(held));
    if (at) {
      this.at = at;
      this.axis.setAttribute("visibility", "visible");
      this.axis.setAttribute("transform", `translate(${at[0]} ${-at[1]}) scale(${this.unit})`);
      this.axis.setAttribute("aria-valuetext", at.map((v) => v.toFixed(1)).join(", "));
    }
    const likeness = sized?.drawings[this.index]?.likeness;
    this.figure.textContent = likeness === undefined ? "" : `${Math.round(100 * likeness)} %`;
    this.figure.title = T.likeness;
    if (this.index) this.showKnob(sized, options);
  }

  showKnob(sized, options) {
    const held = options.orientation;
    const turn = held !== undefined ? Number(held) : ((sized?.drawings[1]?.turn ?? 0) * 180) / Math.PI;
    this.angle = ((turn + 540) % 360) - 180;
    const radians = ((this.angle + 90) * Math.PI) / 180;
    const [dx, dy] = [Math.cos(radians), Math.sin(radians)];
    const far = this.size * 0.58;
    this.knob.classList.toggle("held", held !== undefined);
    this.knob.setAttribute("transform", `translate(${this.middle[0] + dx * far} ${-this.middle[1] - dy * far}) scale(${this.unit})`);
    this.knob.setAttribute("aria-valuenow", this.angle.toFixed(0));
    for (const [name, value] of [["x1", this.middle[0] + dx * far * 0.8], ["y1", -this.middle[1] - dy * far * 0.8], ["x2", this.middle[0] + dx * far], ["y2", -this.middle[1] - dy * far]]) this.knobLine.setAttribute(name, value);
  }
}

export class Drawings {
  constructor(store, onChange) {
    Object.assign(this, { store, onChange });
    this.cards = SIDES.map((side) => new Card(side, this));
    this.ways = el("div", { class: "ways", role: "tablist", "aria-label": T.waysLabel });
    this.swapButton = el("button", { type: "button", class: "swap", title: T.swap, "aria-label": T.swap, onclick: () => this.swap() }, icon("swap"));
    this.row = el("div", { class: "cards" }, this.cards[0].node, this.swapButton, this.cards[1].node);
    this.threshold = new Threshold(store);
    this.freeButton = el("button", { type: "button", class: "link", onclick: () => this.free() }, T.free);
    this.node = el("section", { class: "panel", "aria-label": T.drawings }, this.ways, this.row, this.threshold.node, el("div", { class: "free" }, this.freeButton));
  }

  show(state, model) {
    this.way = state.way;
    this.threshold.show(state);
    fill(this.ways, Object.entries(T.ways).map(([way, text]) => el("button", {
      type: "button", role: "tab", "aria-selected": String(state.way === way), onclick: () => this.store.edit((s) => { s.way = way; s.options = kept(s.options, way); }),
    }, text)));
    this.row.hidden = state.way === "motion";
    this.row.classList.toggle("one", state.way === "mate");
    this.cards[1].node.hidden = this.swapButton.hidden = state.way !== "design";
    if (model.reads !== this.reads) {
      this.reads = model.reads;
      model.reads?.forEach((drawing, i) => this.cards[i].read(drawing));
    }
    this.cards.forEach((card, i) => card.show(state[SIDES[i]], model.sized, state.options));
    const held = ["driver-axis", "follower-axis", "axis", "orientation"].some((key) => state.options[key] !== undefined);
    this.freeButton.hidden = !held || state.way === "motion";
  }

  // Holding one axis holds the other where it is: the gears follow the hand instead of leaping to a better pair.
  moveAxis(side, at, live) {
    const text = (p) => p.map((v) => v.toFixed(FINE)).join(",");
    if (this.way === "mate") { this.store.setOption("axis", text(at), { live }); return; }
    const other = SIDES.find((s) => s !== side);
    const otherAt = this.cards[SIDES.indexOf(other)].at;
    this.store.edit((s) => {
      s.options[`${side}-axis`] = text(at);
      delete s.options.symmetric;
      delete s.options.choose;
      if (s.options[`${other}-axis`] === undefined && otherAt) s.options[`${other}-axis`] = text(otherAt);
    }, { live });
  }

  turn(angle, live) {
    this.store.edit((s) => {
      s.options.orientation = (((angle + 540) % 360) - 180).toFixed(1);
      delete s.options.symmetric;
      delete s.options.choose;
    }, { live });
  }

  free() {
    this.store.edit((s) => { for (const key of ["driver-axis", "follower-axis", "axis", "orientation"]) delete s.options[key]; });
  }

  swap() {
    this.store.edit((s) => {
      [s.driver, s.follower] = [s.follower, s.driver];
      delete s.options.choose;
      const { "driver-axis": a, "follower-axis": b, ...rest } = s.options;
      s.options = { ...rest, ...(b ? { "driver-axis": b } : {}), ...(a ? { "follower-axis": a } : {}) };
      if (rest.orientation !== undefined) s.options.orientation = String(-Number(rest.orientation));
      if (rest.balance !== undefined) s.options.balance = String(Number((1 - Number(rest.balance)).toFixed(4)));
    });
  }

  async mirror(side) {
    const drawing = this.store.state[side];
    if (!drawing) return;
    const answer = await fetch("api/mirror", { method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify(drawing) });
    const said = await answer.json();
    if (!answer.ok) { toast(said.text, "bad"); return; }
    await adopt(said);
    this.store.edit((s) => {
      s[side] = { name: said.name, id: said.id };
      delete s.options[`${side}-axis`];
      delete s.options.axis;
      delete s.options.orientation;
    });
  }
}

// Options that mean nothing for another way are dropped.
const ONLY = { design: ["balance", "driver-axis", "follower-axis", "orientation", "symmetric", "refine", "effort", "choose", "search", "star-weight"], mate: ["axis"], motion: ["psi", "centrode", "preset", "normalise", "from", "to", "sector"] };
const kept = (options, way) => {
  const away = Object.entries(ONLY).filter(([w]) => w !== way).flatMap(([, keys]) => keys);
  if (way === "motion") away.push("smoothing", "threshold", "torque-weight", "max-torque", "max-lean");
  return Object.fromEntries(Object.entries(options).filter(([key]) => !away.includes(key)));
};
