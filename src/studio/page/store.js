// What a person has chosen, with undo and redo, in the address and in this browser's memory.

const KEPT = "centrode-studio";
const STEPS = 200;

export const EMPTY = { way: "design", driver: null, follower: null, law: null, options: {} };

// The state without its train, which is put together after the pair is made.
export const bare = ({ train, ...state }) => state;

const copy = (state) => JSON.parse(JSON.stringify(state));
const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

const packed = (state) => {
  const bytes = new TextEncoder().encode(JSON.stringify(state));
  return btoa(Array.from(bytes, (b) => String.fromCharCode(b)).join(""))
    .replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
};

const unpacked = (text) => {
  const bytes = Uint8Array.from(atob(text.replace(/-/g, "+").replace(/_/g, "/")), (c) => c.charCodeAt(0));
  return cleaned(JSON.parse(new TextDecoder().decode(bytes)));
};

const trainOf = (train) => {
  if (!train || !Array.isArray(train.links)) return {};
  const links = train.links.slice(0, 60).map(({ on, direction }) => ({ on: Number(on) || 0, direction: Number(direction) || 0 }));
  return { train: { layout: String(train.layout), gears: Number(train.gears) || 2, links } };
};

// Only what a state may hold; throws where nothing can be made of it.
export const cleaned = (given) => {
  const drawing = (d) => (d && typeof d.name === "string" ? { name: d.name, ...(typeof d.id === "string" ? { id: d.id } : {}) } : null);
  const options = {};
  for (const [key, value] of Object.entries(given.options || {})) options[key] = String(value);
  return {
    way: ["design", "mate", "motion"].includes(given.way) ? given.way : "design",
    driver: drawing(given.driver), follower: drawing(given.follower),
    law: typeof given.law === "string" ? given.law : null, options, ...trainOf(given.train),
  };
};

export class Store {
  constructor() {
    this.state = copy(EMPTY);
    this.past = [];
    this.future = [];
    this.before = null;
    this.listeners = new Set();
  }

  listen(listener) { this.listeners.add(listener); }

  // Begins with what the address, the command line or the last visit says.
  begin(given, fallback) {
    const kept = (read) => { try { return read(); } catch { return null; } };
    const hash = /^#s=([\w-]+)$/.exec(location.hash);
    const from = kept(() => hash && unpacked(hash[1]))
      || (given && cleaned(given))
      || kept(() => cleaned(JSON.parse(localStorage.getItem(KEPT))))
      || fallback;
    const steps = kept(() => JSON.parse(sessionStorage.getItem(KEPT)));
    this.state = copy(from);
    if (steps && steps.now && same(steps.now, from)) [this.past, this.future] = [steps.past, steps.future];
    this.keep();
    addEventListener("hashchange", () => {
      const said = /^#s=([\w-]+)$/.exec(location.hash);
      const state = kept(() => said && unpacked(said[1]));
      if (state && !same(state, this.state)) this.edit(() => state);
    });
  }

  // Changes the state; `live` while something is dragged, which becomes one step when it ends.
  edit(change, { live = false } = {}) {
    const next = copy(this.state);
    const changed = change(next) || next;
    if (this.before === null) this.before = copy(this.state);
    this.state = changed;
    if (!live) this.settle();
    this.tell(live);
  }

  settle() {
    if (this.before !== null && !same(this.before, this.state)) {
      this.past.push(this.before);
      if (this.past.length > STEPS) this.past.shift();
      this.future = [];
    }
    this.before = null;
    this.keep();
  }

  step(from, to) {
    if (!from.length) return;
    to.push(copy(this.state));
    this.state = from.pop();
    this.before = null;
    this.keep();
    this.tell(false);
  }

  undo() { this.step(this.past, this.future); }
  redo() { this.step(this.future, this.past); }

  setOption(key, value, how) {
    this.edit((state) => {
      if (value === null) delete state.options[key];
      else state.options[key] = String(value);
    }, how);
  }

  link() { return `${location.origin}${location.pathname}#s=${packed(this.state)}`; }

  keep() {
    history.replaceState(null, "", `#s=${packed(this.state)}`);
    try {
      localStorage.setItem(KEPT, JSON.stringify(this.state));
      sessionStorage.setItem(KEPT, JSON.stringify({ now: this.state, past: this.past.slice(-60), future: this.future.slice(-60) }));
    } catch { /* a full memory loses the history only */ }
  }

  tell(live) { for (const listener of this.listeners) listener(this.state, live); }
}
