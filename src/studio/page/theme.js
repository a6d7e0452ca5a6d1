// Dark or light: as the system says, or as chosen here.

const KEPT = "centrode-theme";
const root = document.documentElement;
const dark = matchMedia("(prefers-color-scheme: dark)");
const listeners = new Set();

const chosen = () => { try { return localStorage.getItem(KEPT); } catch { return null; } };

const apply = () => {
  root.dataset.theme = chosen() || (dark.matches ? "dark" : "light");
  for (const listener of listeners) listener();
};

export const isDark = () => root.dataset.theme === "dark";
export const toggle = () => {
  try { localStorage.setItem(KEPT, isDark() ? "light" : "dark"); } catch { /* for this visit only */ }
  apply();
};
export const onTheme = (listener) => listeners.add(listener);

// A colour of the style sheet, for canvases.
const cache = new Map();
listeners.add(() => cache.clear());
export const color = (name) => {
  if (!cache.has(name)) cache.set(name, getComputedStyle(root).getPropertyValue(`--${name}`).trim());
  return cache.get(name);
};

dark.addEventListener("change", apply);
apply();
