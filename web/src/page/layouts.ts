// The layouts that the server keeps: opened, made of files, copied, named and deleted.

import { jobDialog, type OpenJob, type Said } from '../dialogs/job_dialog';
import { layoutDialog } from '../dialogs/layout_dialog';
import { orderDialog } from '../dialogs/order_dialog';
import { firstTerms, type OrderTerms, type Stock } from '../dialogs/order_form';
import type { Editor, Watched } from '../editor/editor';
import { showDialog } from '../html/elements';
import { t } from '../i18n';
import type { LayoutDocument, Part } from '../layout/document';
import { Client, type Wire } from '../server/socket';
import { sentenceOf } from '../tasks/transfer';
import { author, store, stored } from './settings';

export interface Known {
  id: number;
  name: string;
}
interface Made {
  id: number;
  stocks: number;
  notices: string[];
}

export interface LayoutsEvents {
  /** The list of layouts is another. */
  listed(): void;
  /** A layout is going to be opened. */
  opening(): void;
  /** A dialog has gone, and what had the focus before it is no more. */
  left(): void;
  /** There are other sheets than before. */
  resized(): void;
  /** There is none to open. */
  empty(): void;
}

/** The terms of the last order. A browser's memory may hold anything. */
function keptTerms(): OrderTerms {
  const terms = firstTerms();
  try {
    const kept = JSON.parse(stored('order') ?? '{}') as Partial<OrderTerms>;
    for (const key of ['gap', 'border', 'kerf'] as const) terms[key] = String(kept[key] ?? terms[key]);
    const stocks = (kept.stocks ?? []).filter((one: Stock) => one.kind !== 'drawing');
    return stocks.length > 0 ? { ...terms, stocks } : terms;
  } catch {
    return terms;
  }
}

export class Layouts {
  known: Known[] = [];
  private job: OpenJob | null = null;
  private reading: Promise<void> = Promise.resolve();

  constructor(
    private readonly editor: Editor,
    private readonly events: LayoutsEvents,
  ) {}

  async read(): Promise<void> {
    this.known = (await this.api<{ layouts: Known[] }>('/api/layouts'))?.layouts ?? this.known;
    this.events.listed();
  }

  /** Opens the layout that the address names, or the first. */
  async openFirst(): Promise<void> {
    const here = new URL(location.href);
    here.searchParams.delete('token'); // a cookie holds it now, the address bar need not
    history.replaceState(null, '', here);
    await this.read();
    const wanted = Number(here.searchParams.get('layout'));
    const first = this.known.find((one) => one.id === wanted) ?? this.known[0];
    if (first) this.open(first.id);
    else {
      this.editor.loading = false;
      this.events.empty();
    }
  }

  open(id: number): void {
    const { editor } = this;
    // The server ends the long command of who leaves, and keeps nothing of it.
    if (editor.long && !confirm(t('leave.running', { what: t(`long.${editor.long.verb}`) }))) {
      this.events.listed();
      return;
    }
    editor.client?.stop();
    editor.layoutId = id;
    editor.loading = true;
    editor.selection.clear();
    editor.others.clear();
    editor.photos.clear();
    this.events.opening();
    const here = new URL(location.href);
    here.searchParams.set('layout', String(id));
    history.replaceState(null, '', here);
    editor.client = this.connect(id);
    editor.client.start();
  }

  private connect(id: number): Client {
    const { editor } = this;
    const url = new URL(`/ws?layout=${id}&author=${author}`, location.href);
    url.protocol = url.protocol === 'https:' ? 'wss:' : 'ws:';
    return new Client(() => new WebSocket(url, 'lekalo.1') as unknown as Wire, {
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
        void this.read();
      },
      photos: (stock, image) => void editor.photos.read(image ? { stock } : 'none'),
      error: (text) => {
        editor.loading = false;
        editor.say(text);
      },
      connection: (to) => {
        editor.connection = to;
        editor.tell('connection');
      },
    });
  }

  /** Several drawings are one new layout; other files are layouts of their own. */
  async takeFiles(files: FileList | readonly File[] | null): Promise<void> {
    const all = [...(files ?? [])];
    const drawings = all.filter(({ name }) => /\.(dxf|svg)$/i.test(name));
    // A drawing that comes alone may have its sheets with it, as those have that lekalo exported.
    const together = drawings.length > 1 ? drawings : [];
    const refused: string[] = [];
    for (const file of all.filter((one) => !together.includes(one))) {
      const said = await this.takeFile(file);
      if (said !== null) refused.push(said);
    }
    if (refused.length > 0) this.editor.say(refused.join(' · '));
    if (together.length > 0) this.begin(together);
  }

  /** @returns the reason why a file was refused */
  private async takeFile(file: File): Promise<string | null> {
    const made = await this.take(file.name, '', file);
    if (typeof made === 'string') return made;
    if (made === null) this.editor.note(t('transfer.cancelled'));
    // Outlines alone: they are ordered with something to cut them from, in place of the layout without it.
    else if (made.stocks === 0) this.begin([file], made.id);
    return null;
  }

  /** Asks for a new layout of these drawings, which takes the place of the layout `without` stock. */
  begin(drawings: readonly File[], without = 0): void {
    const terms = keptTerms();
    const dialog = orderDialog(drawings, terms, {
      read: (file, signal) => this.readDrawing(file, signal),
      make: async (name, form, watched) => {
        const made = await this.take(name, '&order=1', form, watched);
        if (made === null || typeof made === 'string') return made ?? t('transfer.cancelled');
        store('order', JSON.stringify({ ...terms, stocks: terms.stocks.map((one) => ({ ...one, file: null })) }));
        if (without !== 0) {
          await this.api(`/api/layouts/${without}`, { method: 'DELETE' });
          await this.read();
        }
        return null;
      },
    });
    dialog.addEventListener('close', () => {
      if (document.activeElement === document.body) this.events.left();
    });
    showDialog(dialog);
  }

  /** Shows the parts and sheets of the layout that is open, which can be changed there. */
  editJob(): void {
    const { editor } = this;
    if (editor.layoutId === 0 || editor.loading) return;
    const said = (): Said => {
      const { text, isNote } = editor.message;
      return { text: text === t('nothing.moved') ? t('job.nothing') : text, isNote };
    };
    const job = jobDialog({
      model: () => editor.model,
      command: async (line) => {
        await editor.command(line);
        return said();
      },
      undo: async () => {
        await editor.undo();
        return said();
      },
      add: (form, watched) => this.addToJob(form, watched),
    });
    this.job = job;
    const sheets = editor.model.sheets.length;
    job.element.addEventListener('close', () => {
      this.job = null;
      if (editor.model.sheets.length !== sheets) this.events.resized();
      if (document.activeElement === document.body) this.events.left();
    });
    showDialog(job.element);
  }
  /** The layout is another one than before. */
  changed(): void {
    this.job?.refresh();
  }

  private async addToJob(form: FormData, watched: Watched): Promise<Said> {
    const { editor } = this;
    try {
      const address = `/api/layouts/${editor.layoutId}/order?author=${author}`;
      const answer = await editor.transfer('open', t('job.adding'), 'POST', address, form, watched);
      if (!answer) return { text: t('transfer.cancelled'), isNote: true };
      if (answer.status !== 200) return { text: await sentenceOf(answer), isNote: false };
      const { notices } = JSON.parse(await answer.body.text()) as { notices: string[] };
      return { text: notices.join(' · '), isNote: true };
    } catch (error) {
      return { text: error instanceof Error ? error.message : String(error), isNote: false };
    }
  }

  /** Reads drawings one after the other: many at once would only wait for each other in the server. */
  private async readDrawing(file: File, signal: AbortSignal): Promise<Part[] | string | null> {
    const before = this.reading;
    let done = (): void => undefined;
    this.reading = new Promise((resolve) => (done = resolve));
    await before;
    try {
      const address = `/api/drawings?${new URLSearchParams({ name: file.name })}`;
      const answer = await fetch(address, { method: 'POST', body: file, signal });
      const read = (await answer.json()) as { document?: LayoutDocument; error?: string };
      return read.document?.parts ?? read.error ?? String(answer.status);
    } catch (error) {
      return signal.aborted ? null : String(error);
    } finally {
      done();
    }
  }

  /**
   * Makes a layout and opens it.
   *
   * @returns a string: the reason why not; null: it was cancelled
   */
  private async take(
    name: string,
    form: string,
    body: Blob | FormData,
    watched?: Watched,
  ): Promise<Made | string | null> {
    const { editor } = this;
    try {
      const address = `/api/layouts?${new URLSearchParams({ name })}${form}`;
      const answer = await editor.transfer('open', t('transfer.open', { name }), 'POST', address, body, watched);
      if (!answer) return null;
      if (answer.status !== 201) return await sentenceOf(answer);
      const made = JSON.parse(await answer.body.text()) as Made;
      await this.read();
      this.open(made.id);
      if (made.notices.length > 0) editor.note(made.notices.join(' · '));
      return made;
    } catch (error) {
      return error instanceof Error ? error.message : String(error);
    }
  }

  async copy(): Promise<void> {
    const { layoutId, name } = this.editor;
    const address = `/api/layouts/${layoutId}/copy?name=${encodeURIComponent(`${name} 2`)}`;
    const made = await this.api<{ id: number }>(address, { method: 'POST' });
    if (!made) return;
    await this.read();
    this.open(made.id);
  }

  /** Asks for another name, or whether the layout is to be deleted. */
  name(): void {
    const { editor } = this;
    const { layoutId } = editor;
    if (layoutId === 0) return;
    const asked = async (path: string, method: string): Promise<string | null> => {
      const answer = await fetch(`/api/layouts/${layoutId}${path}`, { method });
      if (!answer.ok) return ((await answer.json()) as { error?: string }).error ?? String(answer.status);
      await this.read();
      return null;
    };
    const dialog = layoutDialog(editor.name, {
      rename: (name) => asked(`?name=${encodeURIComponent(name)}`, 'PATCH'),
      remove: async () => {
        editor.client?.stop();
        const refused = await asked('', 'DELETE');
        const next = this.known[0];
        if (next) this.open(next.id);
        else location.reload();
        return refused;
      },
    });
    showDialog(dialog);
  }

  /** The server's answer; null: there is none, and the editor has said why. */
  private async api<T>(path: string, init?: RequestInit): Promise<T | null> {
    try {
      const answer = await fetch(path, init);
      const body = (await answer.json()) as T & { error?: string };
      if (answer.ok) return body;
      this.editor.say(body.error ?? `${answer.status}`);
    } catch (error) {
      this.editor.say(error instanceof Error ? error.message : String(error));
    }
    return null;
  }
}
