// Puts the page together.

import { DARK, LIGHT, Picture, type Scene } from './draw';
import type { Violation } from './document';
import { Editor, movedBy, type Tool } from './editor';
import { h } from './elements';
import { icon } from './icons';
import { currentLanguage, setLanguage, t, type Key, type Language } from './i18n';
import { showSidePanel, type Side } from './sides';
import { Client, type Wire } from './socket';
import { ServerKernel } from './server_kernel';
import { act, type Action } from './tools/actions';
import { key, SHORTCUTS } from './tools/keys';
import { PointerTool } from './tools/pointer';
import { tray } from './panels/tray';
import { View } from './view';
import { loadWasmKernel } from './wasm_kernel';

const stored = (name: string): string | null => {
  try {
    return localStorage.getItem(name);
  } catch {
    return null;
  }
};
const store = (name: string, value: string): void => {
  try {
    localStorage.setItem(name, value);
  } catch {
    // Private windows may refuse; then the choice holds for this visit alone.
  }
};

const editor: Editor = new Editor(new ServerKernel(() => editor.client));
const view = new View();
const page = document.getElementById('page')!;
let theme = stored('theme') === 'dark' || (!stored('theme') && matchMedia('(prefers-color-scheme: dark)').matches) ? DARK : LIGHT;
let side: Side = 'violations';
let fitted = false;
setLanguage((stored('language') ?? (navigator.language.startsWith('uk') ? 'uk' : 'en')) as Language);

const base = h('canvas', { 'aria-hidden': 'true' });
const top = h('canvas', { 'aria-hidden': 'true' });
const legend = h('div', { class: 'legend' });
const picture = h('main', { class: 'picture', tabindex: 0, role: 'application' }, base, top, legend);
const bar = h('header', { class: 'bar' });
const left = h('aside', { class: 'left' });
const right = h('aside', { class: 'right' });
const status = h('footer', { class: 'status' });
const live = h('span', { class: 'live', role: 'status', 'aria-live': 'polite' });
const message = h('span', { class: 'message', role: 'alert' });
const where = h('span');
const state = h('span', { role: 'status' });
status.append(where, live, message, state);
page.append(bar, left, picture, right, status);
const drawing = new Picture(base, top);
const pointer = new PointerTool(picture, editor, view, (all) => later(all));

let due: 'none' | 'top' | 'all' = 'none';
function later(all: boolean): void {
  if (due === 'none') requestAnimationFrame(frame);
  if (all || due === 'none') due = all ? 'all' : 'top';
}
function scene(): Scene {
  return {
    model: editor.model, view, theme, selection: editor.selection, others: new Set([...editor.others.values()].flat()),
    violations: editor.violations ?? [], moving: editor.moving, live: editor.live, ...pointer.overlay, show: editor.show,
  };
}
function frame(): void {
  const all = due === 'all';
  due = 'none';
  const shown = scene();
  if (all) drawing.drawBase(shown);
  drawing.drawTop(shown);
}

function button(label: Key, run: () => void, pressed?: boolean): HTMLButtonElement {
  return h('button', { class: 'icon', title: t(label), 'aria-label': t(label), 'aria-pressed': pressed === undefined ? undefined : String(pressed), 'data-action': label, click: run }, icon(label));
}
const action = (name: Action): HTMLButtonElement => button(name, () => void act(editor, name));
const tool = (name: Tool): HTMLButtonElement => button(`tool.${name}` as Key, () => editor.setTool(name), editor.tool === name);
const space = (): HTMLElement => h('span', { class: 'gap' });

function showBar(): void {
  const layouts = h('select', { 'aria-label': t('open'), change: (e) => void openLayout(Number((e.target as HTMLSelectElement).value)) });
  for (const l of known) layouts.append(h('option', { value: l.id, selected: l.id === editor.layoutId }, l.name || String(l.id)));
  const file = h('input', { type: 'file', multiple: true, hidden: true, 'aria-label': t('open.file'), change: (e) => void takeFiles((e.target as HTMLInputElement).files) });
  const forms = h('select', { 'aria-label': t('export'), change: (e) => {
    const select = e.target as HTMLSelectElement;
    if (select.value) location.assign(`/api/layouts/${editor.layoutId}/export?form=${select.value}`);
    select.value = '';
  } }, h('option', { value: '' }, t('export')), ...['layout', 'placements', 'svg', 'pdf', 'png', 'dxf', 'hpgl', 'gcode'].map((f) => h('option', { value: f }, f.toUpperCase())));
  const step = h('input', { type: 'number', value: editor.rotateStep, min: 0.1, max: 180, step: 'any', 'aria-label': t('step'), title: t('step'), style: 'width: 62px', change: (e) => {
    const value = Number((e.target as HTMLInputElement).value);
    if (value > 0 && value <= 180) editor.rotateStep = value;
  } });
  bar.replaceChildren(
    h('span', { class: 'brand' }, 'lekalo'), layouts, button('open.file', () => file.click()), file, button('copy.layout', () => void copyLayout()),
    space(), h('span', { class: 'segment', role: 'group', title: t('mode.hint') }, ...(['strict', 'free'] as const).map((m) =>
      h('button', { 'aria-pressed': String(editor.mode === m), 'data-action': `mode.${m}`, click: () => editor.setMode(m) }, t(m)))),
    space(), action('undo'), action('redo'),
    space(), tool('select'), tool('slide'), tool('push'), tool('nearest'), tool('measure'), tool('pan'),
    space(), action('rotate.left'), step, action('rotate.right'), action('flip'),
    space(), action('slide.left'), action('slide.right'), action('slide.up'), action('slide.down'), action('settle'), action('snap'), action('compact'),
    space(), action('lock'), action('swap'), action('copy'), action('remove'),
    space(), button('fit', fitAll), ...(['labels', 'grain', 'gap', 'zones'] as const).map((k) => h('button', { 'aria-pressed': String(editor.show[k]), click: () => {
      editor.show[k] = !editor.show[k];
      editor.tell('show');
    } }, t(k))),
    h('span', { class: 'push' }), forms, button('print', () => window.print()),
    button('theme', () => {
      theme = theme === DARK ? LIGHT : DARK;
      store('theme', theme === DARK ? 'dark' : 'light');
      showAll();
    }),
    h('button', { 'aria-label': t('language'), click: () => {
      setLanguage(currentLanguage() === 'en' ? 'uk' : 'en');
      store('language', currentLanguage());
      showAll();
    } }, currentLanguage() === 'en' ? 'УКР' : 'ENG'), button('help', showHelp));
}
function showTray(): void {
  left.replaceChildren(h('h2', {}, t('tray')), tray(editor, (part) => drawing.colour(part, theme)));
}
function showSide(): void {
  const held = right.querySelector('input')?.value ?? '';
  showSidePanel(right, editor, side, held, {
    choose: (to) => {
      side = to;
      showSide();
    },
    violation: reveal, part: (id) => {
      editor.select([id]);
      revealPart(id);
    },
    sheet: (sheet) => {
      view.fit({ left: sheet.box.left + sheet.x, right: sheet.box.right + sheet.x, bottom: sheet.box.bottom + sheet.y, top: sheet.box.top + sheet.y });
      later(true);
    },
  });
}
function showStatus(): void {
  const now = editor.live;
  const depth = now?.violations.reduce((most, v) => Math.max(most, v.amount_mm), 0) ?? 0;
  live.className = `live ${now?.level ?? ''}`;
  live.textContent = now
    ? [t(`live.${now.level}`), depth > 0 ? t('live.depth', { mm: depth.toFixed(3) }) : '', now.nearest ? t('live.nearest', { mm: now.nearest.distance.toFixed(3) }) : ''].filter(Boolean).join(' · ')
    : editor.selection.size > 0 ? t('selected', { n: editor.selection.size }) : t('nothing');
  message.textContent = message.title = editor.message;
  const others = [...editor.others.keys()].filter((c) => c >= 0).length;
  state.textContent = [others > 0 ? t('others', { n: others }) : '', t(editor.pending > 0 ? 'state.saving' : `state.${editor.connection}`)].filter(Boolean).join(' · ');
}
function showAll(): void {
  document.documentElement.dataset.theme = theme === DARK ? 'dark' : 'light';
  picture.setAttribute('aria-label', t('canvas'));
  picture.dataset.drop = t('drop');
  legend.replaceChildren(...(['zone', 'defect', 'bad', 'near'] as const).map((k) => h('span', { class: k }, h('i'), t(`legend.${k}`))));
  showBar();
  later(true);
  requestAnimationFrame(() => {
    showTray();
    showSide();
  });
  showStatus();
}
function showHelp(): void {
  const dialog = h('dialog', { 'aria-label': t('help') }, h('h2', {}, t('help')),
    h('dl', {}, ...SHORTCUTS.flatMap(([keys, what]) => [h('dt', {}, keys), h('dd', {}, t(what as Key))])),
    h('form', { method: 'dialog' }, h('button', {}, t('close'))));
  dialog.addEventListener('close', () => dialog.remove());
  page.append(dialog);
  dialog.showModal();
}

function fitAll(): void {
  view.fit(editor.model.extent());
  later(true);
}
function reveal(v: Violation): void {
  const sheet = editor.model.sheet(v.stock, v.copy);
  if (!sheet) return;
  editor.select(v.b === null ? [v.a] : [v.a, v.b]);
  const [x, y] = [v.at[0] + sheet.x, v.at[1] + sheet.y];
  const r = Math.max(60, v.amount_mm * 4);
  view.fit({ left: x - r, right: x + r, bottom: y - r, top: y + r });
  later(true);
}
function revealPart(id: number): void {
  const p = editor.model.placements.get(id);
  const sheet = p && editor.model.sheet(p.stock, p.copy);
  if (!p || !sheet) return;
  const b = editor.model.box(p);
  const seen = view.visible();
  const [x, y] = [(b.left + b.right) / 2 + sheet.x, (b.bottom + b.top) / 2 + sheet.y];
  if (x < seen.left || x > seen.right || y < seen.bottom || y > seen.top) {
    const [sx, sy] = view.toScreen(x, y);
    view.pan(view.width / 2 - sx, view.height / 2 - sy);
    later(true);
  }
}

interface Known { id: number; name: string }
let known: Known[] = [];
async function api<T>(path: string, init?: RequestInit): Promise<T | null> {
  try {
    const answer = await fetch(path, init);
    const body = (await answer.json()) as T & { error?: string };
    if (answer.ok) return body;
    editor.say(body.error ?? `${answer.status}`);
  } catch (error) {
    editor.say(error instanceof Error ? error.message : String(error));
  }
  return null;
}
async function readLayouts(): Promise<void> {
  known = (await api<{ layouts: Known[] }>('/api/layouts'))?.layouts ?? known;
  showBar();
}
async function takeFiles(files: FileList | null): Promise<void> {
  for (const file of files ?? []) {
    const made = await api<{ id: number; notices: string[] }>(`/api/layouts?name=${encodeURIComponent(file.name)}`, { method: 'POST', body: file });
    if (!made) continue;
    await readLayouts();
    openLayout(made.id);
    if (made.notices.length > 0) editor.say(made.notices.join(' · '));
  }
}
async function copyLayout(): Promise<void> {
  const made = await api<{ id: number }>(`/api/layouts/${editor.layoutId}/copy?name=${encodeURIComponent(`${editor.name} 2`)}`, { method: 'POST' });
  if (!made) return;
  await readLayouts();
  openLayout(made.id);
}
function openLayout(id: number): void {
  editor.client?.stop();
  editor.layoutId = id;
  editor.selection.clear();
  editor.others.clear();
  fitted = false;
  const here = new URL(location.href);
  here.searchParams.set('layout', String(id));
  here.searchParams.delete('token'); // a cookie holds it now, the address bar need not
  history.replaceState(null, '', here);
  const url = new URL(`/ws?layout=${id}`, location.href);
  url.protocol = url.protocol === 'https:' ? 'wss:' : 'ws:';
  editor.client = new Client(() => new WebSocket(url, 'lekalo.1') as unknown as Wire, {
    layout: (m) => editor.open(m.document, m.name),
    change: (m) => editor.apply(m.placements, m.next_id),
    selections: (clients) => {
      editor.others = new Map(clients.map((c) => [c.client, c.ids]));
      editor.tell('selection');
    },
    error: (text) => editor.say(text),
    connection: (to) => {
      editor.connection = to;
      editor.tell('connection');
    },
  });
  editor.client.start();
}

let panelsDue = false;
editor.on((topic) => {
  if (topic === 'layout') drawing.take(editor.model);
  if (topic === 'layout' && !fitted) {
    fitted = true;
    view.fit(editor.model.extent());
  }
  const wasMoving = picture.dataset.moving === 'true';
  const isMoving = editor.moving.size > 0;
  picture.dataset.moving = String(isMoving);
  picture.dataset.level = editor.live?.level ?? '';
  if (topic !== 'message' && topic !== 'connection') later(topic !== 'moving' || wasMoving !== isMoving);
  if (topic === 'mode' || topic === 'show') showBar();
  if ((topic === 'layout' || topic === 'selection') && !panelsDue) {
    panelsDue = true;
    setTimeout(() => {
      panelsDue = false;
      if (topic === 'layout') showTray();
      showSide();
    });
  }
  showStatus();
});

new ResizeObserver(() => {
  drawing.resize(view, picture.clientWidth, picture.clientHeight);
  if (editor.model.sheets.length > 0) later(true);
}).observe(picture);
picture.addEventListener('pointermove', (e) => {
  const box = picture.getBoundingClientRect();
  const [x, y] = view.toWorld(e.clientX - box.left, e.clientY - box.top);
  const sheet = editor.model.sheetAt(x, y);
  where.textContent = `${(x - (sheet?.x ?? 0)).toFixed(2)}  ${(y - (sheet?.y ?? 0)).toFixed(2)} mm`;
});
picture.addEventListener('keydown', (e) => {
  if (e.code === 'Space') pointer.spaceDown = true;
  const mine = key(e, editor, {
    fit: fitAll, help: showHelp, cancel: () => pointer.cancel(), reveal: revealPart,
    zoom: (factor) => {
      view.zoomAt(view.width / 2, view.height / 2, factor);
      later(true);
    },
    find: () => {
      side = 'parts';
      showSide();
      right.querySelector('input')?.focus();
    },
  });
  if (mine || e.code === 'Space') e.preventDefault();
});
picture.addEventListener('keyup', (e) => {
  if (e.code === 'Space') pointer.spaceDown = false;
});
for (const [type, on] of [['dragover', true], ['dragleave', false], ['drop', false]] as const) {
  document.addEventListener(type, (e) => {
    e.preventDefault();
    picture.classList.toggle('dropping', on);
    if (type === 'drop') void takeFiles((e as DragEvent).dataTransfer?.files ?? null);
  });
}
window.addEventListener('beforeprint', () => {
  const kept = theme;
  theme = LIGHT;
  drawing.resize(view, picture.clientWidth, picture.clientHeight);
  view.fit(editor.model.extent());
  drawing.drawBase(scene());
  theme = kept;
});
window.addEventListener('afterprint', () => later(true));

/// Times `work` for the benchmark, ms.
function timed(n: number, work: (i: number) => void): { median: number; p99: number; worst: number } {
  const times = Array.from({ length: n }, (_, i) => {
    const begin = performance.now();
    work(i);
    return performance.now() - begin;
  }).sort((a, b) => a - b);
  return { median: times[n >> 1]!, p99: times[Math.min(n - 1, Math.floor(n * 0.99))]!, worst: times[n - 1]! };
}
Object.assign(window, { lekaloBench: {
  /// Full frames at the present view; reading a pixel waits until all of it is painted.
  frames: (n: number) => timed(n, () => {
    drawing.drawBase(scene());
    base.getContext('2d')!.getImageData(0, 0, 1, 1);
  }),
  /// The check of the whole layout, after each change.
  check: (n: number) => timed(n, () => void editor.kernel.check()),
  /// The check of one part in hand at n places across the sheet, and the drawing of it.
  drag: (n: number) => {
    const p = editor.placementsOf([...editor.model.placements.keys()].slice(0, 1));
    const made = { check: timed(n, (i) => editor.hold(movedBy(p, (i * 37) % 900, (i * 53) % 700), '')),
      frame: timed(n, (i) => {
        editor.moving = new Map(movedBy(p, i, i).map((q) => [q.id, q]));
        drawing.drawTop(scene());
        top.getContext('2d')!.getImageData(0, 0, 1, 1);
      }) };
    editor.release();
    return made;
  },
} });

showAll();
void (async () => {
  try {
    editor.kernel = (await loadWasmKernel()) ?? editor.kernel;
  } catch (error) {
    editor.say(error instanceof Error ? error.message : String(error));
  }
  await readLayouts();
  const wanted = Number(new URL(location.href).searchParams.get('layout'));
  const first = known.find((l) => l.id === wanted) ?? known[0];
  if (first) openLayout(first.id);
  else editor.say(t('none.layouts'));
})();
