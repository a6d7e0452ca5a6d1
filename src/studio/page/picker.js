// Choosing a drawing: a built-in shape, a file, or one drawn by hand.

import { dialog, el, fill, toast } from "./dom.js";
import { icon } from "./icons.js";
import { pencil } from "./pencil.js";
import { give } from "./shelf.js";
import { T } from "./texts.js";

let largest = 64 << 20;
export const setLargest = (bytes) => { largest = bytes; };

// Takes a file; returns how a state names it, or nothing where it is no drawing.
export const take = async (file) => {
  if (file.size > largest) { toast(T.tooLarge(Math.round(largest / (1 << 20))), "bad"); return null; }
  try {
    return await give(file.name, await file.arrayBuffer());
  } catch (error) {
    toast(error.message, "bad");
    return null;
  }
};

export const KINDS = ".svg,.png,.jpg,.jpeg,.tif,.tiff,.bmp,.csv,.txt,.json,.dxf";

export const pick = (side, shapes, current, onPicked) => {
  const done = (drawing) => { close(); onPicked(drawing); };
  const input = el("input", { type: "file", accept: KINDS, hidden: true, onchange: async () => {
    const drawing = input.files[0] && await take(input.files[0]);
    if (drawing) done(drawing);
  } });
  const well = el("button", { type: "button", class: "well", onclick: () => input.click() }, icon("file"), el("strong", {}, T.dropHere), el("span", { class: "soft" }, T.dropKinds));
  well.addEventListener("dragover", (event) => { event.preventDefault(); event.stopPropagation(); well.classList.add("over"); });
  well.addEventListener("dragleave", () => well.classList.remove("over"));
  well.addEventListener("drop", async (event) => {
    event.preventDefault();
    event.stopPropagation();
    well.classList.remove("over");
    const drawing = event.dataTransfer.files[0] && await take(event.dataTransfer.files[0]);
    if (drawing) done(drawing);
  });
  const grid = el("div", { class: `shapes ${side === "follower" ? "follower-shapes" : ""}`, role: "listbox", "aria-label": T.builtIn }, shapes.map((name) => {
    const thumb = el("i", { "aria-hidden": "true" });
    thumb.style.setProperty("--shape", `url("shapes/${name}.svg")`);
    return el("button", { type: "button", role: "option", "aria-selected": String(current?.name === name && !current.id), onclick: () => done({ name }) }, thumb, name);
  }));
  grid.addEventListener("keydown", (event) => {
    const all = Array.from(grid.children);
    const at = all.indexOf(document.activeElement);
    const columns = Math.max(1, Math.round(grid.clientWidth / all[0].offsetWidth));
    const to = { ArrowLeft: at - 1, ArrowRight: at + 1, ArrowUp: at - columns, ArrowDown: at + columns }[event.key];
    if (to === undefined || !all[to]) return;
    event.preventDefault();
    all[to].focus();
  });
  const own = el("div", {}, well, grid);
  const body = el("div", {}, input);
  const tabs = el("div", { class: "picker-tabs", role: "tablist" });
  const show = (which) => {
    fill(tabs, [["shapes", T.builtIn], ["pencil", T.pencil]].map(([key, text]) => el("button", { type: "button", class: "small", role: "tab", "aria-selected": String(which === key), onclick: () => show(key) }, text)));
    fill(body, input, tabs, which === "pencil" ? pencil(current, done) : own);
  };
  show("shapes");
  const close = dialog(T.chooseFor(T[side].toLowerCase()), T.close, body);
};

// Two places to drop files on, over the stage.
export const dropPlaces = (stage, onDropped, onScene) => {
  const halves = ["driver", "follower"].map((side) => el("div", {}, T.dropOn(T[side].toLowerCase())));
  const veil = el("div", { class: "drop", hidden: true }, halves);
  stage.append(veil);
  let depth = 0;
  const sideOf = (event) => {
    const box = stage.getBoundingClientRect();
    return event.clientX < box.left + box.width / 2 ? 0 : 1;
  };
  const files = (event) => Array.from(event.dataTransfer?.types || []).includes("Files");
  addEventListener("dragenter", (event) => { if (files(event)) { depth += 1; veil.hidden = false; } });
  addEventListener("dragleave", (event) => { if (files(event)) { depth -= 1; if (depth <= 0) { depth = 0; veil.hidden = true; } } });
  addEventListener("dragover", (event) => {
    if (!files(event)) return;
    event.preventDefault();
    halves.forEach((half, i) => half.classList.toggle("over", i === sideOf(event)));
  });
  addEventListener("drop", async (event) => {
    depth = 0;
    veil.hidden = true;
    if (!files(event)) return;
    event.preventDefault();
    const given = Array.from(event.dataTransfer.files);
    const scene = given.find((file) => /\.toml$|^design.*\.json$/i.test(file.name));
    if (scene) { onScene(scene); return; }
    const first = sideOf(event);
    const drawings = [];
    for (const file of given.slice(0, 2)) drawings.push(await take(file));
    if (drawings.some(Boolean)) onDropped(drawings.length === 2 ? drawings : first ? [null, drawings[0]] : [drawings[0], null]);
  });
};
