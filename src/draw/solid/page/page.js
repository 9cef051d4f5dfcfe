'use strict';
// Shows the scene: the part in the colours of its allowance, the blank as glass, contacts, and a section. Lengths are
// millimetres from the low corner of the box; z is up. Places of vertices are whole multiples of `scene.step`, 65,535
// to the box: enough to be looked at, and no measure of anything.

const scene = JSON.parse(document.getElementById('scene').textContent);
const el = (id) => document.getElementById(id);
const canvas = el('view');

// ---- vectors ----
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const sum = (a, b, k = 1) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
const unit = (a) => a.map((x) => x / (Math.hypot(...a) || 1));
const clamp = (x, low, high) => Math.min(high, Math.max(low, x));

// ---- what is shown ----
const middle = scene.extent.map((x) => x / 2);
const size = Math.hypot(...scene.extent);
const state = { centre: middle, yaw: 0, pitch: 0, width: size, contact: -1, section: null, at: 0, cutPart: true };
/** The view by the direction towards the viewer; z stays up. */
function look(towards) {
  const t = unit(towards);
  state.pitch = Math.asin(clamp(t[2], -1, 1));
  if (Math.hypot(t[0], t[1]) > 1e-6) state.yaw = Math.atan2(t[1], t[0]);
  else state.yaw = -Math.PI / 2;
}
function axes() {
  const [c, s] = [Math.cos(state.yaw), Math.sin(state.yaw)];
  const [cp, sp] = [Math.cos(state.pitch), Math.sin(state.pitch)];
  return { right: [-s, c, 0], up: [-c * sp, -s * sp, cp], towards: [c * cp, s * cp, sp] };
}
const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => scene.extent.map((x, i) => ((k >> i) & 1 ? x : 0)));
function whole() {
  state.centre = middle;
  const { right, up } = axes();
  const half = (along) => Math.max(...corners.map((p) => dot(along, sum(p, middle, -1))));
  const ratio = (canvas.clientWidth || 1) / (canvas.clientHeight || 1);
  state.width = 2.16 * Math.max(half(right), half(up) * ratio) || 1;
  state.contact = -1;
}
/** The direction or its opposite, so that what is cut away is the viewer's side. */
const facing = (n) => (dot(n, axes().towards) < 0 ? n.map((x) => -x) : n);
/** The plane of the section keeps what lies behind it: `n` points towards what is cut away. */
function cut(section) {
  state.section = section;
  for (const button of el('planes').children)
    button.setAttribute('aria-pressed', button.value === (section?.name ?? 'off'));
  el('plane').disabled = !section;
  if (!section) return;
  const along = corners.map((p) => dot(section.n, p));
  section.low = Math.min(...along);
  section.high = Math.max(...along);
  slide(section.at ?? (section.low + section.high) / 2);
}
function slide(at) {
  state.at = clamp(at, state.section.low, state.section.high);
  el('plane').value = (1000 * (state.at - state.section.low)) / (state.section.high - state.section.low);
}
const tightest = scene.contacts.reduce((best, one, k, all) => (one.distance < all[best].distance ? k : best), 0);
/** Looks at a contact along a section through it, as near as shows its distance. */
function visit(k) {
  const contact = scene.contacts[k];
  if (!contact) return;
  state.contact = k;
  state.centre = contact.place;
  state.width = Math.max(16 * Math.abs(contact.distance), 0.01 * size);
  const upright = cross(contact.outward, [0, 0, 1]);
  const n = facing(unit(Math.hypot(...upright) > 0.2 ? upright : cross(contact.outward, [1, 0, 0])));
  look(n);
  cut({ name: 'contact', n, at: dot(n, contact.place) });
  draw();
}

// ---- the panel ----
function panel() {
  document.title = `${scene.part} in ${scene.blank}`;
  for (const id of ['part', 'blank', 'status', 'clearance']) el(id).textContent = scene[id];
  el('method').textContent = scene.method && `method ${scene.method}`;
  el('status').style.background = scene.statusColour;
  el('clearance').classList.toggle('bad', scene.sticksOut);
  if (scene.ticks.length) {
    el('scale').hidden = false;
    el('scale-title').textContent = scene.scaleTitle;
    const share = 100 / scene.palette.length;
    el('colours').style.background =
      `linear-gradient(90deg, ${scene.palette.map((c, k) => `${c} ${k * share}% ${(k + 1) * share}%`)})`;
    for (const [at, text] of scene.ticks) {
      const tick = el('ticks').appendChild(document.createElement('span'));
      tick.textContent = text;
      tick.style.left = `${clamp(100 * at, 3, 97)}%`;
    }
  }
  for (const [colour, text] of scene.key) {
    const row = el('key').appendChild(document.createElement('li'));
    row.appendChild(document.createElement('i')).style.background = colour;
    row.append(text);
  }
  for (const [what, value, bad] of scene.figures) {
    el('figures').appendChild(document.createElement('dt')).textContent = what;
    const figure = el('figures').appendChild(document.createElement('dd'));
    figure.textContent = value;
    figure.classList.toggle('bad', bad);
  }
  for (const note of scene.notes) el('notes').appendChild(document.createElement('p')).textContent = note;
  el('notes').hidden = !scene.notes.length;
  el('contacts-title').textContent = scene.contactsTitle;
  scene.contacts.forEach((contact, k) => {
    const row = el('contacts').appendChild(document.createElement('li'));
    const button = row.appendChild(document.createElement('button'));
    button.append(Object.assign(document.createElement('b'), { textContent: k + 1 }), contact.text);
    button.onclick = () => visit(k);
    const mark = el('marks').appendChild(document.createElement('button'));
    mark.textContent = k + 1;
    mark.tabIndex = -1;
    mark.setAttribute('aria-label', `contact ${k + 1}, ${contact.text}`);
    mark.onclick = () => visit(k);
  });
}
const views = {
  all: () => look(scene.towards),
  front: () => look([0, -1, 0]),
  right: () => look([1, 0, 0]),
  top: () => look([0, 0, 1]),
};
const planes = { off: null, x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
function controls() {
  for (const [name, go] of Object.entries(views)) {
    const button = el('views').appendChild(document.createElement('button'));
    button.textContent = name;
    button.onclick = () => (go(), whole(), draw());
  }
  el('planes').append('section');
  for (const [name, n] of Object.entries(planes)) {
    const button = el('planes').appendChild(document.createElement('button'));
    button.textContent = button.value = name;
    button.onclick = () => (cut(n && { name, n: facing(n) }), draw());
  }
  if (scene.contacts.length) {
    const button = el('planes').appendChild(document.createElement('button'));
    button.textContent = button.value = 'contact';
    button.onclick = () => visit(state.contact < 0 ? tightest : state.contact);
  }
  cut(null);
  for (const id of ['show-part', 'show-blank']) el(id).onchange = draw;
  el('cut-part').onchange = () => ((state.cutPart = el('cut-part').checked), draw());
  el('plane').oninput = () => {
    const { low, high } = state.section;
    state.at = low + (el('plane').value / 1000) * (high - low);
    draw();
  };
}

// ---- mouse, finger, keys ----
const millimetre = () => state.width / canvas.clientWidth;
function move(dx, dy) {
  const { right, up } = axes();
  state.centre = sum(sum(state.centre, right, -dx * millimetre()), up, dy * millimetre());
}
function turn(dx, dy) {
  state.yaw -= dx * 0.008;
  state.pitch = clamp(state.pitch + dy * 0.008, -Math.PI / 2, Math.PI / 2);
}
/** Zooms by a factor; the place at x, y of the canvas stays. */
function zoom(factor, x = canvas.clientWidth / 2, y = canvas.clientHeight / 2) {
  const before = state.width;
  state.width = clamp(state.width * factor, 1e-4 * size, 20 * size);
  const kept = 1 - before / state.width;
  move((x - canvas.clientWidth / 2) * kept, (y - canvas.clientHeight / 2) * kept);
}
function pointing() {
  const fingers = new Map();
  const spread = ([a, b]) => ({ x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.hypot(a.x - b.x, a.y - b.y) || 1 });
  const place = (event) => {
    const { left, top } = canvas.getBoundingClientRect();
    return { x: event.clientX - left, y: event.clientY - top };
  };
  const down = (event) => fingers.set(event.pointerId, { ...place(event), began: place(event) });
  const up = (event) => fingers.delete(event.pointerId);
  const drag = (event) => {
    const before = fingers.get(event.pointerId);
    if (!before || !event.buttons) return up(event);
    const two = fingers.size === 2 && spread([...fingers.values()]);
    const now = { ...place(event), began: before.began };
    fingers.set(event.pointerId, now);
    // A mark that is hardly moved over is chosen; a drag that begins on one is a drag.
    if (Math.hypot(now.x - now.began.x, now.y - now.began.y) > 4) canvas.setPointerCapture(event.pointerId);
    if (two) {
      const after = spread([...fingers.values()]);
      move(after.x - two.x, after.y - two.y);
      zoom(two.apart / after.apart, after.x, after.y);
    } else if (event.shiftKey || event.buttons > 1) move(now.x - before.x, now.y - before.y);
    else turn(now.x - before.x, now.y - before.y);
    draw();
  };
  const wheel = (event) => {
    event.preventDefault();
    const { x, y } = place(event);
    zoom(Math.exp(clamp(event.deltaY, -200, 200) * 0.0015), x, y);
    draw();
  };
  // The marks of contacts lie over the canvas and are in nobody's way.
  for (const over of [canvas, el('marks')]) {
    over.onpointerdown = down;
    over.onpointermove = drag;
    over.onpointerup = over.onpointercancel = up;
    over.addEventListener('wheel', wheel, { passive: false });
  }
  canvas.oncontextmenu = (event) => event.preventDefault();
}
function keys() {
  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  document.onkeydown = (event) => {
    const typing = event.target.matches('input');
    if (event.ctrlKey || event.metaKey || event.altKey || (typing && !/^[0-9bs[\]]$/i.test(event.key))) return;
    const arrow = arrows[event.key];
    if (arrow) (event.shiftKey ? move : turn)(...arrow.map((x) => 14 * x));
    else if (event.key === '+' || event.key === '=') zoom(0.8);
    else if (event.key === '-') zoom(1.25);
    else if (event.key === '0') whole();
    else if (/^[1-9]$/.test(event.key)) visit(event.key - 1);
    else if (/^b$/i.test(event.key)) el('show-blank').checked = !el('show-blank').checked;
    else if (/^s$/i.test(event.key)) cut(state.section ? null : { name: 'y', n: facing(planes.y) });
    else if (/^[[\]]$/.test(event.key) && state.section)
      slide(state.at + (event.key === ']' ? 0.01 : -0.01) * (state.section.high - state.section.low));
    else return;
    event.preventDefault();
    draw();
  };
}

// ---- drawing ----
const vertexShader = `#version 300 es
layout(location = 0) in vec3 place;
layout(location = 1) in vec4 surface; // normal and value
uniform vec3 right, up, towards, centre; // the centre in steps
uniform float step_;
uniform vec3 span; // half of what is seen: across, upwards, towards the viewer; mm
out vec3 normal, relative;
out float value;
void main() {
  relative = (place - centre) * step_;
  normal = surface.xyz;
  value = surface.w;
  gl_Position = vec4(dot(right, relative) / span.x, dot(up, relative) / span.y, -dot(towards, relative) / span.z, 1);
}`;
const fragmentShader = `#version 300 es
precision highp float;
in vec3 normal, relative;
in float value;
uniform vec3 right, up, towards, plane, colour, palette[64];
uniform float at; // of the plane, from the centre
uniform int kind; // 0 part in colours, 1 part in one, 2 glass, 3 glass that nobody measured, 4 lines, 5 a cut face, hatched or plain
uniform float opacity;
uniform bool cuts;
out vec4 result;
vec3 lit(vec3 base, vec3 n) {
  if (n.z < 0.0) n = -n;
  float light = 0.16 + 0.66 * max(0.0, dot(n, vec3(-0.42, 0.58, 0.698))) + 0.26 * max(0.0, dot(n, vec3(0.70, -0.30, 0.648)));
  vec3 bright = 0.055 + (0.58 + 0.50 * min(1.0, light)) * base;
  return min(vec3(1), bright + 0.16 * pow(max(0.0, dot(n, vec3(-0.228, 0.315, 0.921))), 32.0) * (1.0 - bright));
}
bool stripe(float width) { return mod(gl_FragCoord.x + gl_FragCoord.y, width) < width / 3.0; }
void main() {
  if (cuts && dot(plane, relative) > at) discard;
  vec3 n = normalize(vec3(dot(right, normal), dot(up, normal), dot(towards, normal)));
  if (kind <= 1) {
    vec3 base = colour;
    if (kind == 0) {
      base = palette[int(clamp(value * 64.0, 0.0, 63.0))];
      if (value < -0.99) base = colour; // as cast
      else if (value < -0.00004) base = stripe(12.0) ? vec3(0.55, 0.0, 0.07) : vec3(0.816, 0.0, 0.106);
    }
    result = vec4(lit(base, n), 1);
  } else if (kind == 5) result = vec4(opacity < 1.0 && stripe(11.0) ? colour * 0.8 : colour, 1);
  else {
    float kept = opacity;
    if (kind == 2) kept *= 0.10 + 0.34 * pow(1.0 - min(1.0, abs(n.z)), 3.0);
    if (kind == 3) kept *= stripe(14.0) ? 0.6 : 0.35;
    result = vec4(colour * kept, kept);
  }
}`;

const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
const rgb = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16) / 255);
let gl = null;
let program = null;
let place = null;
const bodies = {};

function start() {
  gl = canvas.getContext('webgl2', { antialias: true, stencil: true, premultipliedAlpha: true });
  if (!gl) {
    el('no-webgl').hidden = false;
    canvas.hidden = true;
    for (const id of ['views', 'bar', 'axes', 'marks', 'gap']) el(id).hidden = true;
    return;
  }
  program = gl.createProgram();
  for (const [kind, text] of [
    [gl.VERTEX_SHADER, vertexShader],
    [gl.FRAGMENT_SHADER, fragmentShader],
  ]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  gl.useProgram(program);
  const places = {};
  place = (name) => (places[name] ??= gl.getUniformLocation(program, name));
  gl.uniform3fv(place('palette'), scene.palette.flatMap(rgb));
  gl.uniform1f(place('step_'), scene.step);
  for (const name of ['partMesh', 'blankMesh']) bodies[name] = body(scene[name]);
}
function body(mesh) {
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  const buffer = (kind, text) => {
    gl.bindBuffer(kind, gl.createBuffer());
    const data = bytes(text);
    gl.bufferData(kind, data, gl.STATIC_DRAW);
    return data.byteLength;
  };
  buffer(gl.ARRAY_BUFFER, mesh.places);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 3, gl.UNSIGNED_SHORT, false, 0, 0);
  buffer(gl.ARRAY_BUFFER, mesh.surface);
  gl.enableVertexAttribArray(1);
  gl.vertexAttribPointer(1, 4, gl.SHORT, true, 0, 0);
  // The triangles, then the lines.
  const indices = buffer(gl.ELEMENT_ARRAY_BUFFER, mesh.indices) / 4;
  return { array, known: mesh.known, triangles: mesh.triangles, indices };
}

let waiting = false;
function draw() {
  if (!waiting) requestAnimationFrame(paint);
  waiting = true;
}
function paint() {
  waiting = false;
  if (!gl || gl.isContextLost()) return;
  const sharp = Math.min(2, window.devicePixelRatio || 1);
  const [w, h] = [Math.max(1, canvas.clientWidth), Math.max(1, canvas.clientHeight)];
  canvas.width = Math.round(w * sharp);
  canvas.height = Math.round(h * sharp);
  gl.viewport(0, 0, canvas.width, canvas.height);
  const style = getComputedStyle(document.documentElement);
  const css = (name) => rgb(style.getPropertyValue(`--${name}`).trim());
  const { right, up, towards } = axes();
  const span = [state.width / 2, (state.width * h) / w / 2, 1.5 * size];
  for (const [name, v] of Object.entries({ right, up, towards, span })) gl.uniform3fv(place(name), v);
  gl.uniform3fv(
    place('centre'),
    state.centre.map((x) => x / scene.step),
  );
  const plane = state.section?.n ?? [0, 0, 1];
  gl.uniform3fv(place('plane'), plane);
  gl.uniform1f(place('at'), state.at - dot(plane, state.centre));
  const set = (kind, colour, cuts, opacity = 1) => {
    gl.uniform1i(place('kind'), kind);
    gl.uniform3fv(place('colour'), colour);
    gl.uniform1i(place('cuts'), cuts ? 1 : 0);
    gl.uniform1f(place('opacity'), opacity);
  };
  const triangles = (mesh, from = 0, until = mesh.triangles) =>
    gl.drawElements(gl.TRIANGLES, 3 * (until - from), gl.UNSIGNED_INT, 12 * from);
  const lines = (mesh) =>
    gl.drawElements(gl.LINES, mesh.indices - 3 * mesh.triangles, gl.UNSIGNED_INT, 12 * mesh.triangles);
  const { partMesh: part, blankMesh: blank } = bodies;

  gl.clearColor(0, 0, 0, 0);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
  gl.enable(gl.DEPTH_TEST);
  gl.enable(gl.BLEND);
  gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  gl.depthMask(true);
  const cutPart = state.section && state.cutPart;
  const faced = state.section && dot(plane, towards) > 1e-3;
  if (faced && el('show-blank').checked)
    cap(
      blank,
      css('line').map((x) => 0.5 + 0.5 * x),
      set,
      triangles,
    );
  if (el('show-part').checked) {
    gl.bindVertexArray(part.array);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 1);
    set(scene.ticks.length ? 0 : 1, rgb(scene.plainPart), cutPart);
    triangles(part);
    gl.disable(gl.POLYGON_OFFSET_FILL);
    if (faced && cutPart) cap(part, [1, 0.91, 0.78], set, triangles);
    gl.bindVertexArray(part.array);
    set(4, [0.12, 0.14, 0.17], cutPart, 0.7);
    lines(part);
  }
  if (el('show-blank').checked) {
    gl.bindVertexArray(blank.array);
    gl.depthMask(false);
    // All panes have one colour, so their order does not matter.
    set(2, css('glass'), state.section);
    triangles(blank, 0, blank.known);
    set(3, rgb(scene.unknownColour), state.section);
    triangles(blank, blank.known);
    set(4, css('line'), state.section, 0.8);
    lines(blank);
  }
  over(w, h, { right, up, towards });
}
/** Closes a body where the plane cuts it. A ray from the viewer through the plane meets the surface behind it an odd
 * number of times where the plane is inside. */
function cap(mesh, colour, set, triangles) {
  gl.bindVertexArray(mesh.array);
  gl.enable(gl.STENCIL_TEST);
  gl.clear(gl.STENCIL_BUFFER_BIT);
  gl.colorMask(false, false, false, false);
  gl.depthMask(false);
  gl.disable(gl.DEPTH_TEST);
  gl.stencilFunc(gl.ALWAYS, 0, 1);
  gl.stencilOp(gl.KEEP, gl.KEEP, gl.INVERT);
  set(1, colour, true);
  triangles(mesh);
  gl.colorMask(true, true, true, true);
  gl.depthMask(true);
  gl.enable(gl.DEPTH_TEST);
  gl.stencilFunc(gl.EQUAL, 1, 1);
  gl.stencilOp(gl.KEEP, gl.KEEP, gl.KEEP);
  const ofPart = mesh === bodies.partMesh;
  set(5, colour, false, ofPart ? 1 : 0);
  // The plane itself, far beyond what is seen; of the part it lies before that of the blank.
  const { n } = state.section;
  const u = unit(cross(n, Math.abs(n[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]));
  const v = cross(n, u);
  const nearer = ofPart ? 1e-5 * size : 0;
  const foot = sum(state.centre, n, state.at + nearer - dot(n, state.centre));
  const corners = [
    [-1, -1],
    [1, -1],
    [-1, 1],
    [1, 1],
  ].flatMap(([a, b]) => sum(sum(foot, u, 4 * a * size), v, 4 * b * size).map((x) => x / scene.step));
  bodies.plane ??= { array: gl.createVertexArray(), buffer: gl.createBuffer() };
  gl.bindVertexArray(bodies.plane.array);
  gl.bindBuffer(gl.ARRAY_BUFFER, bodies.plane.buffer);
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(corners), gl.DYNAMIC_DRAW);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
  gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
  gl.disable(gl.STENCIL_TEST);
}
/** Marks, scale bar and axes over the picture. */
function over(w, h, { right, up, towards }) {
  const across = w / state.width;
  const marks = [...el('marks').children];
  scene.contacts.forEach((contact, k) => {
    const d = sum(contact.place, state.centre, -1);
    const [x, y] = [w / 2 + across * dot(right, d), h / 2 - across * dot(up, d)];
    const mark = marks[k];
    mark.hidden = x < 0 || y < 0 || x > w || y > h;
    mark.style.transform = `translate(${x - 12}px, ${y - 12}px)`;
    mark.classList.toggle('behind', dot(contact.outward, towards) < 0);
    mark.toggleAttribute('aria-current', k === state.contact);
    el('contacts').children[k].firstChild.setAttribute('aria-pressed', k === state.contact);
  });
  const chosen = scene.contacts[state.contact];
  el('gap').hidden = !chosen;
  if (chosen) {
    const d = sum(chosen.place, state.centre, -1);
    const [x, y] = [chosen.distance * dot(right, chosen.outward), -chosen.distance * dot(up, chosen.outward)];
    el('gap').style.width = `${across * Math.hypot(x, y)}px`;
    el('gap').style.transform =
      `translate(${w / 2 + across * dot(right, d)}px, ${h / 2 - across * dot(up, d)}px) rotate(${Math.atan2(y, x)}rad)`;
  }
  const most = (0.3 * w) / across;
  const power = 10 ** Math.floor(Math.log10(most));
  const length = power * (most >= 5 * power ? 5 : most >= 2 * power ? 2 : 1);
  el('bar').style.width = `${length * across}px`;
  el('bar').firstElementChild.textContent = `${Number(length.toPrecision(1))} mm`;
  el('axes').replaceChildren();
  ['x', 'y', 'z'].forEach((name, k) => {
    const [x, y] = [34 * right[k], -34 * up[k]];
    const line = el('axes').appendChild(document.createElement('i'));
    line.style.width = `${Math.hypot(x, y)}px`;
    line.style.transform = `rotate(${Math.atan2(y, x)}rad)`;
    const letter = el('axes').appendChild(document.createElement('b'));
    letter.textContent = name;
    letter.style.left = `${1.25 * x}px`;
    letter.style.top = `${1.25 * y}px`;
    letter.hidden = Math.hypot(x, y) < 3;
  });
}

panel();
controls();
pointing();
keys();
start();
look(scene.towards);
whole();
new ResizeObserver(draw).observe(canvas);
matchMedia('(prefers-color-scheme: dark)').onchange = draw;
canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
canvas.addEventListener('webglcontextrestored', () => (delete bodies.plane, start(), draw()));
draw();
