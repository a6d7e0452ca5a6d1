// Elements made in one call, and nothing ever parsed from text.

const SVG = "http://www.w3.org/2000/svg";

const filled = (node, props, children) => {
  for (const [key, value] of Object.entries(props || {})) {
    if (value === null || value === undefined || value === false) continue;
    if (key === "class") node.setAttribute("class", value);
    else if (key === "data") Object.assign(node.dataset, value);
    else if (key.startsWith("on")) node.addEventListener(key.slice(2), value);
    else if (key in node && !(node instanceof SVGElement) && key !== "list") node[key] = value;
    else node.setAttribute(key, value === true ? "" : value);
  }
  node.append(...children.flat(Infinity).filter((c) => c !== null && c !== undefined && c !== false));
  return node;
};

export const el = (tag, props, ...children) => filled(document.createElement(tag), props, children);
export const svg = (tag, props, ...children) => filled(document.createElementNS(SVG, tag), props, children);
export const fill = (node, ...children) => node.replaceChildren(...children.flat(Infinity).filter(Boolean));

// A short message at the foot of the page.
export const toast = (text, kind = "") => {
  const node = el("div", { class: `toast ${kind}` }, text);
  document.getElementById("toasts").append(node);
  setTimeout(() => node.remove(), kind === "bad" ? 7000 : 3200);
};

// A menu under a button. Closes on a click elsewhere or Escape.
export const menu = (anchor, items) => {
  const box = anchor.getBoundingClientRect();
  const node = el("div", { class: "menu", role: "menu" },
    items.map(({ icon, text, run }) => el("button", {
      type: "button", role: "menuitem", onclick: () => { close(); run(); },
    }, icon || null, text)));
  node.style.top = `${box.bottom + 6}px`;
  node.style.right = `${Math.max(8, innerWidth - box.right)}px`;
  const outside = (event) => { if (!node.contains(event.target)) close(); };
  const keys = (event) => {
    const buttons = Array.from(node.children);
    const at = buttons.indexOf(document.activeElement);
    if (event.key === "Escape") { close(); anchor.focus(); }
    else if (event.key === "ArrowDown") buttons[(at + 1) % buttons.length].focus();
    else if (event.key === "ArrowUp") buttons[(at + buttons.length - 1) % buttons.length].focus();
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
  const close = () => {
    node.remove();
    document.removeEventListener("pointerdown", outside, true);
    document.removeEventListener("keydown", keys, true);
  };
  document.getElementById("layer").append(node);
  document.addEventListener("pointerdown", outside, true);
  document.addEventListener("keydown", keys, true);
  node.firstElementChild?.focus();
};

// A dialog over the page; returns a function that closes it.
export const dialog = (title, closeText, body, footer = null) => {
  const before = document.activeElement;
  const titled = el("h2", { id: "dialog-title" }, title);
  const shut = el("button", { type: "button", class: "plain icon", "aria-label": closeText, onclick: () => close() }, "✕");
  const node = el("div", { class: "dialog", role: "dialog", "aria-modal": "true", "aria-labelledby": "dialog-title" },
    el("header", {}, titled, shut), el("div", { class: "body" }, body), footer && el("footer", {}, footer));
  const veil = el("div", { class: "veil" }, node);
  const keys = (event) => {
    if (event.key === "Escape") { event.stopPropagation(); close(); return; }
    if (event.key !== "Tab") return;
    const stops = Array.from(node.querySelectorAll("button, input, select, textarea, [tabindex='0']")).filter((n) => !n.disabled && n.offsetParent);
    const [first, last] = [stops[0], stops[stops.length - 1]];
    if (event.shiftKey && document.activeElement === first) { last.focus(); event.preventDefault(); }
    else if (!event.shiftKey && document.activeElement === last) { first.focus(); event.preventDefault(); }
  };
  const close = () => {
    veil.remove();
    document.removeEventListener("keydown", keys, true);
    before?.focus?.();
  };
  veil.addEventListener("pointerdown", (event) => { if (event.target === veil) close(); });
  document.addEventListener("keydown", keys, true);
  document.getElementById("layer").append(veil);
  (node.querySelector("[autofocus]") || shut).focus();
  return close;
};
