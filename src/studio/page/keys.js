// The keyboard, wherever no field has it.

export const listenToKeys = ({ store, transport, stage }) => {
  addEventListener("keydown", (event) => {
    const inField = event.target.closest?.("input:not([type=range]):not([type=checkbox]), textarea, select");
    if ((event.ctrlKey || event.metaKey) && !event.altKey) {
      if (inField) return;
      if (event.key.toLowerCase() === "z") { event.preventDefault(); if (event.shiftKey) store.redo(); else store.undo(); }
      if (event.key.toLowerCase() === "y") { event.preventDefault(); store.redo(); }
      return;
    }
    if (inField || event.altKey || event.target.closest?.(".dialog, .menu")) return;
    const onStage = event.target === document.body || event.target === stage.canvas;
    const step = (Math.PI / 180) * (event.shiftKey ? 10 : 1);
    const acts = {
      " ": () => !event.target.closest("button, summary, input") && transport.play(!transport.playing),
      ArrowLeft: () => onStage && (transport.play(false), transport.goTo(transport.angle - step), true),
      ArrowRight: () => onStage && (transport.play(false), transport.goTo(transport.angle + step), true),
      "+": () => stage.zoom(1.25, [stage.view.x, stage.view.y]),
      "-": () => stage.zoom(0.8, [stage.view.x, stage.view.y]),
      f: () => stage.fit(),
      m: () => stage.toMesh(),
    };
    const act = acts[event.key];
    if (act && act() !== false) event.preventDefault();
  });
};
