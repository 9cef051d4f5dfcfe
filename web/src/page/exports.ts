// Exports of the layout, saved as downloads.

import type { ChosenForm, Values } from '../dialogs/export_choices';
import { exportDialog, type Saved } from '../dialogs/export_dialog';
import type { Editor } from '../editor/editor';
import { h, showDialog } from '../html/elements';
import { t } from '../i18n';
import { sentenceOf } from '../tasks/transfer';
import { store, stored } from './settings';

/** A download needs its address until the browser has taken it. */
const KEEP_ADDRESS_MS = 60_000;

async function download(editor: Editor, fields: URLSearchParams): Promise<Saved> {
  const form = fields.get('form')!;
  try {
    const address = `/api/layouts/${editor.layoutId}/export?${fields}`;
    const answer = await editor.transfer('export', t('transfer.export', { form }), 'GET', address);
    if (!answer) return { refused: t('transfer.cancelled'), notes: [] };
    if (answer.status !== 200) return { refused: await sentenceOf(answer), notes: [] };
    const name = /filename="([^"]*)"/.exec(answer.header('Content-Disposition') ?? '')?.[1] ?? `layout.${form}`;
    const href = URL.createObjectURL(answer.body);
    h('a', { href, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(href), KEEP_ADDRESS_MS);
    return { refused: null, notes: JSON.parse(answer.header('Lekalo-Notes') ?? '[]') as string[] };
  } catch (error) {
    return { refused: error instanceof Error ? error.message : String(error), notes: [] };
  }
}

/** Saves a form that leaves nothing to choose. */
export async function saveAs(editor: Editor, form: string): Promise<void> {
  const { refused, notes } = await download(editor, new URLSearchParams({ form }));
  if (refused !== null) editor.say(refused);
  else if (notes.length > 0) editor.note(notes.join(' · '));
}

/** Asks what a form leaves to choose, and saves it. */
export function chooseAndSave(editor: Editor, form: ChosenForm): void {
  const dialog = exportDialog(form, editor.model, {
    download: (fields) => download(editor, fields),
    recall: (of) => {
      try {
        return JSON.parse(stored(`export.${of}`) ?? '{}') as Values;
      } catch {
        return {};
      }
    },
    keep: (of, values) => store(`export.${of}`, JSON.stringify(values)),
  });
  showDialog(dialog);
}
