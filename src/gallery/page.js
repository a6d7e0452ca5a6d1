
"use strict";
(() => {
  const byId = (id) => document.getElementById(id);
  const { grid, rows } = JSON.parse(byId("data").textContent);
  const place = byId("pairs");
  const ORDER = ["good", "warnings", "unjudged", "unsound", "refused"];
  const SECONDS_PER_TURN = 12;
  const TURN = 2 * Math.PI;
  const svgNamed = (name, attributes) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    return made;
  };
  const htmlNamed = (name, text = "", kind = "") => {
    const made = document.createElement(name);
    made.textContent = text;
    if (kind) made.className = kind;
    return made;
  };
  const resemblance = (row) => (row.i ? Math.min(...row.i) : -1);

  // Follower angle at a driver angle: psi grows by the same in every period.
  const psi = ({ f, m }, angle) => {
    const at = (angle * f[0]) / TURN;
    const periods = Math.floor(at);
    const x = (at - periods) * (m.length - 1);
    const i = Math.min(m.length - 2, Math.floor(x));
    return (periods * m[m.length - 1] + m[i] + (x - i) * (m[i + 1] - m[i])) / 1000;
  };

  const drawn = (pair) => {
    const height = Math.max(...pair.r) * 1.03;
    const [left, right] = [-pair.r[0] * 1.03, grid + pair.r[1] * 1.03];
    const svg = svgNamed("svg", { viewBox: `${left} ${-height} ${right - left} ${2 * height}`, role: "img" });
    const world = svg.appendChild(svgNamed("g", { transform: "scale(1 -1)" }));
    const gears = [0, 1].map((i) => {
      const gear = world.appendChild(svgNamed("g", {}));
      gear.appendChild(svgNamed("path", { class: `g${i}`, d: pair.o[i] }));
      gear.appendChild(svgNamed("path", { class: "n", d: pair.n[i] }));
      gear.appendChild(svgNamed("circle", { class: "axis", r: grid / 55 }));
      return gear;
    });
    const turn = (angle) => {
      gears[0].setAttribute("transform", `rotate(${((angle * 360) / TURN).toFixed(2)})`);
      gears[1].setAttribute("transform", `translate(${grid} 0) rotate(${((-psi(pair, angle) * 360) / TURN).toFixed(2)})`);
    };
    return { svg, turn };
  };

  const cards = rows.map((row) => {
    const card = htmlNamed("article");
    const text = htmlNamed("div", "", "text");
    const title = text.appendChild(htmlNamed("h2"));
    const link = title.appendChild(htmlNamed("a", `${row.d} · ${row.f}`));
    link.href = `${encodeURIComponent(row.at)}/`;
    const verdict = title.appendChild(htmlNamed("b", row.v));
    verdict.style.color = `var(--${row.v})`;
    const list = text.appendChild(htmlNamed("dl"));
    const fact = (name, value) => {
      const both = list.appendChild(htmlNamed("div"));
      both.append(htmlNamed("dt", name), htmlNamed("dd", value));
    };
    fact("K", row.k);
    if (row.e !== null) {
      fact("E", row.e.toFixed(3));
      fact("torque", row.q.toFixed(2));
      fact("likeness", row.i.map((v) => `${(100 * v).toFixed(0)}`).join(" · ") + " %");
      if (row.t) fact("teeth", row.t.join(" : "));
    }
    if (row.r.length) card.title = row.r.join("\n");
    if (!row.p) card.append(htmlNamed("div", row.r.join(" "), "gone"));
    card.append(text);
    return { row, card, turn: null };
  });

  let angle = 0;
  const seen = new Set();
  const watcher = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      const one = cards[Number(target.dataset.index)];
      if (!isIntersecting) {
        seen.delete(one);
        continue;
      }
      if (!one.turn && one.row.p) {
        const { svg, turn } = drawn(one.row.p);
        target.prepend(svg);
        one.turn = turn;
        turn(angle);
      }
      seen.add(one);
    }
  }, { rootMargin: "150px" });
  cards.forEach(({ card }, i) => {
    card.dataset.index = String(i);
    watcher.observe(card);
  });

  const number = (id) => (byId(id).value === "" ? null : Number(byId(id).value));
  const by = {
    e: (r) => r.e ?? Infinity,
    q: (r) => r.q ?? Infinity,
    i: (r) => -resemblance(r),
    v: (r) => ORDER.indexOf(r.v),
    d: () => 0,
  };
  const show = () => {
    const key = by[byId("sort").value];
    const [k, v, most, torque, like] = [byId("k").value, byId("v").value, number("e"), number("q"), number("i")];
    const wanted = byId("name").value.trim().toLowerCase();
    const kept = cards.filter(({ row }) => (!k || row.k === k) && (!v || row.v === v)
      && (most === null || (row.e ?? Infinity) <= most) && (torque === null || (row.q ?? Infinity) <= torque)
      && (like === null || 100 * resemblance(row) >= like)
      && (!wanted || `${row.d} ${row.f}`.toLowerCase().includes(wanted)));
    kept.sort((a, b) => key(a.row) - key(b.row) || a.row.d.localeCompare(b.row.d)
      || a.row.f.localeCompare(b.row.f) || a.row.k.localeCompare(b.row.k));
    place.replaceChildren(...kept.map(({ card }) => card));
    byId("count").textContent = kept.length === rows.length ? `${rows.length} pairs` : `${kept.length} of ${rows.length} pairs`;
  };
  const offer = (id, values) => {
    for (const value of values) byId(id).append(new Option(value, value));
  };
  offer("k", [...new Set(rows.map((r) => r.k))].sort());
  offer("v", ORDER.filter((v) => rows.some((r) => r.v === v)));
  byId("controls").addEventListener("input", show);
  byId("controls").addEventListener("submit", (event) => event.preventDefault());
  const setInputs = () => place.classList.toggle("no-inputs", !byId("inputs").checked);
  byId("inputs").addEventListener("change", setInputs);

  let playing = false;
  let before = 0;
  const step = (now) => {
    if (!playing) return;
    angle += (Math.min(0.1, (now - before) / 1000) * TURN) / SECONDS_PER_TURN;
    before = now;
    for (const one of seen) if (one.turn) one.turn(angle);
    requestAnimationFrame(step);
  };
  const setPlaying = (on) => {
    playing = on;
    byId("play").textContent = on ? "Pause" : "Play";
    if (on) {
      before = performance.now();
      requestAnimationFrame(step);
    }
  };
  byId("play").addEventListener("click", () => setPlaying(!playing));
  byId("controls").hidden = false;
  show();
  setPlaying(!matchMedia("(prefers-reduced-motion: reduce)").matches);
  document.documentElement.dataset.ready = "turning";
})();
