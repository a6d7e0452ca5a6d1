// Drawings that were given, kept in this browser so that they can be sent again, and their way to the server.

const open = () => new Promise((resolve, reject) => {
  const request = indexedDB.open("centrode-studio", 1);
  request.onupgradeneeded = () => request.result.createObjectStore("drawings");
  request.onsuccess = () => resolve(request.result);
  request.onerror = () => reject(request.error);
});

const memory = new Map();

const inStore = async (mode, work) => {
  const base = await open();
  return new Promise((resolve, reject) => {
    const request = work(base.transaction("drawings", mode).objectStore("drawings"));
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
};

const keep = async (id, drawing) => {
  memory.set(id, drawing);
  try { await inStore("readwrite", (store) => store.put(drawing, id)); } catch { /* then for this visit only */ }
};

export const kept = async (id) => {
  if (memory.has(id)) return memory.get(id);
  try { return await inStore("readonly", (store) => store.get(id)); } catch { return undefined; }
};

const post = async (name, bytes) => {
  const answer = await fetch(`api/drawing?name=${encodeURIComponent(name)}`, { method: "POST", body: bytes });
  const said = await answer.json().catch(() => ({}));
  if (!answer.ok) throw new Error(said.text || `${answer.status}`);
  return said.id;
};

// Gives a drawing to the server; returns how a state names it.
export const give = async (name, bytes) => {
  const id = await post(name, bytes);
  await keep(id, { name, bytes });
  return { name, id };
};

// Sends drawings again that the server has lost; false when this browser does not have them either.
export const giveAgain = async (ids) => {
  for (const id of ids) {
    const drawing = await kept(id);
    if (!drawing) return false;
    await post(drawing.name, drawing.bytes);
  }
  return true;
};

// A drawing that the server made or was started with, fetched so that it survives.
export const adopt = async (drawing) => {
  if (!drawing?.id || await kept(drawing.id)) return;
  const answer = await fetch(`api/drawing?id=${drawing.id}`);
  if (answer.ok) await keep(drawing.id, { name: drawing.name, bytes: await answer.arrayBuffer() });
};
