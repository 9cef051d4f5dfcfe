// The layouts that the server keeps: opened, made of files, copied, named and deleted.

import { layoutDialog } from '../dialogs/layout_dialog';
import { sheetDialog, type SheetSize } from '../dialogs/sheet_dialog';
import type { Editor } from '../editor/editor';
import { showDialog } from '../html/elements';
import { t } from '../i18n';
import { Client, type Wire } from '../server/socket';
import { sentenceOf } from '../work/transfer';
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
}

export class Layouts {
  known: Known[] = [];

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
    await this.read();
    const wanted = Number(new URL(location.href).searchParams.get('layout'));
    const first = this.known.find((one) => one.id === wanted) ?? this.known[0];
    if (first) this.open(first.id);
    else this.editor.say(t('none.layouts'));
  }

  open(id: number): void {
    const { editor } = this;
    editor.client?.stop();
    editor.layoutId = id;
    editor.selection.clear();
    editor.others.clear();
    editor.photos.clear();
    this.events.opening();
    const here = new URL(location.href);
    here.searchParams.set('layout', String(id));
    here.searchParams.delete('token'); // a cookie holds it now, the address bar need not
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
      error: (text) => editor.say(text),
      connection: (to) => {
        editor.connection = to;
        editor.tell('connection');
      },
    });
  }

  async takeFiles(files: FileList | null): Promise<void> {
    for (const file of [...(files ?? [])]) {
      const made = await this.take(file);
      if (typeof made === 'string') this.editor.say(made);
      else if (made?.stocks === 0) this.askSheet(file, made.id);
    }
  }

  /**
   * Makes a layout of a file and opens it.
   *
   * @returns a string: the reason why not; null: it was cancelled
   */
  private async take(file: File, sheet: Record<string, string> = {}): Promise<Made | string | null> {
    const { editor } = this;
    try {
      const address = `/api/layouts?${new URLSearchParams({ name: file.name, ...sheet })}`;
      const answer = await editor.transfer('open', t('transfer.open', { name: file.name }), 'POST', address, file);
      if (!answer) return null;
      if (answer.status !== 201) return await sentenceOf(answer);
      const made = JSON.parse(await answer.body.text()) as Made;
      await this.read();
      this.open(made.id);
      if (made.notices.length > 0) editor.say(made.notices.join(' · '));
      return made;
    } catch (error) {
      return error instanceof Error ? error.message : String(error);
    }
  }

  /** A file of parts without stock is taken once more with a sheet, in place of the layout `without` one. */
  private askSheet(file: File, without: number): void {
    const kept = JSON.parse(stored('sheet') ?? '{"width": "2500", "height": "1250", "count": "1"}') as SheetSize;
    const dialog = sheetDialog(file.name, kept, async (size) => {
      const made = await this.take(file, { sheet: `${size.width}x${size.height}`, count: size.count });
      if (made === null || typeof made === 'string') return made ?? t('transfer.cancelled');
      store('sheet', JSON.stringify(size));
      await this.api(`/api/layouts/${without}`, { method: 'DELETE' });
      await this.read();
      return null;
    });
    showDialog(dialog);
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
