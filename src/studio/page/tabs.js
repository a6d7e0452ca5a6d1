// What the stage shows: the pair in the plane, its solids, or a run as it was computed.

import { fetchFile } from "./away.js";
import { el, fill, toast } from "./dom.js";
import { degrees, shown } from "./numbers.js";
import { Solid } from "./solid.js";
import { bare } from "./store.js";
import { T } from "./texts.js";
import { TrainView } from "./train.js";

// Room that the figures of a run take, px.
const RUNS_FOOT = 110;

export class Tabs {
  constructor(stage, transport, store) {
    Object.assign(this, { stage, transport, store, tab: "pair", chosen: 0, model: {} });
    this.solid = new Solid(transport, () => stage.poses());
    this.train = new TrainView(transport, store);
    this.bar = el("div", { class: "tabs", role: "tablist" });
    this.runs = el("div", { class: "runs strip", hidden: true });
    stage.node.append(this.solid.node, this.train.node, this.bar, this.runs);
    this.showBar();
  }

  showBar() {
    const names = Object.keys(T.tabs);
    fill(this.bar, names.map((tab) => el("button", { type: "button", role: "tab", "aria-selected": String(tab === this.tab), tabindex: tab === this.tab ? "0" : "-1", onclick: () => this.open(tab) }, T.tabs[tab])));
    this.bar.onkeydown = (event) => {
      const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (!by) return;
      event.preventDefault();
      event.stopPropagation();
      this.open(names[(names.indexOf(this.tab) + by + names.length) % names.length]);
      this.bar.querySelector("[aria-selected=true]").focus();
    };
  }

  open(tab) {
    this.tab = tab;
    this.showBar();
    this.solid.node.hidden = tab !== "solid";
    this.runs.hidden = tab !== "runs";
    this.stage.node.dataset.tab = tab;
    const foot = tab === "runs" ? RUNS_FOOT : 0;
    if (foot !== this.stage.foot) { this.stage.foot = foot; if (!this.stage.isOwn) this.stage.fit(); }
    this.train.open(tab === "train");
    this.show(this.model);
  }

  show(model) {
    this.model = model;
    const run = this.tab === "runs" ? model.runs?.[this.chosen] || model.runs?.[0] : null;
    this.stage.run = run ? this.pose(run) : null;
    this.stage.forces = run ? run.frames : null;
    this.stage.dirty = true;
    this.train.show(model);
    if (this.tab === "runs") this.showRuns(model);
    if (this.tab === "solid") this.showSolid(model);
  }

  // The bodies where the run had them; the slider goes through the whole run.
  pose(run) {
    const last = run.driver.length - 1;
    return (angle) => {
      const at = Math.min(last, Math.max(0, (angle / this.transport.cycle) * last));
      const low = Math.min(last - 1, Math.floor(at));
      const part = at - low;
      const between = (list) => list[low] + (list[low + 1] - list[low]) * part;
      return [between(run.driver), -between(run.follower)];
    };
  }

  showRuns({ runs, stage }) {
    if (!runs?.length) { fill(this.runs, el("p", { class: "soft" }, stage === "proven" ? T.runsNone : T.runsComing)); return; }
    const chosen = Math.min(this.chosen, runs.length - 1);
    const run = runs[chosen];
    const facts = [[T.load, `${shown(run.load, 0)} N mm`], [T.rpm, `${shown(run.rpm, 0)} rpm`], [T.friction, shown(run.friction, 2)],
      [T.swing, `${shown(degrees(run.swing_angle), 2)}° · ${shown(100 * run.swing, 1)} %`], [T.runTorque, `${shown(run.greatest_torque, 0)} N mm`], [T.efficiency, `${shown(100 * run.efficiency, 1)} %`]];
    fill(this.runs,
      el("div", { class: "row", role: "tablist", "aria-label": T.runsTitle }, runs.map((r, i) => el("button", {
        type: "button", class: "small", role: "tab", "aria-selected": String(i === chosen), onclick: () => { this.chosen = i; this.show(this.model); },
      }, T.runName(r)))),
      el("dl", { class: "figures-table" }, facts.map(([name, value]) => [el("dt", {}, name), el("dd", {}, value)])));
  }

  async showSolid({ stage }) {
    if (stage !== "proven") { this.solid.wait(true); return; }
    const state = JSON.stringify(bare(this.store.state));
    if (this.made === state) { this.solid.wait(false); this.solid.draw(); return; }
    if (this.making === state) return;
    this.making = state;
    this.solid.wait(true);
    try {
      const blob = await fetchFile(this.store.state, "glb", "pair.glb");
      if (this.making !== state) return;
      this.solid.set(await blob.arrayBuffer());
      this.made = state;
      this.solid.wait(false);
    } catch (error) {
      toast(error.message, "bad");
    }
    this.making = null;
  }
}
