'use strict';
// Plays the temperatures of a workpiece: each moment is a picture from above and one from the front, with one byte for
// a place: 0 for no material, else 1 to 255 from the surroundings to the warmest of all. Lengths are millimetres.

const scene = JSON.parse(document.getElementById('scene').textContent);
const el = (id) => document.getElementById(id);
const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
const clamp = (x, low, high) => Math.min(high, Math.max(low, x));

const [nx, ny, nz] = scene.count;
const above = bytes(scene.above);
const front = bytes(scene.front);
const [x0, y0, z0, x1, y1, z1] = scene.stock;
const path = scene.path;
const places = path.length / 4;
const palette = scene.palette.map((hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16)));

// ---- where things are drawn ----
const WIDTH = 1200;
const MARGIN = 16;
const GAP = 34;
const LIFT = 12;
/** Both views have one scale, and the tool has room over the front one. */
const rise = Math.max(z1 - z0, ...path.filter((_, k) => k % 4 === 3).map((z) => Math.min(z, z1 + LIFT) - z0));
const scale = Math.min((WIDTH - 2 * MARGIN) / (x1 - x0), 640 / (y1 - y0 + rise));
const left = (WIDTH - scale * (x1 - x0)) / 2;
const view = el('view');
view.width = WIDTH;
view.height = Math.ceil(2 * MARGIN + GAP + scale * (y1 - y0 + rise));
const X = (x) => left + scale * (x - x0);
const Y = (y) => MARGIN + scale * (y1 - y);
const Z = (z) => view.height - MARGIN - scale * (z - z0);
const graph = el('graph');
graph.width = WIDTH;
graph.height = 120;

/** The picture of a moment: a canvas of one pixel for each place. */
function picture(all, rows, moment) {
  const canvas = document.createElement('canvas');
  canvas.width = nx;
  canvas.height = rows;
  const context = canvas.getContext('2d');
  const image = context.createImageData(nx, rows);
  for (let row = 0; row < rows; row++)
    for (let i = 0; i < nx; i++) {
      const value = all[(moment * rows + (rows - 1 - row)) * nx + i];
      if (value === 0) continue;
      const colour = palette[Math.round(((value - 1) / 254) * (palette.length - 1))];
      image.data.set([...colour, 255], 4 * (row * nx + i));
    }
  context.putImageData(image, 0, 0);
  return canvas;
}
const pictures = new Map();
function picturesOf(moment) {
  if (!pictures.has(moment)) pictures.set(moment, [picture(above, ny, moment), picture(front, nz, moment)]);
  return pictures.get(moment);
}

/** The first number of a rising list that is not below `wanted`. */
function firstFrom(count, at, wanted) {
  let low = 0;
  let high = count - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (at(middle) < wanted) low = middle + 1;
    else high = middle;
  }
  return low;
}
function nearestMoment(seconds) {
  const next = firstFrom(scene.times.length, (i) => scene.times[i], seconds);
  return next > 0 && seconds - scene.times[next - 1] < scene.times[next] - seconds ? next - 1 : next;
}
function toolAt(seconds) {
  const k = firstFrom(places, (i) => path[4 * i], seconds);
  const before = Math.max(0, k - 1);
  const span = path[4 * k] - path[4 * before];
  const part = span > 0 ? clamp((seconds - path[4 * before]) / span, 0, 1) : 1;
  return [1, 2, 3].map((n) => path[4 * before + n] + part * (path[4 * k + n] - path[4 * before + n]));
}

function outline(context, rings) {
  context.beginPath();
  for (const ring of rings) {
    ring.forEach(([x, y], i) => (i ? context.lineTo(X(x), Y(y)) : context.moveTo(X(x), Y(y))));
    context.closePath();
  }
  context.stroke();
}

let seconds = 0;
function draw() {
  const context = view.getContext('2d');
  const moment = nearestMoment(seconds);
  const [top, side] = picturesOf(moment);
  context.clearRect(0, 0, view.width, view.height);
  context.imageSmoothingEnabled = false;
  const [w, d, h] = scene.size.map((length) => length * scale);
  context.save();
  context.beginPath();
  context.rect(X(x0), Y(y1), X(x1) - X(x0), Y(y0) - Y(y1));
  context.rect(X(x0), Z(z1), X(x1) - X(x0), Z(z0) - Z(z1));
  context.clip();
  context.drawImage(top, X(x0), Y(y0) - d, w, d);
  context.drawImage(side, X(x0), Z(z0) - h, w, h);
  context.restore();
  context.lineWidth = 1;
  context.strokeStyle = '#6e7a88';
  context.strokeRect(X(x0), Y(y1), X(x1) - X(x0), Y(y0) - Y(y1));
  context.strokeRect(X(x0), Z(z1), X(x1) - X(x0), Z(z0) - Z(z1));
  outline(context, scene.outline);
  context.strokeStyle = '#ffffff';
  outline(context, scene.pockets);
  const [x, y, z] = toolAt(seconds);
  context.strokeStyle = '#1f242b';
  context.fillStyle = '#ffffff99';
  context.lineWidth = 2;
  context.beginPath();
  context.arc(X(x), Y(y), scene.radius * scale, 0, 7);
  context.fill();
  context.stroke();
  const tip = Z(Math.min(z, z0 + rise));
  const end = view.height - MARGIN - scale * rise - LIFT;
  context.beginPath();
  context.rect(X(x - scene.radius), end, 2 * scene.radius * scale, Math.max(2, tip - end));
  context.fill();
  context.stroke();
  context.fillStyle = '#5d6671';
  context.font = '13px system-ui, sans-serif';
  context.fillText('from above', MARGIN, Y(y0) + 15);
  context.fillText('from the front', MARGIN, view.height - 4);
  drawGraph(moment);
  el('now').textContent =
    `${seconds.toFixed(1)} of ${scene.seconds.toFixed(1)} s, ${scene.warmest[moment].toFixed(1)} °C`;
  el('at').value = (1000 * seconds) / scene.seconds;
}

function drawGraph(moment) {
  const context = graph.getContext('2d');
  const px = (t) => (WIDTH * t) / scene.seconds;
  const py = (c) => graph.height - 6 - ((graph.height - 24) * (c - scene.low)) / (scene.high - scene.low);
  context.clearRect(0, 0, WIDTH, graph.height);
  context.fillStyle = '#5d6671';
  context.font = '13px system-ui, sans-serif';
  context.fillText('warmest place, °C', 6, 14);
  context.strokeStyle = '#1d5fa8';
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(0, py(scene.low));
  scene.times.forEach((t, k) => context.lineTo(px(t), py(scene.warmest[k])));
  context.stroke();
  context.fillStyle = '#c00019';
  context.fillRect(px(seconds) - 1, 0, 2, graph.height);
  context.beginPath();
  context.arc(px(scene.times[moment]), py(scene.warmest[moment]), 3, 0, 7);
  context.fill();
}

// ---- controls ----
const SPEEDS = [1, 2, 5, 10, 20, 50, 100];
let playing = false;
let last = 0;
function go(to) {
  seconds = clamp(to, 0, scene.seconds);
  draw();
}
function play(on) {
  playing = on;
  el('play').textContent = on ? 'Pause' : 'Play';
  if (on && seconds >= scene.seconds) seconds = 0;
  last = performance.now();
  if (on) requestAnimationFrame(tick);
}
function tick(now) {
  if (!playing) return;
  go(seconds + (SPEEDS[el('speed').value] * Math.min(100, now - last)) / 1000);
  last = now;
  if (seconds >= scene.seconds) play(false);
  else requestAnimationFrame(tick);
}
const tellSpeed = () => (el('times').textContent = `${SPEEDS[el('speed').value]} times`);
el('play').onclick = () => play(!playing);
el('at').oninput = () => go((el('at').value / 1000) * scene.seconds);
el('speed').oninput = tellSpeed;
addEventListener('keydown', (event) => {
  if (event.target.tagName === 'INPUT' || event.target.tagName === 'BUTTON') return;
  const step = { ArrowLeft: -0.01, ArrowRight: 0.01 }[event.key];
  if (step) go(seconds + step * scene.seconds);
  else if (event.key === ' ') play(!playing);
  else return;
  event.preventDefault();
});

el('name').textContent = `Heat of ${scene.name}`;
el('about').textContent = `Warmest at any time: ${scene.most}; ${scene.title}.`;
el('low').textContent = `${scene.low.toFixed(1)} °C`;
el('high').textContent = `${scene.high.toFixed(1)} °C`;
el('colours').style.background = `linear-gradient(to right, ${scene.palette.join(', ')})`;
tellSpeed();
// A page may be opened at a moment: #t=12.5
const asked = /^#t=([0-9.]+)$/.exec(location.hash);
go(asked ? Number(asked[1]) : scene.seconds / 2);
