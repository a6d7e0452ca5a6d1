"use strict";
(() => {
  const byId = (id) => document.getElementById(id);
  const all = (selector, root = document) => Array.from(root.querySelectorAll(selector));
  const data = JSON.parse(byId("report-data").textContent);
  const { driver_angle: phi, gears } = data.motion;
  const root = document.documentElement;
  const cycle = phi.length ? phi[phi.length - 1] : 0;
  if (!(cycle > 0) || !gears.length) {
    root.dataset.ready = "still";
    return;
  }
  const DEGREE = Math.PI / 180;
  const SECONDS_PER_TURN = 12;
  const svg = byId("gears");
  const slider = byId("angle");
  const play = byId("play");
  const turning = gears.map((gear, i) => ({
    ...gear,
    parts: all(`[data-gear="${i}"]`, svg),
    readout: document.querySelector(`[data-angle="${i}"]`),
  }));

  // Index of the last sample not beyond x, and how far x is on the way to the next.
  const locate = (count, at, x) => {
    let low = 0;
    let high = count - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (at(middle) <= x) low = middle;
      else high = middle;
    }
    const span = at(high) - at(low);
    const part = span > 0 ? (x - at(low)) / span : 0;
    return { low, high, part: Math.min(1, Math.max(0, part)) };
  };
  const between = (a, b, part) => a + (b - a) * part;
  const withMinus = (text) => (Number(text) === 0 ? text.replace("-", "") : text.replace("-", "−"));

  const plots = all("[data-plot]").map((figure) => {
    const plot = data.plots[Number(figure.dataset.plot)];
    return {
      ...plot,
      drawing: figure.querySelector("svg"),
      cursor: figure.querySelector(".cursor"),
      dots: all(".cursor circle", figure),
      readouts: all("output", figure),
    };
  }).filter((plot) => plot.follows_driver && plot.cursor);

  const readable = (value, span) => {
    const decimals = Math.min(6, Math.max(0, Math.ceil(3 - Math.log10(span))));
    return withMinus(value.toFixed(decimals));
  };

  const showPlot = (plot, degrees) => {
    const [left, top, width, height] = plot.field;
    const x = left + (width * (degrees - plot.x[0])) / (plot.x[1] - plot.x[0]);
    const inside = degrees >= plot.x[0] - 1e-9 && degrees <= plot.x[1] + 1e-9;
    plot.cursor.style.display = inside ? "" : "none";
    plot.cursor.firstElementChild.setAttribute("transform", `translate(${(x - left).toFixed(2)} 0)`);
    const span = plot.y[1] - plot.y[0];
    plot.series.forEach(({ points }, i) => {
      if (!points.length) {
        plot.dots[i].style.display = "none";
        return;
      }
      const { low, high, part } = locate(points.length, (k) => points[k][0], degrees);
      const value = between(points[low][1], points[high][1], part);
      plot.dots[i].setAttribute("cx", x.toFixed(2));
      plot.dots[i].setAttribute("cy", (top + (height * (plot.y[1] - value)) / span).toFixed(2));
      plot.readouts[i].textContent = readable(value, span);
    });
  };

  // Where the first two gears touch: r / (L - r) is the momentary speed ratio.
  const pitchPoint = ({ low, high }) => {
    const [a, b] = turning;
    if (!b) return a.axis;
    const last = phi.length - 1;
    const from = Math.max(0, low - 1);
    const to = Math.min(last, high + 1);
    const turn = a.angle[to] - a.angle[from];
    const speed = turn ? Math.abs((b.angle[to] - b.angle[from]) / turn) : 1;
    const part = speed / (1 + speed);
    return [between(a.axis[0], b.axis[0], part), between(a.axis[1], b.axis[1], part)];
  };

  const contacts = {
    frames: data.contacts,
    force: all(".contacts .halo, .contacts .force", svg),
    touch: svg.querySelector(".contacts .touch"),
  };
  contacts.apart = contacts.frames.length > 1
    ? (contacts.frames[contacts.frames.length - 1][0] - contacts.frames[0][0]) / (contacts.frames.length - 1)
    : cycle;
  byId("contacts").hidden = !contacts.frames.length;

  // The contacts of the nearest moment, turned with the driver so that they stay on its flanks.
  const showContacts = () => {
    let nearest = null;
    let distance = Infinity;
    for (const frame of contacts.frames) {
      const apart = Math.abs(angle - frame[0]);
      const round = Math.min(apart, cycle - apart);
      if (round < distance) [nearest, distance] = [frame, round];
    }
    // Where the run has not been, nothing is known.
    if (distance > contacts.apart) nearest = null;
    let dots = "";
    let lines = "";
    const length = data.force_length * (near ? data.close_up : data.view[2]);
    const turn = nearest ? angle - nearest[0] : 0;
    const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
    const [left, low] = turning[0].axis;
    const text = (v) => v.toFixed(4);
    for (let i = 1; nearest && i + 3 < nearest.length; i += 4) {
      const [x, y, forceX, forceY] = nearest.slice(i, i + 4);
      const at = [left + cos * (x - left) - sin * (y - low), low + sin * (x - left) + cos * (y - low)];
      const start = `M${at.map(text).join(" ")}`;
      dots += `${start}h0`;
      lines += `${start}l${text(length * forceX)} ${text(length * forceY)}`;
    }
    contacts.touch.setAttribute("d", dots);
    for (const path of contacts.force) path.setAttribute("d", lines);
  };

  let angle = 0;
  let near = false;
  const show = () => {
    const place = locate(phi.length, (k) => phi[k], angle);
    for (const gear of turning) {
      const turned = between(gear.angle[place.low], gear.angle[place.high], place.part) / DEGREE;
      const pose = `translate(${gear.axis[0]} ${gear.axis[1]}) rotate(${turned.toFixed(4)})`;
      for (const part of gear.parts) part.setAttribute("transform", pose);
      gear.readout.textContent = `${withMinus(turned.toFixed(1))}°`;
    }
    if (near) {
      const [x, y] = pitchPoint(place);
      const width = data.close_up;
      const height = (width * data.view[3]) / data.view[2];
      const box = [x - width / 2, -y - height / 2, width, height];
      svg.setAttribute("viewBox", box.map((v) => v.toFixed(4)).join(" "));
    }
    if (contacts.frames.length) showContacts();
    // A driver that swings goes back along its plots.
    const driver = turning[0].angle;
    const driven = Math.abs(between(driver[place.low], driver[place.high], place.part)) / DEGREE;
    for (const plot of plots) showPlot(plot, driven);
    slider.value = String(angle / DEGREE);
    slider.setAttribute("aria-valuetext", `${(angle / DEGREE).toFixed(1)} degrees`);
  };

  let playing = false;
  let before = 0;
  const speed = byId("speed");
  const step = (now) => {
    if (!playing) return;
    const elapsed = Math.min(0.1, Math.max(0, (now - before) / 1000));
    before = now;
    angle = (angle + (elapsed * Number(speed.value) * 2 * Math.PI) / SECONDS_PER_TURN) % cycle;
    show();
    requestAnimationFrame(step);
  };
  const setPlaying = (on) => {
    if (on && !playing) {
      before = performance.now();
      requestAnimationFrame(step);
    }
    playing = on;
    play.textContent = on ? "Pause" : "Play";
    play.setAttribute("aria-pressed", String(on));
  };
  const goTo = (radians) => {
    setPlaying(false);
    angle = Math.min(cycle, Math.max(0, radians));
    show();
  };

  slider.max = (cycle / DEGREE).toFixed(2);
  slider.addEventListener("input", () => goTo(Number(slider.value) * DEGREE));
  play.addEventListener("click", () => setPlaying(!playing));
  document.addEventListener("keydown", (event) => {
    const busy = event.target.closest("button, select, a, input[type=checkbox]");
    if (event.key !== " " || busy || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    setPlaying(!playing);
  });
  for (const box of all("[data-layer]")) {
    const apply = () => svg.classList.toggle(`no-${box.dataset.layer}`, !box.checked);
    box.addEventListener("change", apply);
    apply();
  }
  const closeUp = byId("close-up");
  const setNear = () => {
    near = closeUp.checked;
    svg.classList.toggle("near", near);
    if (!near) svg.setAttribute("viewBox", data.view.join(" "));
    show();
  };
  closeUp.addEventListener("change", setNear);
  for (const plot of plots) {
    const aim = (event) => {
      const frame = plot.drawing.getBoundingClientRect();
      const x = ((event.clientX - frame.left) / frame.width) * plot.drawing.viewBox.baseVal.width;
      const part = (x - plot.field[0]) / plot.field[2];
      goTo(between(plot.x[0], plot.x[1], part) * DEGREE);
    };
    plot.drawing.addEventListener("pointerdown", (event) => {
      plot.drawing.setPointerCapture(event.pointerId);
      aim(event);
    });
    plot.drawing.addEventListener("pointermove", (event) => {
      if (event.buttons) aim(event);
    });
  }

  document.querySelector(".controls").hidden = false;
  setNear();
  const goToFragment = () => {
    const asked = /^#angle=(\d+(?:\.\d+)?)$/.exec(location.hash);
    if (asked) goTo(Number(asked[1]) * DEGREE);
    return Boolean(asked);
  };
  addEventListener("hashchange", goToFragment);
  if (!goToFragment()) setPlaying(!matchMedia("(prefers-reduced-motion: reduce)").matches);
  root.dataset.ready = "turning";
})();
