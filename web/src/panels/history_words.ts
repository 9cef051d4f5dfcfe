// A change of the history in words: what was done, and to which parts.

import { isKey, t, type Key } from '../i18n';
import { wordsOf } from '../layout/commands';

/** What a change did to the placements of a part: docs/protocol.md. */
export interface Touched {
  /** The part's number in the document, or the id of one that is not there any more. */
  part: number | string;
  first: number;
  placed: number;
  changed: number;
  removed: number;
}
export interface Entry {
  revision: number;
  at: string;
  author: string | number;
  text: string;
  kind: 'command' | 'undo' | 'redo' | 'restore';
  undone: boolean;
  damaged: boolean;
  parts: Touched[];
}

/** Of a change of many parts, the first are named. */
const MOST_NAMED = 3;
const STOPPED = ' # stopped early';

/** @param nameOf the name of a part that is touched */
function partsIn(touched: readonly Touched[], nameOf: (part: number | string) => string): string {
  const count = (one: Touched): number => one.placed + one.changed + one.removed;
  const what = touched
    .slice(0, MOST_NAMED)
    .map((one) => {
      const part = nameOf(one.part);
      return count(one) === 1 ? `${part} ${one.first}` : t('history.of', { n: count(one), part });
    })
    .join(', ');
  const more = touched.slice(MOST_NAMED).reduce((sum, one) => sum + count(one), 0);
  return more > 0 ? t('history.more', { what, n: more }) : what;
}

/** The verbs that change the job, with what each names. */
const JOB = /^(add|quantity|rotations|mirror|remove-part|add-sheet|add-strip|count|remove-stock|gap|border|kerf)$/;

function jobIn(entry: Entry, nameOf: (part: number | string) => string): string {
  const [verb = '', id = '', value = '', ...more] = wordsOf(entry.text);
  const key = (verb === 'mirror' ? `history.mirror.${value}` : `history.${verb}`) as Key;
  // The first word behind these verbs is a part; others name material, or a length.
  const what = /^(quantity|rotations|mirror|remove-part)$/.test(verb) ? nameOf(id) : id;
  const said = t(key, { id: what, value, all: [id, value, ...more].filter((word) => word !== '').join(', ') });
  return entry.parts.length === 0 ? said : t('history.with', { said, what: partsIn(entry.parts, nameOf) });
}

function commandIn(entry: Entry, nameOf: (part: number | string) => string): string {
  const [verb = '', , id = ''] = wordsOf(entry.text);
  const drawn = /^(add|move|reshape|grade|remove)-(defect|zone)$/.exec(verb);
  if (drawn) return t(`history.${drawn[1]}-feature` as Key, { what: t(`history.${drawn[2]}` as Key, { id }) });
  if (JOB.test(verb)) return jobIn(entry, nameOf);
  const key = `history.${verb}`;
  // A verb that has no words here is shown as it was written.
  return isKey(key) ? t(key, { what: partsIn(entry.parts, nameOf) }) : entry.text;
}

export function inWords(entry: Entry, nameOf: (part: number | string) => string): string {
  if (entry.damaged) return t('history.damaged');
  if (entry.kind === 'restore') return t('history.back', { n: wordsOf(entry.text)[1] ?? '' });
  const said = commandIn(entry, nameOf);
  const what = entry.text.endsWith(STOPPED) ? t('history.stopped', { what: said }) : said;
  return entry.kind === 'command' ? what : t(`history.${entry.kind}`, { what });
}
