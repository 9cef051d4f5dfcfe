// The actions of buttons and keys.

import * as line from '../layout/commands';
import type { Editor } from '../editor/editor';
import { movedBy } from '../editor/editor';
import { t } from '../i18n';

/** A nesting that nobody stops ends after this many seconds. */
const NEST_SECONDS = 60;
/** Counts the nestings. The count is the seed, so that each run tries other things than the one before. */
let nestings = 0;

export type Action =
  | 'rotate.left'
  | 'rotate.right'
  | 'flip'
  | 'settle'
  | 'snap'
  | 'lock'
  | 'swap'
  | 'remove'
  | 'copy'
  | 'compact'
  | 'nest'
  | 'slide.left'
  | 'slide.right'
  | 'slide.up'
  | 'slide.down'
  | 'undo'
  | 'redo';

export async function act(editor: Editor, action: Action): Promise<void> {
  if (action === 'undo') return void (await editor.undo());
  if (action === 'redo') return void (await editor.redo());
  const ids = editor.chosen();
  const chosen = editor.placementsOf(ids);
  const first = chosen[0];
  if (action === 'compact') {
    const sheet = first && editor.model.sheet(first.stock, first.copy);
    await editor.command(line.compact(-1, 0, sheet));
    return;
  }
  if (action === 'nest') {
    const loose = chosen.filter((p) => !p.locked);
    if (first && loose.length === 0) return editor.say(t('nest.locked'));
    await editor.command(
      line.nest(
        loose.map((p) => p.id),
        NEST_SECONDS,
        nestings++,
      ),
    );
    return;
  }
  if (!first) return;
  switch (action) {
    case 'rotate.left':
      await editor.command(line.rotate(ids, editor.rotateStep));
      break;
    case 'rotate.right':
      await editor.command(line.rotate(ids, -editor.rotateStep));
      break;
    case 'flip':
      await editor.command(line.simple('flip', ids));
      break;
    case 'settle':
      await editor.command(line.settle(ids, 0, -1, -1, 0));
      break;
    case 'snap':
      await editor.command(line.snap(first.id, 20));
      break;
    case 'lock':
      await editor.command(line.simple(chosen.every((p) => p.locked) ? 'unlock' : 'lock', ids));
      break;
    case 'swap':
      if (ids.length === 2) await editor.command(line.swap(ids[0]!, ids[1]!));
      break;
    case 'remove':
      await editor.command(line.simple('remove', ids));
      break;
    case 'copy':
      await copy(editor);
      break;
    case 'slide.left':
      await editor.command(line.slide(ids, -1, 0));
      break;
    case 'slide.right':
      await editor.command(line.slide(ids, 1, 0));
      break;
    case 'slide.up':
      await editor.command(line.slide(ids, 0, 1));
      break;
    case 'slide.down':
      await editor.command(line.slide(ids, 0, -1));
      break;
  }
}

/** Puts down each chosen part once more: beside itself in free mode, where one fits in strict mode. */
async function copy(editor: Editor): Promise<void> {
  const made: number[] = [];
  for (const p of editor.placementsOf(editor.chosen())) {
    const sheet = editor.model.sheet(p.stock, p.copy);
    if (!sheet) continue;
    const box = editor.model.box(p);
    const text =
      editor.mode === 'free'
        ? line.place(movedBy([p], (box.right - box.left) / 4, (box.top - box.bottom) / 4)[0]!)
        : line.fit(p.part, sheet, p.mirrored ? 'mirrored' : 'upright');
    if (!(await editor.command(text))) break;
    made.push(...editor.selection);
  }
  if (made.length > 0) editor.select(made);
}
