// A closed curve drawn by hand, whose points can be dragged afterwards.

import { el } from "./dom.js";
import { give, kept } from "./shelf.js";
import { T } from "./texts.js";
import { color } from "./theme.js";

const POINTS = 24;
const NAME = "pencil.json";

// A smooth closed curve through the points (centripetal Catmull-Rom), flattened.
export const smoothClosed = (points, per = 12) => {
  const n = points.length;
  const curve = [];
  for (let i = 0; i < n; i += 1) {
    const [a, b, c, d] = [-1, 0, 1, 2].map((k) => points[(i + k + n) % n]);
    for (let j = 0; j < per; j += 1) {
      const t = j / per;
      const at = (k) => 0.5 * (2 * b[k] + (c[k] - a[k]) * t + (2 * a[k] - 5 * b[k] + 4 * c[k] - d[k]) * t * t + (3 * b[k] - a[k] - 3 * c[k] + d[k]) * t * t * t);
      curve.push([at(0), at(1)]);
    }
  }
  return curve;
};

// Evenly spaced points of a stroke that is closed by a straight line.
const evenly = (stroke, count) => {
  const ring = [...stroke, stroke[0]];
  const lengths = [0];
  for (let i = 1; i < ring.length; i += 1) lengths.push(lengths[i - 1] + Math.hypot(ring[i][0] - ring[i - 1][0], ring[i][1] - ring[i - 1][1]));
  const total = lengths[lengths.length - 1];
  let k = 0;
  return Array.from({ length: count }, (_, i) => {
    const at = (total * i) / count;
    while (lengths[k + 1] < at) k += 1;
    const part = (at - lengths[k]) / (lengths[k + 1] - lengths[k] || 1);
    return [0, 1].map((c) => ring[k][c] + part * (ring[k + 1][c] - ring[k][c]));
  });
};

export const pencil = (current, onDone) => {
  const canvas = el("canvas", { tabindex: "0", role: "img", "aria-label": T.pencilHelp });
  let points = [];
  let stroke = null;
  let held = -1;
  const size = () => canvas.getBoundingClientRect();
  const draw = () => {
    const box = size();
    const ratio = devicePixelRatio || 1;
    canvas.width = box.width * ratio;
    canvas.height = box.height * ratio;
    const c = canvas.getContext("2d");
    c.scale(ratio, ratio);
    const line = stroke || (points.length ? smoothClosed(points) : []);
    if (!line.length) return;
    c.beginPath();
    line.forEach(([x, y], i) => c[i ? "lineTo" : "moveTo"](x, y));
    if (!stroke) { c.closePath(); c.fillStyle = color("accent-soft"); c.fill(); }
    c.strokeStyle = color("accent");
    c.lineWidth = 2.5;
    c.lineJoin = "round";
    c.stroke();
    for (const [x, y] of stroke ? [] : points) {
      c.beginPath(); c.arc(x, y, 5, 0, 7);
      c.fillStyle = color("card"); c.fill();
      c.lineWidth = 2; c.stroke();
    }
    done.disabled = points.length < 4;
  };
  const at = (event) => { const box = size(); return [event.clientX - box.left, event.clientY - box.top]; };
  const nearest = ([x, y]) => points.findIndex((p) => Math.hypot(p[0] - x, p[1] - y) < 14);
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    held = nearest(at(event));
    if (held < 0) stroke = [at(event)];
  });
  canvas.addEventListener("pointermove", (event) => {
    if (held >= 0) points[held] = at(event);
    else if (stroke) {
      const [now, last] = [at(event), stroke[stroke.length - 1]];
      if (Math.hypot(now[0] - last[0], now[1] - last[1]) > 3) stroke.push(now);
    } else return;
    draw();
  });
  canvas.addEventListener("pointerup", () => {
    if (stroke && stroke.length > 8) points = evenly(stroke, POINTS);
    stroke = null;
    held = -1;
    draw();
  });
  canvas.addEventListener("dblclick", (event) => {
    const i = nearest(at(event));
    if (i >= 0 && points.length > 4) points.splice(i, 1);
    draw();
  });
  const use = async () => {
    const high = size().height;
    const ring = smoothClosed(points).map(([x, y]) => [Number(x.toFixed(2)), Number((high - y).toFixed(2))]);
    const handles = points.map(([x, y]) => [Number(x.toFixed(2)), Number((high - y).toFixed(2))]);
    try {
      onDone(await give(NAME, new TextEncoder().encode(JSON.stringify({ points: ring, handles }))));
    } catch (error) {
      said.textContent = error.message;
    }
  };
  const done = el("button", { type: "button", class: "primary", disabled: true, onclick: use }, T.pencilDone);
  const clear = el("button", { type: "button", onclick: () => { points = []; draw(); } }, T.pencilClear);
  const said = el("p", { class: "soft", role: "alert" });
  // A curve drawn before can be gone on with.
  const load = async () => {
    if (current?.name !== NAME || !current.id) return;
    const before = await kept(current.id);
    const record = before && JSON.parse(new TextDecoder().decode(before.bytes));
    const high = size().height;
    if (record?.handles) { points = record.handles.map(([x, y]) => [x, high - y]); draw(); }
  };
  requestAnimationFrame(() => { draw(); load(); });
  return el("div", { class: "pencil" }, el("p", { class: "soft" }, T.pencilHelp), canvas, said, el("div", { class: "row" }, clear, el("span", { class: "stretch" }), done));
};
