// Puts the page together: the state goes to the server, what it tells goes to the views.

import { Alternatives } from "./alternatives.js";
import { copyCommand, copyLink, openScene, saveScene, takeAway } from "./away.js";
import { Controls } from "./controls.js";
import { el, fill, menu, svg, toast } from "./dom.js";
import { Drawings } from "./drawings.js";
import { Figures, Findings, Verdict } from "./findings.js";
import { icon } from "./icons.js";
import { listenToKeys } from "./keys.js";
import { Law } from "./law.js";
import { Link } from "./link.js";
import { dropPlaces, pick, setLargest } from "./picker.js";
import { Plots } from "./plots.js";
import { adopt, giveAgain } from "./shelf.js";
import { Stage } from "./stage.js";
import { EMPTY, Store, bare } from "./store.js";
import { Tabs } from "./tabs.js";
import { T } from "./texts.js";
import { isDark, onTheme, toggle } from "./theme.js";
import { Transport } from "./transport.js";

const FIRST = { ...EMPTY, driver: { name: "heart" }, follower: { name: "dove" } };
const FIRST_LAW = "1 + 0.3*cos(2*phi)";

const start = async () => {
  const answer = await fetch("api/begin");
  if (!answer.ok) { toast(T.startedAnew, "bad"); return; }
  const begin = await answer.json();
  setLargest(begin.largest_drawing);
  const store = new Store();
  const [driver, follower] = begin.given;
  for (const drawing of begin.given) await adopt(drawing);
  const given = driver ? { ...EMPTY, driver, follower: follower || driver } : null;
  store.begin(given, FIRST);

  const transport = new Transport();
  const stage = new Stage(transport);
  const controls = new Controls(begin.controls, store);
  const verdict = new Verdict();
  const figures = new Figures();
  const plots = new Plots(transport);
  const law = new Law(store);
  const alternatives = new Alternatives(store, transport);
  const tabs = new Tabs(stage, transport, store);
  const findings = new Findings({
    onGo: ({ angle }) => { tabs.open("pair"); transport.play(false); transport.goTo(angle); stage.toMesh(); stage.node.parentNode.scrollIntoView({ block: "nearest" }); },
    onRemedy: ({ option, value }) => store.setOption(option, value),
  });
  const change = (side) => pick(side, begin.shapes, store.state[side], (drawing) => place([side === "driver" ? drawing : null, side === "follower" ? drawing : null]));
  const place = ([first, second]) => store.edit((s) => {
    if (s.way === "motion") s.way = "design";
    for (const [side, drawing] of [["driver", first], ["follower", second]]) {
      if (!drawing) continue;
      s[side] = { name: drawing.name, ...(drawing.id ? { id: drawing.id } : {}) };
      delete s.options[`${side}-axis`];
      delete s.options.axis;
      delete s.options.orientation;
      delete s.options.choose;
    }
    if (s.way === "design" && !s.follower) s.follower = s.driver;
    if (s.way === "design" && !s.driver) s.driver = s.follower;
  });
  const drawings = new Drawings(store, change);

  // What is known of the pair; replaced, never changed, so that views may compare.
  let model = {};
  const root = document.documentElement;
  const views = () => {
    root.dataset.settled = model.generation === link.generation ? "yes" : "no";
    stage.show(model);
    tabs.show(model);
    for (const view of [alternatives, verdict, figures, findings, plots]) view.show(model);
    drawings.show(store.state, model);
    law.show(store.state, model);
    controls.show(store.state, model);
    root.dataset.stage = model.refused ? "refused" : model.stage || "none";
  };

  const take = (told) => {
    if (told.type === "bad") { toast(told.text, "bad"); return; }
    if (told.type === "missing") {
      giveAgain(told.ids).then((ok) => (ok ? want(store.state, false) : toast(T.drawingLost, "bad")), () => toast(T.drawingLost, "bad"));
      return;
    }
    if (told.type === "refused") {
      model = { ...model, generation: told.generation, refused: told, stage: "refused" };
      views();
      return;
    }
    const { data, stage: reached, generation } = told;
    if (reached === "alternatives") {
      model = { ...model, alternatives: data.pairs };
      alternatives.show(model);
      return;
    }
    const fresh = generation !== model.generation;
    const next = fresh ? { ...model, refused: null, generation, findings: model.findings, live } : { ...model };
    next.stage = reached;
    next.generation = generation;
    if (fresh) { next.verdict = null; next.forces = null; }
    if (reached === "read") Object.assign(next, { reads: data.drawings, alternatives: [] });
    if (reached === "sized") next.sized = data;
    // A coarse picture has not its teeth yet: those of the last pair would not fit it.
    if (reached === "sized" && fresh) { next.contacts = []; next.runs = null; next.analysed = null; next.figures = null; }
    if (reached === "toothed") next.gears = data;
    if (reached === "analysed" || reached === "proven") {
      Object.assign(next, { sized: data.sized, analysed: data, gears: data.gears, contacts: data.contacts, figures: data.figures, verdict: data.verdict, findings: data.findings });
    }
    if (reached === "proven") {
      next.runs = data.runs;
      next.forces = data.runs.find((r) => !r.motor && !r.backward)?.frames || null;
    }
    model = next;
    if (reached !== "sized" || !fresh || live) views();
    else requestAnimationFrame(() => { if (model === next) views(); });
  };

  let live = false;
  let wanted = "";
  const want = (state, isLive) => { wanted = JSON.stringify(bare(state)); link.want(bare(state), isLive); };
  const lost = el("span", { class: "offline", hidden: true }, T.lost);
  const link = new Link({
    onTold: (told, ms) => {
      take(told);
      if (told.type === "stage") performance.measure?.(`told-${told.stage}`, { start: performance.now() - ms, end: performance.now() });
    },
    onLost: () => { lost.hidden = false; },
    onBack: () => { lost.hidden = true; model = { ...model, generation: undefined }; want(store.state, false); },
  });

  const undo = el("button", { type: "button", class: "plain icon", title: T.undoKeys, "aria-label": T.undo, onclick: () => store.undo() }, icon("undo"));
  const redo = el("button", { type: "button", class: "plain icon", title: T.redoKeys, "aria-label": T.redo, onclick: () => store.redo() }, icon("redo"));
  const theme = el("button", { type: "button", class: "plain icon", title: T.theme, "aria-label": T.theme, onclick: toggle });
  const showTheme = () => fill(theme, icon(isDark() ? "sun" : "moon"));
  onTheme(showTheme);
  showTheme();
  const chooser = el("input", { type: "file", accept: ".toml,.json", hidden: true, onchange: () => { if (chooser.files[0]) openScene(store, chooser.files[0]); chooser.value = ""; } });
  const share = el("button", { type: "button", class: "plain", "aria-haspopup": "menu", onclick: () => menu(share, [
    { icon: icon("link"), text: T.copyLink, run: () => copyLink(store) },
    { icon: icon("code"), text: T.copyCommand, run: () => copyCommand(store) },
    { icon: icon("save"), text: T.saveScene, run: () => saveScene(store) },
    { icon: icon("open"), text: T.openState, run: () => chooser.click() },
  ]) }, icon("share"), el("span", { class: "hide-narrow" }, T.share));
  const away = el("button", { type: "button", class: "primary", onclick: () => takeAway(store, begin.formats, begin.folder, model) }, icon("save"), T.away);
  const name = el("span", { class: "pair-name" });
  fill(document.getElementById("bar"),
    el("div", { class: "brand" }, logo(), el("span", {}, T.product)), name, el("span", { class: "stretch" }), lost, verdict.node, el("span", { class: "stretch" }), undo, redo, theme, share, away);
  fill(document.getElementById("left"), drawings.node, law.node, controls.node);
  stage.node.append(stage.tools());
  fill(document.getElementById("middle"), stage.node, alternatives.node, transport.node);
  fill(document.getElementById("right"), findings.node, figures.node, plots.node);
  dropPlaces(stage.node, place, (scene) => openScene(store, scene));
  document.body.append(chooser);
  listenToKeys({ store, transport, stage });

  const onState = (state, isLive) => {
    if (state.way === "motion" && !state.law && !state.options.preset && !state.options.centrode) { store.edit((s) => { s.law = FIRST_LAW; }); return; }
    // A train changes nothing of its pair.
    if (!isLive && !live && wanted === JSON.stringify(bare(state))) { undo.disabled = !store.past.length; redo.disabled = !store.future.length; tabs.train.show(model); return; }
    if (isLive && wanted === JSON.stringify(bare(state))) return;
    live = isLive;
    root.dataset.settled = "no";
    undo.disabled = !store.past.length;
    redo.disabled = !store.future.length;
    name.textContent = { design: `${plain(state.driver)} and ${plain(state.follower)}`, mate: plain(state.driver), motion: state.law || "" }[state.way];
    document.title = `${name.textContent} – ${T.product}`;
    drawings.show(state, model);
    law.show(state, model);
    alternatives.show(model);
    controls.show(state, model);
    want(state, isLive);
  };
  store.listen(onState);
  onState(store.state, false);
  root.dataset.ready = "yes";
};

const plain = (drawing) => (drawing ? drawing.name.replace(/\.\w+$/, "") : "–");

const logo = () => svg("svg", { viewBox: "0 0 32 32", "aria-hidden": "true" },
  svg("path", { fill: "var(--driver)", d: "M11 5c5 0 7 3 7 8 0 6-3 13-8 13S1 21 1 15 5 5 11 5z" }),
  svg("path", { fill: "var(--follower)", d: "M24 8c5 0 7 4 7 9s-3 8-7 8-6-4-6-8 2-9 6-9z" }),
  svg("circle", { cx: 9.5, cy: 15, r: 2, fill: "var(--card)" }), svg("circle", { cx: 24.5, cy: 16.5, r: 2, fill: "var(--card)" }));

start();
