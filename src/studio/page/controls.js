// Controls made from what the program says of its options.

import { el, fill } from "./dom.js";
import { icon } from "./icons.js";
import { clamp, read, written } from "./numbers.js";
import { T } from "./texts.js";

// The number in a value of the command line, such as 0.1mm.
const numberIn = (text) => (text === undefined || text === null || text === "" ? NaN : Number(String(text).replace(/(mm|°)$/, "")));

class Control {
  constructor(spec, store) {
    Object.assign(this, { spec, store });
    const name = T.name(spec.key);
    const id = `control-${spec.key}`;
    this.reset = el("button", { type: "button", class: "reset", "aria-label": T.reset(name), title: T.reset(name), onclick: () => store.setOption(spec.key, null) }, icon("reset"));
    this.helpText = el("p", { class: "help", id: `${id}-help`, hidden: true }, spec.help.replace(/[.\s]*$/, "."), this.defaultText());
    this.ask = el("button", { type: "button", class: "ask", "aria-label": T.help(name), title: spec.help, "aria-expanded": "false", onclick: () => {
      this.helpText.hidden = !this.helpText.hidden;
      this.ask.setAttribute("aria-expanded", String(!this.helpText.hidden));
    } }, icon("help"));
    this.why = el("p", { class: "why", role: "alert", hidden: true });
    this.label = el("label", { class: "name", htmlFor: id }, name);
    const parts = this.build(id);
    this.node = el("div", { class: "control", data: { key: spec.key } },
      el("div", { class: "head" }, this.label, this.ask, this.reset, parts.field, parts.unit), parts.slider, this.helpText, this.why);
  }

  defaultText() {
    const { kind, unit } = this.spec;
    const value = this.spec.default ?? this.spec.chosen;
    if (value === null || value === undefined) return kind === "flag" ? T.defaultIs(T.off) : "";
    return T.defaultIs(/\d$/.test(value) && unit ? `${value} ${unit}` : value.replace(/(\d)mm$/, "$1 mm"));
  }

  build(id) {
    const { key, kind, unit, choices, usual } = this.spec;
    const described = { "aria-describedby": `${id}-help` };
    const set = (value, live) => this.store.setOption(key, value, { live });
    if (kind === "flag") {
      this.field = el("input", { type: "checkbox", id, ...described, onchange: () => set(this.field.checked ? "true" : null) });
      return { field: this.field };
    }
    if (kind === "choice") {
      this.field = el("select", { id, ...described, onchange: () => set(this.field.value === this.spec.default ? null : this.field.value) },
        choices.map((c) => el("option", { value: c }, c)));
      return { field: this.field };
    }
    if (kind === "number") {
      const { from, to, step } = this.spec;
      this.field = el("input", { type: "text", inputMode: "decimal", id, class: "value", autocomplete: "off", ...described, onchange: () => this.typed() });
      this.field.addEventListener("keydown", (event) => {
        if (event.key !== "ArrowUp" && event.key !== "ArrowDown") return;
        event.preventDefault();
        const by = (event.key === "ArrowUp" ? 1 : -1) * step * (event.shiftKey ? 10 : 1);
        set(written(clamp(this.current() + by, from, to), step), false);
      });
      this.slider = el("input", { type: "range", min: from, max: to, step, "aria-label": T.name(key),
        oninput: () => { this.holding = true; set(written(Number(this.slider.value), step), true); },
        onchange: () => { this.holding = false; set(written(Number(this.slider.value), step), false); } });
      return { field: this.field, unit: el("span", { class: "unit" }, unit), slider: this.slider };
    }
    this.field = el("input", { type: "text", id, class: `value ${this.spec.main ? "" : "wide"}`, autocomplete: "off", placeholder: T.chosen, ...described,
      onchange: () => set(this.field.value.trim() === "" ? null : this.field.value.trim()) });
    if (usual?.length) {
      this.field.setAttribute("list", `${id}-usual`);
      return { field: [this.field, el("datalist", { id: `${id}-usual` }, usual.map((value) => el("option", { value })))], unit: el("span", { class: "unit" }) };
    }
    return { field: this.field, unit: el("span", { class: "unit" }) };
  }

  typed() {
    const { key, from, step } = this.spec;
    const text = this.field.value.trim();
    this.mistake = "";
    if (text === "") { this.store.setOption(key, null); return; }
    if (key === "center-distance" && /^lego:\d+$/.test(text)) { this.store.setOption(key, text); return; }
    const value = read(text);
    if (!Number.isFinite(value)) { this.mistaken(T.notNumber); return; }
    if (value < Math.min(0, from)) { this.mistaken(T.outOf(Math.min(0, from))); return; }
    this.store.setOption(key, written(value, Math.min(step, 1e-4)));
  }

  current() {
    const { from, to } = this.spec;
    const said = numberIn(this.value ?? this.spec.default);
    return Number.isFinite(said) ? said : this.found ?? (from + to) / 2;
  }

  // Stays for as long as what was typed stands in the field, whatever the program answers meanwhile.
  mistaken(text) {
    this.mistake = text;
    this.complain(text);
  }

  complain(text) {
    this.why.textContent = text;
    this.why.hidden = !text;
    this.field.setAttribute("aria-invalid", String(Boolean(text)));
  }

  // `found` is what the program chose by itself, for controls that leave it the choice.
  show(value, found, barredBy) {
    const { kind, step } = this.spec;
    if (value !== this.value) this.mistake = "";
    this.value = value;
    this.found = found;
    this.reset.disabled = value === undefined;
    this.node.classList.toggle("changed", value !== undefined);
    this.node.classList.toggle("barred", Boolean(barredBy));
    for (const field of [this.field, this.slider]) if (field) field.disabled = Boolean(barredBy);
    if (barredBy) this.complain(""), this.why.textContent = T.excluded(barredBy), this.why.hidden = false;
    if (kind === "flag") { this.field.checked = value === "true"; return; }
    if (kind === "choice") { this.field.value = value ?? this.spec.default; return; }
    if (document.activeElement !== this.field || kind !== "number" || this.holding) {
      const text = value ?? this.spec.default ?? "";
      const plain = numberIn(text);
      this.mistake = "";
      this.field.value = kind === "number" && Number.isFinite(plain) ? written(plain, Math.min(step, 1e-4)) : text;
      if (kind === "number") this.field.placeholder = Number.isFinite(found) ? `${T.chosen} ${written(found, Math.max(step, found >= 10 ? 1 : 0.1))}` : T.chosen;
      else if (kind === "point" && found) this.field.placeholder = found;
    }
    if (this.slider) {
      const at = this.current();
      if (!this.holding) this.slider.value = String(at);
      const { from, to } = this.spec;
      this.slider.style.setProperty("--part", `${clamp((100 * (at - from)) / (to - from), 0, 100)}%`);
      this.slider.classList.toggle("idle", value === undefined && this.spec.default === null);
    }
  }
}

export class Controls {
  constructor(specs, store) {
    this.specs = specs;
    this.store = store;
    this.node = el("div");
    this.open = new Set();
  }

  build(way) {
    if (this.way === way) return;
    this.way = way;
    const all = this.specs[way].map((spec) => new Control(spec, this.store));
    this.controls = new Map(all.map((c) => [c.spec.key, c]));
    const main = el("section", { class: "panel" }, el("h2", {}, T.main), all.filter((c) => c.spec.main).map((c) => c.node));
    this.groups = new Map();
    for (const control of all.filter((c) => !c.spec.main)) {
      if (!this.groups.has(control.spec.group)) this.groups.set(control.spec.group, []);
      this.groups.get(control.spec.group).push(control);
    }
    this.counts = new Map();
    const groups = Array.from(this.groups, ([name, controls]) => {
      const count = el("span", { class: "count", hidden: true });
      this.counts.set(name, count);
      return el("details", { class: "group", open: this.open.has(name), ontoggle: (event) => this.open[event.target.open ? "add" : "delete"](name) },
        el("summary", {}, name, count), el("div", { class: "body" }, controls.map((c) => c.node)));
    });
    fill(this.node, main, groups);
  }

  show(state, model) {
    this.build(state.way);
    const found = this.found(model);
    for (const [key, control] of this.controls) {
      const barredBy = control.spec.conflicts.find((other) => state.options[other] !== undefined && state.options[key] === undefined && this.controls.has(other));
      control.show(state.options[key], found[key], barredBy);
      if (!barredBy) control.complain(control.mistake || (model.refused?.option === key ? model.refused.text : ""));
    }
    for (const [name, controls] of this.groups) {
      const changed = controls.filter((c) => state.options[c.spec.key] !== undefined).length;
      const count = this.counts.get(name);
      count.hidden = !changed;
      count.textContent = String(changed);
    }
    const blamed = model.refused?.option && this.controls.get(model.refused.option);
    blamed?.node.closest("details")?.setAttribute("open", "");
  }

  // What the program chose where the choice was left to it.
  found({ sized, gears }) {
    const found = {};
    if (gears) { found.teeth = gears.teeth[0]; found.module = gears.module; }
    if (!sized) return found;
    found["max-torque"] = sized.torque;
    const turn = sized.drawings[1]?.turn;
    if (turn !== undefined) found.orientation = ((turn * 180) / Math.PI + 540) % 360 - 180;
    for (const [key, i] of [["driver-axis", 0], ["follower-axis", 1], ["axis", 0]]) {
      const axis = sized.drawings[i]?.axis;
      if (axis) found[key] = axis.map((v) => v.toFixed(1)).join(",");
    }
    return found;
  }
}
