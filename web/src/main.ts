// Puts the page together.

import { DARK, LIGHT, measured, Picture, type Scene } from './picture/draw';
import type { Violation } from './layout/document';
import { showBar as showTools } from './page/bar';
import { benchmark, paintAll, printFigures, ROWS } from './page/benchmark';
import { Editor } from './editor/editor';
import { h } from './html/elements';
import type { ChosenForm, Values } from './dialogs/export_choices';
import { exportDialog, type Saved } from './dialogs/export_dialog';
import { currentLanguage, setLanguage, t, type Key, type Language } from './i18n';
import { printed } from './picture/print';
import { showSidePanel, type Side } from './panels/sides';
import { Client, type Wire } from './server/socket';
import { ServerKernel } from './server/server_kernel';
import { key, SHORTCUTS } from './tools/keys';
import { layoutDialog } from './dialogs/layout_dialog';
import { LongBar } from './page/long_bar';
import { Mirror, mirrorId } from './picture/mirror';
import { dragFromTray } from './tools/from_tray';
import { photoBeneath } from './tools/features';
import { PointerTool, turningHandle } from './tools/pointer';
import { sheetDialog, type SheetSize } from './dialogs/sheet_dialog';
import { tray } from './panels/tray';
import { sentenceOf } from './work/transfer';
import { View } from './picture/view';
import { loadWasmKernel } from './kernel/wasm_kernel';

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

/// Whose undo it is: of this tab, across reloads.
const author = ((): string => {
  const fresh = `tab-${crypto.getRandomValues(new Uint32Array(1))[0]!.toString(36)}`;
  try {
    const kept = sessionStorage.getItem('author') ?? fresh;
    sessionStorage.setItem('author', kept);
    return kept;
  } catch {
    return fresh;
  }
})();

const editor: Editor = new Editor(new ServerKernel(() => editor.client));
const view = new View();
const page = document.getElementById('page')!;
let theme =
  stored('theme') === 'dark' || (!stored('theme') && matchMedia('(prefers-color-scheme: dark)').matches) ? DARK : LIGHT;
let side: Side = 'violations';
let fitted = false;
setLanguage((stored('language') ?? (navigator.language.startsWith('uk') ? 'uk' : 'en')) as Language);

const base = h('canvas', { 'aria-hidden': 'true' });
const top = h('canvas', { 'aria-hidden': 'true' });
const mirror = new Mirror();
const legend = h('div', { class: 'legend' });
const longBar = new LongBar(editor, () => picture.focus());
const picture = h('main', { class: 'picture', tabindex: 0, role: 'application' }, base, top, mirror.element, legend);
const bar = h('header', { class: 'bar' });
const tools = h('nav', { class: 'tools' });
const left = h('aside', { class: 'left' });
const right = h('aside', { class: 'right' });
const status = h('footer', { class: 'status' });
const live = h('span', { class: 'live', role: 'status', 'aria-live': 'polite' });
const message = h('span', { class: 'message', role: 'alert' });
const where = h('span');
const state = h('span', { role: 'status' });
status.append(where, live, message, state);
page.append(bar, left, tools, picture, longBar.element, right, status);
const drawing = new Picture(base, top);
const pointer = new PointerTool(picture, editor, view, later);

/// What the next frame has to do; each does what those before it do.
const DUTIES = ['none', 'top', 'view', 'all'] as const;
type Duty = (typeof DUTIES)[number];
let due: Duty = 'none';
function later(duty: Duty): void {
  if (due === 'none') requestAnimationFrame(frame);
  if (DUTIES.indexOf(duty) > DUTIES.indexOf(due)) due = duty;
  if (duty !== 'top') picture.dataset.mirror = 'false';
}
function scene(): Scene {
  return {
    model: editor.model,
    view,
    theme,
    selection: editor.selection,
    others: new Set([...editor.others.values()].flat()),
    violations: editor.violations ?? [],
    moving: editor.moving,
    coming: editor.coming(),
    live: editor.live,
    ...pointer.overlay,
    photos: editor.photos,
    pins: pinsShown(),
    show: editor.show,
    handle: editor.moving.size === 0 ? turningHandle(editor, view) : null,
  };
}
/// Of the photographs, while they are pulled.
function pinsShown(): [number, number][] {
  if (editor.tool !== 'photo') return [];
  return editor.model.sheets.flatMap((sheet): [number, number][] => {
    const pinned = editor.photos.get(sheet.stock.id)?.pinned;
    return pinned ? [[pinned[0] + sheet.x, pinned[1] + sheet.y]] : [];
  });
}
function frame(): void {
  const duty = due;
  due = 'none';
  const shown = scene();
  // A photograph in hand is followed at every step, whatever that costs.
  const pulled = [...editor.photos].some((photo) => photo.pulled);
  if (duty === 'all' && !drawing.backdrop.draw(shown, pulled ? Infinity : SLICE_MS)) sharpenLater(0);
  if (duty === 'view' && !drawing.backdrop.follow(shown, SLICE_MS)) sharpenLater();
  if (duty !== 'top') {
    mirror.place(view);
    mirrorLater();
  }
  drawing.drawTop(shown);
  if (duty === 'top' && editor.tool === 'measure') showStatus();
  markFirstView();
}
function markFirstView(): void {
  if (fitted && drawing.backdrop.isWhole && performance.getEntriesByName('first view').length === 0) {
    performance.mark('first view');
    if (new URL(location.href).searchParams.has('benchmark')) void printFigures(bench);
  }
}
/// What is old or stretched is painted as it should be, slice by slice, without holding up what comes next; while
/// the hand zooms, not before it rests.
const SLICE_MS = 6;
let sharpenDue: ReturnType<typeof setTimeout> | null = null;
let slicing = false;
function sharpenLater(wait = 70): void {
  if (sharpenDue) clearTimeout(sharpenDue);
  picture.dataset.sharp = 'false';
  const slice = (): void => {
    slicing = false;
    if (!drawing.backdrop.sharpen(scene(), SLICE_MS)) return next();
    picture.dataset.sharp = 'true';
    markFirstView();
  };
  const next = (): void => {
    sharpenDue = null;
    if (!slicing) requestAnimationFrame(slice);
    slicing = true;
  };
  if (wait > 0) sharpenDue = setTimeout(next, wait);
  else next();
}

/// When the hand rests: nobody listens while the picture moves.
let mirrorDue: ReturnType<typeof setTimeout> | null = null;
function mirrorLater(): void {
  if (mirrorDue) clearTimeout(mirrorDue);
  mirrorDue = setTimeout(() => {
    mirrorDue = null;
    mirror.update(
      editor.model,
      view,
      editor.selection,
      editor.violations,
      editor.violations !== null && editor.checking.left === 0,
    );
    const first = editor.chosen()[0];
    if (first === undefined) picture.removeAttribute('aria-activedescendant');
    else picture.setAttribute('aria-activedescendant', mirrorId(first));
    picture.dataset.mirror = 'true';
  }, 60);
}

const showBar = (): void =>
  showTools(bar, tools, editor, known, {
    openLayout,
    takeFiles: (files) => void takeFiles(files),
    copyLayout: () => void copyLayout(),
    nameLayout,
    save: (form) => void save(form),
    choose,
    print: () => window.print(),
    fit: fitAll,
    help: showHelp,
    photo: (file) => void photoBeneath(editor, view, file).catch((error: unknown) => editor.say(String(error))),
    theme: () => {
      theme = theme === DARK ? LIGHT : DARK;
      store('theme', theme === DARK ? 'dark' : 'light');
      showAll();
    },
    language: () => {
      setLanguage(currentLanguage() === 'en' ? 'uk' : 'en');
      store('language', currentLanguage());
      showAll();
    },
  });
function showTray(): void {
  left.replaceChildren(
    h('h2', {}, t('tray')),
    tray(
      editor,
      (part) => drawing.colour(part, theme),
      (button, part, mirrored) => dragFromTray(button, picture, editor, view, part, mirrored),
    ),
  );
}
function showSide(): void {
  const held = right.querySelector('input')?.value ?? '';
  showSidePanel(right, editor, side, held, {
    choose: (to) => {
      side = to;
      showSide();
    },
    violation: reveal,
    part: (id) => {
      editor.select([id]);
      revealPart(id);
    },
    sheet: (sheet) => {
      view.fit({
        left: sheet.box.left + sheet.x,
        right: sheet.box.right + sheet.x,
        bottom: sheet.box.bottom + sheet.y,
        top: sheet.box.top + sheet.y,
      });
      later('view');
    },
  });
}
function showStatus(): void {
  const now = editor.live;
  const depth = now?.violations.reduce((most, v) => Math.max(most, v.amount_mm), 0) ?? 0;
  live.className = `live ${now?.level ?? ''}`;
  const { ruler } = pointer.overlay;
  live.textContent = ruler
    ? measured(ruler.from, ruler.to)
    : now
      ? [
          t(`live.${now.level}`),
          depth > 0 ? t('live.depth', { mm: depth.toFixed(3) }) : '',
          now.nearest ? t('live.nearest', { mm: now.nearest.distance.toFixed(3) }) : '',
        ]
          .filter(Boolean)
          .join(' · ')
      : editor.selection.size > 0
        ? t('selected', { n: editor.selection.size })
        : t('nothing');
  message.textContent = message.title = editor.message;
  const others = [...editor.others.keys()].filter((c) => c >= 0).length;
  status.dataset.pending = String(editor.pending);
  status.dataset.unchecked = String(editor.checking.left);
  state.textContent = [
    others > 0 ? t('others', { n: others }) : '',
    t(editor.pending > (editor.long ? 1 + editor.queued.length : 0) ? 'state.saving' : `state.${editor.connection}`),
  ]
    .filter(Boolean)
    .join(' · ');
}
function showAll(): void {
  document.documentElement.dataset.theme = theme === DARK ? 'dark' : 'light';
  picture.setAttribute('aria-label', t('canvas'));
  picture.dataset.drop = t('drop');
  legend.replaceChildren(
    ...(['zone', 'defect', 'bad', 'near'] as const).map((k) => h('span', { class: k }, h('i'), t(`legend.${k}`))),
  );
  showBar();
  longBar.show();
  later('all');
  requestAnimationFrame(() => {
    showTray();
    showSide();
  });
  showStatus();
}
function showHelp(): void {
  const dialog = h(
    'dialog',
    { 'aria-label': t('help') },
    h('h2', {}, t('help')),
    h('dl', {}, ...SHORTCUTS.flatMap(([keys, what]) => [h('dt', {}, keys), h('dd', {}, t(what as Key))])),
    h('form', { method: 'dialog' }, h('button', {}, t('close'))),
  );
  dialog.addEventListener('close', () => dialog.remove());
  page.append(dialog);
  dialog.showModal();
}

function fitView(): void {
  view.fit(editor.model.extent(), 28, true);
}
function fitAll(): void {
  fitView();
  later('view');
}
function reveal(v: Violation): void {
  const sheet = editor.model.sheet(v.stock, v.copy);
  if (!sheet) return;
  editor.select(v.b === null ? [v.a] : [v.a, v.b]);
  const [x, y] = [v.at[0] + sheet.x, v.at[1] + sheet.y];
  const r = Math.max(60, v.amount_mm * 4);
  view.fit({ left: x - r, right: x + r, bottom: y - r, top: y + r });
  later('view');
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
    later('view');
  }
}

interface Known {
  id: number;
  name: string;
}
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
  for (const file of [...(files ?? [])]) {
    const made = await take(file);
    if (typeof made === 'string') editor.say(made);
    else if (made?.stocks === 0) askSheet(file, made.id);
  }
}
interface Made {
  id: number;
  stocks: number;
  notices: string[];
}
/// Makes a layout of a file and opens it. \return why not; null: cancelled
async function take(file: File, sheet: Record<string, string> = {}): Promise<Made | string | null> {
  try {
    const answer = await editor.transfer(
      'open',
      t('transfer.open', { name: file.name }),
      'POST',
      `/api/layouts?${new URLSearchParams({ name: file.name, ...sheet })}`,
      file,
    );
    if (!answer) return null;
    if (answer.status !== 201) return await sentenceOf(answer);
    const made = JSON.parse(await answer.body.text()) as Made;
    await readLayouts();
    openLayout(made.id);
    if (made.notices.length > 0) editor.say(made.notices.join(' · '));
    return made;
  } catch (error) {
    return error instanceof Error ? error.message : String(error);
  }
}
/// Parts without stock: the same file once more with a sheet, in place of the first.
function askSheet(file: File, without: number): void {
  const kept = JSON.parse(stored('sheet') ?? '{"width": "2500", "height": "1250", "count": "1"}') as SheetSize;
  const dialog = sheetDialog(file.name, kept, async (size) => {
    const made = await take(file, { sheet: `${size.width}x${size.height}`, count: size.count });
    if (made === null || typeof made === 'string') return made ?? t('transfer.cancelled');
    store('sheet', JSON.stringify(size));
    await api(`/api/layouts/${without}`, { method: 'DELETE' });
    await readLayouts();
    return null;
  });
  page.append(dialog);
  dialog.showModal();
}
/// Exports as a download.
async function download(fields: URLSearchParams): Promise<Saved> {
  const form = fields.get('form')!;
  try {
    const answer = await editor.transfer(
      'export',
      t('transfer.export', { form }),
      'GET',
      `/api/layouts/${editor.layoutId}/export?${fields}`,
    );
    if (!answer) return { refused: t('transfer.cancelled'), notes: [] };
    if (answer.status !== 200) return { refused: await sentenceOf(answer), notes: [] };
    const name = /filename="([^"]*)"/.exec(answer.header('Content-Disposition') ?? '')?.[1] ?? `layout.${form}`;
    const address = URL.createObjectURL(answer.body);
    h('a', { href: address, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(address), 60_000);
    return { refused: null, notes: JSON.parse(answer.header('Lekalo-Notes') ?? '[]') as string[] };
  } catch (error) {
    return { refused: error instanceof Error ? error.message : String(error), notes: [] };
  }
}
/// A form without choices.
async function save(form: string): Promise<void> {
  const { refused, notes } = await download(new URLSearchParams({ form }));
  if (refused !== null || notes.length > 0) editor.say(refused ?? notes.join(' · '));
}
function choose(form: ChosenForm): void {
  const dialog = exportDialog(form, editor.model, {
    download,
    recall: (of) => {
      try {
        return JSON.parse(stored(`export.${of}`) ?? '{}') as Values;
      } catch {
        return {};
      }
    },
    keep: (of, values) => store(`export.${of}`, JSON.stringify(values)),
  });
  page.append(dialog);
  dialog.showModal();
}
async function copyLayout(): Promise<void> {
  const made = await api<{ id: number }>(
    `/api/layouts/${editor.layoutId}/copy?name=${encodeURIComponent(`${editor.name} 2`)}`,
    { method: 'POST' },
  );
  if (!made) return;
  await readLayouts();
  openLayout(made.id);
}
function nameLayout(): void {
  const { layoutId } = editor;
  if (layoutId === 0) return;
  const asked = async (path: string, method: string): Promise<string | null> => {
    const answer = await fetch(`/api/layouts/${layoutId}${path}`, { method });
    if (!answer.ok) return ((await answer.json()) as { error?: string }).error ?? String(answer.status);
    await readLayouts();
    return null;
  };
  const dialog = layoutDialog(editor.name, {
    rename: (name) => asked(`?name=${encodeURIComponent(name)}`, 'PATCH'),
    remove: async () => {
      editor.client?.stop();
      const refused = await asked('', 'DELETE');
      const next = known[0];
      if (next) openLayout(next.id);
      else location.reload();
      return refused;
    },
  });
  page.append(dialog);
  dialog.showModal();
}
function openLayout(id: number): void {
  editor.client?.stop();
  editor.layoutId = id;
  editor.selection.clear();
  editor.others.clear();
  editor.photos.clear();
  fitted = false;
  const here = new URL(location.href);
  here.searchParams.set('layout', String(id));
  here.searchParams.delete('token'); // a cookie holds it now, the address bar need not
  history.replaceState(null, '', here);
  const url = new URL(`/ws?layout=${id}&author=${author}`, location.href);
  url.protocol = url.protocol === 'https:' ? 'wss:' : 'ws:';
  editor.client = new Client(() => new WebSocket(url, 'lekalo.1') as unknown as Wire, {
    layout: (m) => {
      editor.open(m.document, m.name);
      void editor.photos.read('all');
    },
    change: (m) => editor.apply(m.placements, m.next_id, m.features),
    selections: (clients) => {
      editor.others = new Map(clients.map((c) => [c.client, c.ids]));
      editor.tell('selection');
    },
    name: (name) => {
      editor.name = name;
      void readLayouts();
    },
    photos: (stock, image) => void editor.photos.read(image ? { stock } : 'none'),
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
    fitView();
  }
  const wasMoving = picture.dataset.moving === 'true';
  const isMoving = editor.moving.size > 0;
  picture.dataset.moving = String(isMoving);
  picture.dataset.level = editor.live?.level ?? '';
  if (topic === 'long' || topic === 'check' || topic === 'transfer' || topic === 'layout') longBar.show();
  if (topic === 'long') later('top');
  else if (topic === 'check' || topic === 'transfer') return;
  else if (topic !== 'message' && topic !== 'connection')
    later(topic !== 'moving' || wasMoving !== isMoving ? 'all' : 'top');
  if (
    topic === 'mode' ||
    topic === 'show' ||
    (topic === 'photo' && editor.photos.size > 0 !== (tools.querySelector('[data-action="tool.photo"]') !== null))
  )
    showBar();
  const photosAtRest = topic === 'photo' && side === 'sheets' && ![...editor.photos].some((photo) => photo.pulled);
  if ((topic === 'layout' || topic === 'selection' || photosAtRest) && !panelsDue) {
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
  if (editor.model.sheets.length === 0) return;
  if (view.isFitted) fitView();
  later('all');
}).observe(picture);
picture.addEventListener('pointermove', (e) => {
  const box = picture.getBoundingClientRect();
  const [x, y] = view.toWorld(e.clientX - box.left, e.clientY - box.top);
  const sheet = editor.model.sheetAt(x, y);
  where.textContent = `${(x - (sheet?.x ?? 0)).toFixed(2)}  ${(y - (sheet?.y ?? 0)).toFixed(2)} mm`;
});
/// Wherever the focus is but in a field or a dialog; going from part to part and the space bar, in the picture alone.
document.addEventListener('keydown', (e) => {
  const inPicture = e.target === picture;
  const idle = inPicture || e.target === document.body;
  if (
    (e.target as HTMLElement).closest('input, select, dialog, details') ||
    (!inPicture && e.key === 'Tab') ||
    (!idle && e.key === ' ')
  )
    return;
  if (e.code === 'Space') pointer.spaceDown = true;
  if (pointer.features.draws && (e.key === 'Enter' || (e.key === 'Backspace' && pointer.features.back()))) {
    if (e.key === 'Enter') pointer.finishDraft();
    else later('top');
    return e.preventDefault();
  }
  const mine = key(e, editor, {
    fit: fitAll,
    help: showHelp,
    cancel: () => pointer.cancel(),
    reveal: revealPart,
    zoom: (factor) => {
      view.zoomAt(view.width / 2, view.height / 2, factor);
      later('view');
    },
    find: () => {
      side = 'parts';
      showSide();
      right.querySelector('input')?.focus();
    },
  });
  if (mine || e.code === 'Space') e.preventDefault();
});
document.addEventListener('keyup', (e) => {
  if (e.code === 'Space') pointer.spaceDown = false;
});
for (const [type, on] of [
  ['dragover', true],
  ['dragleave', false],
  ['drop', false],
] as const) {
  document.addEventListener(type, (e) => {
    e.preventDefault();
    picture.classList.toggle('dropping', on);
    if (type === 'drop') void takeFiles(e.dataTransfer?.files ?? null);
  });
}
const paper = h('div', { class: 'paper' });
document.body.append(paper);
window.addEventListener('beforeprint', () => paper.replaceChildren(...printed(editor)));
window.addEventListener('afterprint', () => paper.replaceChildren());

const bench = { editor, view, drawing, picture, base, top, scene, sliceMs: SLICE_MS };
/// For bench/speed.mjs and the tests.
Object.assign(window, {
  lekaloBench: {
    ...benchmark(bench),
    rows: ROWS,
    paintAll: () => paintAll(bench),
    photos: () =>
      [...editor.photos].map(({ stock, a, b, x, y, image: { width, height } }) => ({
        stock,
        a,
        b,
        x,
        y,
        width,
        height,
      })),
  },
});

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
