// The socket: sends whole states, hears stages, and comes back after a break.

export class Link {
  constructor({ onTold, onLost, onBack }) {
    Object.assign(this, { onTold, onLost, onBack });
    this.generation = 0;
    this.sentAt = new Map();
    this.waiting = null;
    this.delay = 300;
    this.connect();
  }

  connect() {
    const url = new URL("api/socket", location.href);
    url.protocol = "ws:";
    url.hash = "";
    const socket = new WebSocket(url);
    this.socket = socket;
    socket.onopen = () => {
      this.delay = 300;
      this.onBack();
    };
    socket.onmessage = (event) => {
      const told = JSON.parse(event.data);
      if (told.generation !== undefined && told.generation < this.oldest) return;
      this.onTold(told, performance.now() - (this.sentAt.get(told.generation) ?? performance.now()));
    };
    socket.onclose = () => {
      this.onLost();
      setTimeout(() => this.connect(), this.delay);
      this.delay = Math.min(4000, this.delay * 1.6);
    };
  }

  // Wants this state; while something is dragged at most once a frame.
  want(state, live) {
    this.next = { state, live };
    if (this.waiting) return;
    if (!live) { this.send(); return; }
    this.waiting = requestAnimationFrame(() => { this.waiting = null; this.send(); });
  }

  send() {
    if (this.waiting) { cancelAnimationFrame(this.waiting); this.waiting = null; }
    if (!this.next || this.socket.readyState !== WebSocket.OPEN) return;
    this.generation += 1;
    const { state, live } = this.next;
    // A live picture is worth showing until a newer one is there; a settled one makes all before it stale.
    this.oldest = live ? (this.oldest ?? 0) : this.generation;
    this.sentAt.set(this.generation, performance.now());
    if (this.sentAt.size > 200) this.sentAt.delete(this.sentAt.keys().next().value);
    this.socket.send(JSON.stringify({ type: "make", generation: this.generation, state, live }));
  }
}
