import { describe, expect, it, vi } from 'vitest';
import type { LayoutDocument } from '../src/layout/document';
import { Editor } from '../src/editor/editor';
import { Client, type SocketEvents, type Wire } from '../src/server/socket';
import { ServerKernel } from '../src/server/server_kernel';
import { ServerDouble } from './double.mjs';

const square: LayoutDocument = {
  format: 'lekalo-layout/1',
  units: 'mm',
  stocks: [
    {
      id: 's',
      kind: 'sheet',
      outline: {
        polygon: {
          outer: [
            [0, 0],
            [100, 0],
            [100, 100],
            [0, 100],
          ],
        },
      },
    },
  ],
  parts: [
    {
      id: 'p',
      outline: {
        polygon: {
          outer: [
            [0, 0],
            [10, 0],
            [10, 10],
            [0, 10],
          ],
        },
      },
    },
  ],
  placements: [{ id: 1, part: 'p', stock: 's', c: 1, s: 0, x: 5, y: 5 }],
};

/** An editor on a stand-in; `wires` are the connections it made. */
function setup(options = {}) {
  const double = new ServerDouble(square, options);
  const wires: Wire[] = [];
  const editor: Editor = new Editor(new ServerKernel(() => editor.client));
  const events: SocketEvents = {
    layout: (m) => editor.open(m.document, m.name),
    change: (m) => editor.apply(m.placements, m.next_id),
    selections: () => undefined,
    error: (m) => editor.say(m),
    connection: (s) => (editor.connection = s),
  };
  editor.client = new Client(() => {
    const wire: Wire = {
      onopen: null,
      onmessage: null,
      onclose: null,
      close: () => wire.onclose?.(),
      send: (text) =>
        queueMicrotask(() => {
          for (const m of double.answer(text)) wire.onmessage?.({ data: JSON.stringify(m) });
        }),
    };
    wires.push(wire);
    queueMicrotask(() => wire.onmessage?.({ data: JSON.stringify(double.hello()) }));
    return wire;
  }, events);
  editor.client.start();
  return { double, editor, wires };
}
const soon = () => new Promise((resolve) => setTimeout(resolve, 1));

describe('the client', () => {
  it('carries out a command, undoes and redoes it', async () => {
    const { editor } = setup();
    await soon();
    expect(await editor.command('move 1 by 2 3')).toBe(true);
    expect(editor.model.placements.get(1)).toMatchObject({ x: 7, y: 8 });
    await editor.undo();
    expect(editor.model.placements.get(1)).toMatchObject({ x: 5, y: 5 });
    await editor.redo();
    expect(editor.model.placements.get(1)).toMatchObject({ x: 7, y: 8 });
  });
  it('leaves the layout as it was when a command is refused, and says why', async () => {
    const { editor } = setup({ refuse: () => 'not admitted: 1 is outside' });
    await soon();
    expect(await editor.command('move 1 by 200 0')).toBe(false);
    expect(editor.message.text).toBe('not admitted: 1 is outside');
    expect(editor.model.placements.get(1)).toMatchObject({ x: 5, y: 5 });
    expect(editor.moving.size).toBe(0);
  });
  it('never says clear before the server has answered', async () => {
    const { editor } = setup({
      violations: () => [{ kind: 'outside', a: 1, b: null, stock: 's', copy: 0, amount_mm: 1, at: [0, 0] }],
    });
    await soon();
    editor.hold([{ ...square.placements![0]!, x: -1 }], 'move 1 by -6 0');
    expect(editor.live?.level).toBe('unknown');
    await soon();
    expect(editor.live?.level).toBe('forbidden');
    expect(editor.violations).toBeNull();
  });
  it('reads the layout anew where a revision is missing', async () => {
    vi.useFakeTimers();
    const { editor, wires, double } = setup();
    await vi.advanceTimersByTimeAsync(1);
    double.revision = 9;
    wires[0]!.onmessage?.({
      data: JSON.stringify({
        type: 'change',
        revision: 9,
        client: 5,
        text: '',
        kind: 'command',
        placements: [{ id: 1, after: null }],
        next_id: 2,
      }),
    });
    expect(editor.model.placements.has(1)).toBe(true);
    await vi.advanceTimersByTimeAsync(300);
    expect(wires.length).toBe(2);
    expect(editor.client!.revision).toBe(9);
    vi.useRealTimers();
  });
  it('says that a command is lost when the connection breaks, and connects again', async () => {
    vi.useFakeTimers();
    const { editor, wires } = setup();
    await vi.advanceTimersByTimeAsync(1);
    wires[0]!.send = () => undefined;
    const asked = editor.command('move 1 by 1 0');
    wires[0]!.onclose?.();
    expect(await asked).toBe(false);
    expect(editor.message.text).toContain('may not be saved');
    await vi.advanceTimersByTimeAsync(300);
    expect(editor.connection).toBe('open');
    vi.useRealTimers();
  });
});
