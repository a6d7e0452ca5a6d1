// Taking the result away: files, the command line, a scene, a link.

import { dialog, el, fill, toast } from "./dom.js";
import { icon } from "./icons.js";
import { adopt, kept } from "./shelf.js";
import { bare, cleaned } from "./store.js";
import { T } from "./texts.js";

const post = (path, body) => fetch(path, { method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify(body) });

// One file a format that is worth a download of its own.
const FILES = { html: "report.html", glb: "pair.glb", "3mf": "pair.3mf", obj: "pair.obj", step: "pair.step", svg: "pair.svg", dxf: "pair.dxf", mjcf: "scene.xml", json: "design.json" };

const saveBlob = (blob, name) => {
  const link = el("a", { href: URL.createObjectURL(blob), download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
};

const copyText = async (text) => {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const field = el("textarea", { value: text });
    document.body.append(field);
    field.select();
    document.execCommand("copy");
    field.remove();
  }
  toast(T.copied);
};

// The state as the program's other faces take it.
const textsOf = async (state) => {
  const answer = await post("api/texts", bare(state));
  const said = await answer.json();
  if (!answer.ok) throw new Error(said.text);
  return said;
};

export const copyLink = (store) => copyText(store.link());
export const copyCommand = async (store) => {
  try { await copyText((await textsOf(store.state)).command); } catch (error) { toast(error.message, "bad"); }
};
export const saveScene = async (store) => {
  try { saveBlob(new Blob([(await textsOf(store.state)).scene], { type: "application/toml" }), "pair.toml"); } catch (error) { toast(error.message, "bad"); }
};

// Takes the place of the state what a scene or a design.json says.
export const openScene = async (store, file) => {
  const answer = await fetch("api/open", { method: "POST", headers: { "content-type": "text/plain" }, body: await file.text() });
  const said = await answer.json().catch(() => ({ text: T.noScene }));
  if (!answer.ok) { toast(said.text, "bad"); return; }
  for (const drawing of [said.driver, said.follower]) await adopt(drawing);
  store.edit(() => cleaned(said));
};

export const fetchFile = async (state, format, file) => {
  const answer = await post("api/export", { state: bare(state), formats: [format], file, place: "download" });
  if (!answer.ok) throw new Error((await answer.json()).text);
  return answer.blob();
};

const nameOf = (answer, otherwise) => /filename="([^"]+)"/.exec(answer.headers.get("content-disposition") || "")?.[1] || otherwise;

// The files of a train, as a zip or to the folder.
export const takeTrain = async (state, train, place) => {
  const answer = await post("api/train", { state: bare(state), train, place });
  if (!answer.ok) throw new Error((await answer.json()).text);
  if (place === "folder") return answer.json();
  saveBlob(await answer.blob(), nameOf(answer, "train.zip"));
  return null;
};

export const takeAway = (store, formats, folder, model) => {
  const state = bare(store.state);
  const wanted = new Set(formats.filter((f) => f !== "gif"));
  const status = el("span", { class: "soft", role: "status" });
  const busy = async (work) => {
    const buttons = Array.from(document.querySelectorAll(".dialog button:not([disabled])"));
    for (const button of buttons) button.disabled = true;
    status.textContent = `${T.making} …`;
    try { status.textContent = (await work()) || ""; } catch (error) { status.textContent = ""; toast(error.message, "bad"); }
    for (const button of buttons) button.disabled = false;
    primary();
  };
  const chosen = () => { const all = formats.filter((f) => wanted.has(f)); return all.length ? all : ["json"]; };
  const rows = el("div", { class: "formats" }, formats.map((format) => {
    const [name, what] = T.formats[format] || [format, ""];
    const id = `format-${format}`;
    const box = el("input", { type: "checkbox", id, checked: wanted.has(format), onchange: () => { wanted[box.checked ? "add" : "delete"](format); primary(); } });
    const one = FILES[format] && el("button", { type: "button", class: "small", "aria-label": `${T.one} ${FILES[format]}`, onclick: () => busy(async () => saveBlob(await fetchFile(state, format, FILES[format]), FILES[format])) }, icon("save"));
    return el("div", { class: "format" }, box, el("label", { htmlFor: id }, el("strong", {}, name), el("small", {}, what)), one || el("span"));
  }));
  const zip = el("button", { type: "button", class: "primary", autofocus: true, onclick: () => busy(async () => {
    const answer = await post("api/export", { state, formats: chosen(), place: "download" });
    if (!answer.ok) throw new Error((await answer.json()).text);
    saveBlob(await answer.blob(), nameOf(answer, "pair.zip"));
  }) }, icon("save"), T.downloadZip);
  const write = el("button", { type: "button", onclick: () => busy(async () => {
    const answer = await post("api/export", { state, formats: chosen(), place: "folder" });
    const said = await answer.json();
    if (!answer.ok) throw new Error(said.text);
    return T.written(said.files.length, said.folder);
  }) }, `${T.toFolder} ${folder}`);
  const primary = () => { zip.disabled = write.disabled = !wanted.size; };
  const commandText = el("pre");
  const own = el("div", { hidden: true });
  const command = el("div", { class: "copy" }, el("div", { class: "row" }, el("h2", { class: "stretch" }, T.asCommand),
    el("button", { type: "button", class: "small", onclick: () => copyText(commandText.textContent) }, icon("copy"), T.copy),
    el("button", { type: "button", class: "small", onclick: () => saveScene(store) }, icon("save"), T.asScene)), commandText, own);
  textsOf(state).then((texts) => { commandText.textContent = texts.command; }, (error) => { commandText.textContent = error.message; });
  const drawings = [state.driver, state.follower].filter((d) => d?.id && state.way !== "motion");
  if (drawings.length) {
    own.hidden = false;
    fill(own, el("p", { class: "calm" }, T.ownDrawings), el("div", { class: "row" }, drawings.map((d) => el("button", { type: "button", class: "small", onclick: async () => {
      const drawing = await kept(d.id);
      if (drawing) saveBlob(new Blob([drawing.bytes]), d.name);
    } }, icon("save"), d.name))));
  }
  const warning = model.verdict === "unsound" ? el("p", { class: "why" }, T.notSound) : null;
  dialog(T.takeAway, T.close, el("div", {}, warning, rows, command), [status, el("span", { class: "stretch" }), write, zip]);
};
