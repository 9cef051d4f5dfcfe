import { describe, expect, it } from 'vitest';
import type { LayoutDocument, Placement } from '../src/layout/document';
import { Editor } from '../src/editor/editor';
import { timeLeft } from '../src/page/long_bar';
import { Client, type Wire } from '../src/server/socket';
import { ServerKernel } from '../src/server/server_kernel';
import { droppedLine } from '../src/tools/pointer';
import { ServerDouble } from './double.mjs';

const at = (id: number, x: number, y: number): Placement => ({ id, part: 'p', stock: 's', c: 1, s: 0, x, y });
const two: LayoutDocument = {
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
  placements: [at(1, 5, 5), at(2, 50, 50)],
};
const soon = () => new Promise((resolve) => setTimeout(resolve, 1));

/** An editor on a stand-in that has begun to compact. */
async function compacting() {
  const double = new ServerDouble(two);
  const editor: Editor = new Editor(new ServerKernel(() => null));
  const wires: Wire[] = [];
  editor.client = new Client(
    () => {
      const wire: Wire = {
        onopen: null,
        onmessage: null,
        onclose: null,
        close: () => undefined,
        send: (text) => queueMicrotask(() => hear(double.answer(text))),
      };
      wires.push(wire);
      queueMicrotask(() => hear([double.hello()]));
      return wire;
    },
    {
      layout: (m) => editor.open(m.document, m.name),
      change: (m) => editor.apply(m.placements, m.next_id),
      selections: () => undefined,
      error: (m) => editor.say(m),
      connection: (s) => (editor.connection = s),
    },
  );
  const hear = (messages: object[]) => {
    for (const m of messages) wires.at(-1)!.onmessage?.({ data: JSON.stringify(m) });
  };
  editor.client.start();
  await soon();
  const compact = editor.command('compact towards -1 0');
  await soon();
  const drop = (p: Placement) => {
    editor.moving = new Map([[p.id, p]]);
    return editor.command(droppedLine(editor, 'select'));
  };
  return { double, editor, wires, hear, compact, drop };
}

describe('a long command', () => {
  it('shows how far it is and what it has found, and is one change at its end', async () => {
    const { double, editor, hear, compact } = await compacting();
    expect(editor.long).toMatchObject({ verb: 'compact', fraction: null, secondsLeft: null, stopping: false });
    hear(double.onTheWay(0.25, 3.2, [{ id: 2, after: at(2, 20, 50) }]));
    expect(editor.long).toMatchObject({ fraction: 0.25, secondsLeft: 3.2 });
    expect([...editor.coming().values()]).toEqual([at(2, 20, 50)]);
    expect(editor.model.placements.get(2)).toMatchObject({ x: 50 }); // not carried out yet
    hear(double.endLong([{ id: 2, after: at(2, 10, 50) }]));
    expect(await compact).toBe(true);
    expect(editor.long).toBeNull();
    expect(editor.coming().size).toBe(0);
    expect(editor.model.placements.get(2)).toMatchObject({ x: 10 });
  });
  it('is stopped once, by the number it was sent with, and says that the best is kept', async () => {
    const { double, editor, hear, compact } = await compacting();
    expect(editor.stopLong()).toBe(true);
    await soon();
    expect(double.stopped).toEqual([editor.long!.seq]);
    expect(editor.long!.stopping).toBe(true);
    hear(double.endLong([{ id: 2, after: at(2, 30, 50) }]));
    expect(await compact).toBe(true);
    expect(editor.message.text).toContain('best so far is kept');
    expect(editor.stopLong()).toBe(false);
  });
  it('takes back what it had found when it begins again', async () => {
    const { double, editor, hear } = await compacting();
    hear(double.onTheWay(0.5, 1, [{ id: 2, after: at(2, 20, 50) }]));
    hear(double.onTheWay(0.1, null));
    expect(editor.coming().size).toBe(0);
    expect(editor.long).toMatchObject({ fraction: 0.1, secondsLeft: null });
  });
  it('lets parts be dropped meanwhile: they go there when it has ended, wherever it has put them', async () => {
    const { double, editor, hear, compact, drop } = await compacting();
    const dropped = [drop(at(2, 70, 80)), drop(at(1, 40, 5))];
    await soon();
    expect(double.lines).toEqual(['compact towards -1 0']);
    expect(editor.moving.size).toBe(0); // the hand is free
    expect([...editor.coming().keys()].sort()).toEqual([1, 2]);
    hear(double.endLong([{ id: 2, after: at(2, 10, 50) }]));
    await compact;
    expect(await Promise.all(dropped)).toEqual([true, true]);
    expect(double.lines.slice(1)).toEqual(['move 2 by 60 30', 'move 1 by 35 0']);
    expect(editor.model.placements.get(2)).toMatchObject({ x: 70, y: 80 });
    expect(editor.coming().size).toBe(0);
    expect(editor.pending).toBe(0);
  });
  it('does not move what has been turned or taken away meanwhile', async () => {
    const { double, editor, hear, compact, drop } = await compacting();
    const dropped = [drop(at(2, 70, 80)), drop(at(1, 40, 5))];
    hear(
      double.endLong([
        { id: 2, after: null },
        { id: 1, after: { ...at(1, 5, 5), c: 0, s: 1 } },
      ]),
    );
    await compact;
    expect(await Promise.all(dropped)).toEqual([false, false]);
    expect(double.lines).toEqual(['compact towards -1 0']);
    expect(editor.message.text).toContain('drop them again');
    expect(editor.queued).toEqual([]);
    expect(editor.pending).toBe(0);
  });
  it('has the steps wait one after the other, the next long one too', async () => {
    const { double, editor, hear, compact } = await compacting();
    const steps = [editor.command('compact towards 0 -1'), editor.command('move 1 by 1 0')];
    hear(double.endLong([{ id: 2, after: at(2, 10, 50) }]));
    await compact;
    await soon();
    expect(double.lines.slice(1)).toEqual(['compact towards 0 -1']);
    hear(double.endLong([{ id: 1, after: at(1, 0, 0) }]));
    expect(await Promise.all(steps)).toEqual([true, true]);
    expect(double.lines.slice(2)).toEqual(['move 1 by 1 0']);
    expect(editor.model.placements.get(1)).toMatchObject({ x: 1, y: 0 });
  });
  it('leaves what is in hand in the hand when it ends', async () => {
    const { double, editor, hear, compact } = await compacting();
    editor.hold([at(1, 20, 20)], 'move 1 by 15 15');
    hear(double.endLong([{ id: 2, after: at(2, 10, 50) }]));
    await compact;
    expect(editor.moving.get(1)).toMatchObject({ x: 20, y: 20 });
    editor.release();
  });
  it('is over when the connection breaks, and what waits for it is lost with it', async () => {
    const { editor, wires, compact, drop } = await compacting();
    const dropped = drop(at(2, 70, 80));
    wires[0]!.onclose?.();
    expect([await compact, await dropped]).toEqual([false, false]);
    expect(editor.long).toBeNull();
    expect(editor.queued).toEqual([]);
    expect(editor.message.text).toContain('may not be saved');
    editor.client!.stop();
  });
});

describe('the time left', () => {
  it('is rounded up, in seconds or minutes, and nothing where it is not known', () => {
    expect([null, 0, 3.2, 89, 90, 200].map(timeLeft)).toEqual([
      '',
      '0 s left',
      '4 s left',
      '89 s left',
      '2 min left',
      '4 min left',
    ]);
  });
});
