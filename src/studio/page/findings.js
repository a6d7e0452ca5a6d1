// The verdict, how far the work is, what was found, and the figures.

import { el, fill } from "./dom.js";
import { degrees, shown } from "./numbers.js";
import { T } from "./texts.js";

const STAGES = ["sized", "toothed", "analysed", "proven"];

// The badge and its four small lamps.
export class Verdict {
  constructor() {
    this.mark = el("span", { class: "mark", "aria-hidden": "true" });
    this.text = el("span");
    this.badge = el("div", { class: "verdict", role: "status" }, this.mark, this.text);
    this.lamps = STAGES.map((stage) => el("li", { title: T.stages[stage] }));
    this.node = el("div", { class: "row" }, this.badge, el("ol", { class: "stages hide-narrow", "aria-label": T.stagesLabel }, this.lamps));
  }

  show(model) {
    const { verdict, refused, stage, live } = model;
    const kind = refused ? "refused" : verdict || "waiting";
    this.badge.className = `verdict ${kind}`;
    this.mark.textContent = { good: "✓", warnings: "!", unsound: "×", refused: "×" }[kind] || "·";
    const proven = stage === "proven";
    this.text.textContent = kind === "waiting" ? T.working[stage] || T.working.none : proven || refused ? T.verdicts[kind] : T.soFar(T.verdicts[kind]);
    const at = STAGES.indexOf(stage);
    this.lamps.forEach((lamp, i) => {
      lamp.className = refused ? "" : i <= at ? (i === 0 && model.sized?.coarse ? "coarse" : "done") : i === at + 1 && !live ? "now" : "";
    });
  }
}

export class Findings {
  constructor({ onGo, onRemedy }) {
    Object.assign(this, { onGo, onRemedy });
    this.list = el("ul", { class: "findings" });
    this.more = el("details", { class: "more" }, el("summary", {}, T.stepsTaken), el("ul", { class: "findings" }));
    this.node = el("section", { class: "panel", "aria-label": T.findings }, el("h2", {}, T.findings), this.list, this.more);
  }

  show(model) {
    const { findings = [], refused } = model;
    const serious = findings.filter((f) => f.kind !== "step");
    const steps = findings.filter((f) => f.kind === "step");
    const lines = serious.map((f) => this.line(f));
    if (refused) lines.unshift(this.line({ kind: "fault", text: refused.text, remedies: refused.remedy ? [refused.remedy] : [] }));
    fill(this.list, lines.length ? lines : el("li", { class: "calm" }, model.stage === "proven" ? T.nothingFound : T.stillLooking));
    this.more.hidden = !steps.length;
    fill(this.more.lastElementChild, steps.map((f) => this.line(f)));
  }

  line(finding) {
    const hasPlace = Number.isFinite(finding.angle);
    const text = hasPlace
      ? el("button", { type: "button", class: "go", title: T.goThere, onclick: () => this.onGo(finding) }, sentence(finding.text))
      : el("p", {}, sentence(finding.text));
    const actions = [
      hasPlace && el("button", { type: "button", class: "small", onclick: () => this.onGo(finding) }, T.showIt),
      ...(finding.remedies || []).map((remedy) => el("button", { type: "button", class: "small", onclick: () => this.onRemedy(remedy) }, T.remedy(remedy))),
    ].filter(Boolean);
    return el("li", { class: `finding ${finding.kind}` }, el("span", { class: "mark", "aria-hidden": "true" }), text,
      actions.length ? el("div", { class: "actions" }, actions) : null);
  }
}

// Begins with a capital, and calls options as the page does.
const sentence = (text) => {
  const named = text.replace(/--([a-z][a-z-]*[a-z])/g, (all, key) => (T.name(key) === key ? all.replace(/-/g, "\u2011") : `“${T.name(key)}”`));
  return named.charAt(0).toUpperCase() + named.slice(1);
};

export class Figures {
  constructor() {
    this.table = el("dl", { class: "figures-table" });
    this.node = el("section", { class: "panel" }, el("h2", {}, T.figures), this.table);
  }

  show(model) {
    const { sized, gears, figures } = model;
    if (!sized) return;
    const rows = [];
    const row = (name, value) => rows.push([name, value]);
    const likeness = figures?.likeness || sized.drawings.map((d) => d?.likeness ?? null);
    const shares = likeness.map((s) => (s === null ? null : `${shown(100 * s, 0)} %`)).filter(Boolean);
    if (shares.length) row(T.likeness, shares.join(" · "));
    row(T.torque, `${shown(sized.torque, 2)} ×`);
    if (gears) { row(T.teeth, gears.teeth.join(" · ")); row(T.module, `${shown(gears.module, 3)} mm`); }
    row(T.distance, `${shown(sized.distance, 2)} mm`);
    row(T.slope, `${shown(degrees(sized.steepest), 0)}°`);
    if (figures) {
      row(T.contactRatio, shown(figures.contact_ratio, 2));
      if (figures.error_p99 !== null) row(T.error, `${shown(100 * figures.error_p99, 3)} %`);
      const [least, most] = figures.backlash;
      if (least !== null) row(T.backlash, `${shown(degrees(least), 2)}–${shown(degrees(most), 2)}°`);
      row(T.efficiency, `${shown(100 * figures.efficiency, 0)} %`);
    }
    fill(this.table, rows.map(([name, value]) => [el("dt", {}, name), el("dd", {}, value)]));
  }
}
