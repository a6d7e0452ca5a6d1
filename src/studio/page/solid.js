// The solids as they will be printed, from the same GLB that is taken away, turning with the pair.

import { el } from "./dom.js";
import { T } from "./texts.js";
import { color, onTheme } from "./theme.js";

const VERTEX = `#version 300 es
in vec3 position; in vec3 normal; uniform mat4 world; uniform mat4 camera; out vec3 n; out vec3 p;
void main() { vec4 w = world * vec4(position, 1.0); p = w.xyz; n = mat3(world) * normal; gl_Position = camera * w; }`;
const FRAGMENT = `#version 300 es
precision highp float; in vec3 n; in vec3 p; uniform vec3 tint; uniform vec3 eye; out vec4 made;
void main() {
  vec3 m = normalize(n); vec3 v = normalize(eye - p);
  float key = max(dot(m, normalize(vec3(0.45, -0.35, 0.82))), 0.0);
  float rim = max(dot(m, normalize(vec3(-0.6, 0.5, 0.3))), 0.0);
  float shine = pow(max(dot(reflect(-normalize(vec3(0.45, -0.35, 0.82)), m), v), 0.0), 24.0);
  made = vec4(tint * (0.34 + 0.62 * key + 0.18 * rim) + 0.10 * shine, 1.0);
}`;
const ARRAYS = { 5126: Float32Array, 5125: Uint32Array, 5123: Uint16Array };
const WIDTH = { SCALAR: 1, VEC3: 3, VEC4: 4 };
const MM = 1000;

// Meshes, places and colours of a GLB.
export const readGlb = (buffer) => {
  const view = new DataView(buffer);
  if (view.getUint32(0, true) !== 0x46546c67) throw new Error("no GLB");
  const length = view.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 20, length)));
  const bin = 20 + length + 8;
  const list = (index) => {
    const { bufferView, componentType, count, type } = json.accessors[index];
    return new ARRAYS[componentType](buffer, bin + (json.bufferViews[bufferView].byteOffset || 0), count * WIDTH[type]);
  };
  return json.nodes.filter((node) => node.mesh !== undefined).map((node) => {
    const part = json.meshes[node.mesh].primitives[0];
    const tint = json.materials[part.material].pbrMetallicRoughness.baseColorFactor.slice(0, 3);
    return {
      name: node.name, positions: list(part.attributes.POSITION), normals: list(part.attributes.NORMAL), indices: list(part.indices),
      place: (node.translation || [0, 0, 0]).map((v) => v * MM), turn: node.rotation || [0, 0, 0, 1], tint: tint.map((v) => Math.pow(v, 1 / 2.2)),
    };
  });
};

const times = (a, b) => {
  const out = new Float32Array(16);
  for (let c = 0; c < 4; c += 1) for (let r = 0; r < 4; r += 1) for (let k = 0; k < 4; k += 1) out[4 * c + r] += a[4 * k + r] * b[4 * c + k];
  return out;
};
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => { const l = Math.hypot(...a); return a.map((v) => v / l); };
const looking = (eye, at) => {
  const z = unit(eye.map((v, i) => v - at[i]));
  const x = unit(cross([0, 0, 1], z));
  const y = cross(z, x);
  return new Float32Array([x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0, -dot(x, eye), -dot(y, eye), -dot(z, eye), 1]);
};
const lens = (angle, aspect, near, far) => {
  const f = 1 / Math.tan(angle / 2);
  return new Float32Array([f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0]);
};
const ofQuaternion = ([x, y, z, w], scale, [px, py, pz]) => new Float32Array([
  scale * (1 - 2 * (y * y + z * z)), scale * 2 * (x * y + z * w), scale * 2 * (x * z - y * w), 0,
  scale * 2 * (x * y - z * w), scale * (1 - 2 * (x * x + z * z)), scale * 2 * (y * z + x * w), 0,
  scale * 2 * (x * z + y * w), scale * 2 * (y * z - x * w), scale * (1 - 2 * (x * x + y * y)), 0, px, py, pz, 1]);

export class Solid {
  constructor(transport, poses) {
    Object.assign(this, { transport, poses });
    this.canvas = el("canvas", { tabindex: "0", role: "img", "aria-label": T.solidLabel });
    this.note = el("div", { class: "waiting", hidden: true }, T.solidMaking);
    this.node = el("div", { class: "solid", hidden: true }, this.canvas, this.note);
    this.parts = [];
    this.angle = [-0.9, 0.75];
    this.far = 1;
    transport.listen(() => this.draw());
    onTheme(() => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.node);
    this.listen();
  }

  wait(on) { this.note.hidden = !on; }

  set(buffer) {
    const gl = this.begin();
    if (!gl) return;
    for (const part of this.parts) { gl.deleteVertexArray(part.vao); for (const b of part.buffers) gl.deleteBuffer(b); }
    let [low, high] = [[1e9, 1e9, 1e9], [-1e9, -1e9, -1e9]];
    this.parts = readGlb(buffer).map((part, index) => {
      const vao = gl.createVertexArray();
      gl.bindVertexArray(vao);
      const buffers = ["positions", "normals"].map((key, slot) => {
        const made = gl.createBuffer();
        gl.bindBuffer(gl.ARRAY_BUFFER, made);
        gl.bufferData(gl.ARRAY_BUFFER, part[key], gl.STATIC_DRAW);
        gl.enableVertexAttribArray(slot);
        gl.vertexAttribPointer(slot, 3, gl.FLOAT, false, 0, 0);
        return made;
      });
      const corners = gl.createBuffer();
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, corners);
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, part.indices, gl.STATIC_DRAW);
      for (let i = 0; i < part.positions.length; i += 3) for (let k = 0; k < 3; k += 1) {
        const v = part.positions[i + k] * MM + part.place[k];
        low[k] = Math.min(low[k], v);
        high[k] = Math.max(high[k], v);
      }
      return { ...part, vao, buffers: [...buffers, corners], count: part.indices.length, kind: part.indices.BYTES_PER_ELEMENT === 2 ? gl.UNSIGNED_SHORT : gl.UNSIGNED_INT, gear: index < 2 ? index : -1 };
    });
    this.middle = low.map((v, i) => (v + high[i]) / 2);
    this.size = Math.hypot(...high.map((v, i) => v - low[i]));
    this.draw();
  }

  begin() {
    if (this.gl) return this.gl;
    const gl = this.canvas.getContext("webgl2", { antialias: true });
    if (!gl) { this.note.textContent = T.solidNone; this.note.hidden = false; return null; }
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.bindAttribLocation(program, 0, "position");
    gl.bindAttribLocation(program, 1, "normal");
    gl.linkProgram(program);
    gl.useProgram(program);
    this.at = Object.fromEntries(["world", "camera", "tint", "eye"].map((name) => [name, gl.getUniformLocation(program, name)]));
    gl.enable(gl.DEPTH_TEST);
    this.gl = gl;
    return gl;
  }

  draw() {
    const gl = this.gl;
    const box = this.node.getBoundingClientRect();
    if (!gl || !box.width || !this.parts.length) return;
    const ratio = devicePixelRatio || 1;
    const [w, h] = [Math.round(box.width * ratio), Math.round(box.height * ratio)];
    if (this.canvas.width !== w || this.canvas.height !== h) [this.canvas.width, this.canvas.height] = [w, h];
    gl.viewport(0, 0, w, h);
    const ground = /^#([\da-f]{2})([\da-f]{2})([\da-f]{2})/i.exec(color("paper"));
    gl.clearColor(...ground.slice(1).map((v) => parseInt(v, 16) / 255), 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const [turn, lift] = this.angle;
    const distance = this.size * 1.25 * this.far * Math.max(1, (0.9 * h) / w);
    const eye = [Math.cos(turn) * Math.cos(lift), Math.sin(turn) * Math.cos(lift), Math.sin(lift)].map((v, i) => this.middle[i] + v * distance);
    gl.uniformMatrix4fv(this.at.camera, false, times(lens(0.7, w / h, distance / 50, distance * 4), looking(eye, this.middle)));
    gl.uniform3fv(this.at.eye, eye);
    const angles = this.poses();
    for (const part of this.parts) {
      const half = part.gear >= 0 ? angles[part.gear] / 2 : 0;
      const turned = part.gear >= 0 ? [0, 0, Math.sin(half), Math.cos(half)] : part.turn;
      gl.uniformMatrix4fv(this.at.world, false, ofQuaternion(turned, MM, part.place));
      gl.uniform3fv(this.at.tint, part.tint);
      gl.bindVertexArray(part.vao);
      gl.drawElements(gl.TRIANGLES, part.count, part.kind, 0);
    }
  }

  listen() {
    const { canvas } = this;
    canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
      if (!event.buttons) return;
      this.angle[0] -= event.movementX * 0.008;
      this.angle[1] = Math.min(1.5, Math.max(-1.5, this.angle[1] + event.movementY * 0.008));
      this.draw();
    });
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.far = Math.min(4, Math.max(0.15, this.far * Math.exp(event.deltaY * 0.0012)));
      this.draw();
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: [-0.08, 0], ArrowRight: [0.08, 0], ArrowUp: [0, 0.08], ArrowDown: [0, -0.08] }[event.key];
      if (!by) return;
      event.preventDefault();
      event.stopPropagation();
      this.angle[0] += by[0];
      this.angle[1] = Math.min(1.5, Math.max(-1.5, this.angle[1] + by[1]));
      this.draw();
    });
  }
}
