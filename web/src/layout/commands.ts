// The lines of the command language: docs/design/layout-commands.md.

import type { Placement } from './document';
import { textOfMm } from './grid';
import type { Sheet } from './model';

/** Strict: the server refuses what breaks a rule. Free: it carries it out. */
export type Mode = 'strict' | 'free';

const quoted = (name: string): string => `"${name.replace(/[\\"]/g, '\\$&').replace(/\n/g, '\\n')}"`;
/** The words of a line; a name in quotation marks is one of them. */
export const wordsOf = (line: string): string[] =>
  [...line.matchAll(/"((?:[^"\\]|\\.)*)"|\S+/g)].map((found) =>
    found[1] === undefined ? found[0] : found[1].replace(/\\(.)/g, (_, c: string) => (c === 'n' ? '\n' : c)),
  );
/** The name of a defect or zone: its stock and id. */
interface Named {
  stock: string;
  kind: 'defect' | 'zone';
  id: string;
}
const named = (verb: string, f: Named): string => `${verb}-${f.kind} ${quoted(f.stock)} ${quoted(f.id)}`;
const ids = (list: readonly number[]): string => [...list].sort((a, b) => a - b).join(',');
const pair = (x: number, y: number): string => `${textOfMm(x)} ${textOfMm(y)}`;
const sheetOf = (sheet?: Sheet): string => (sheet ? ` to ${quoted(sheet.stock.id)} ${sheet.copy}` : '');
/** A number in decimals without an exponent, which reads back to the same double. */
const exact = (value: number): string => {
  const text = String(value);
  return text.includes('e') ? value.toFixed(40).replace(/0+$/, '') : text;
};

export const place = (p: Placement): string =>
  `place ${quoted(p.part)} ${quoted(p.stock)} ${p.copy ?? 0} ${exact(p.c)} ${exact(p.s)} ${pair(p.x, p.y)} ${p.mirrored ? 'mirrored' : 'upright'}`;
export const fit = (part: string, sheet: Sheet, hand?: 'upright' | 'mirrored'): string =>
  `fit ${quoted(part)} ${quoted(sheet.stock.id)} ${sheet.copy}${hand ? ` ${hand}` : ''}`;
export const move = (list: readonly number[], x: number, y: number, to?: Sheet): string =>
  `move ${ids(list)} by ${pair(x, y)}${sheetOf(to)}`;
export const nearest = (list: readonly number[], x: number, y: number, to?: Sheet): string =>
  `nearest ${ids(list)} by ${pair(x, y)}${sheetOf(to)}`;
export const rotate = (list: readonly number[], degrees: number): string => `rotate ${ids(list)} ${exact(degrees)}`;
export const simple = (verb: 'flip' | 'remove' | 'lock' | 'unlock', list: readonly number[]): string =>
  `${verb} ${ids(list)}`;
export const swap = (a: number, b: number): string => `swap ${a} ${b}`;
export const slide = (list: readonly number[], x: number, y: number): string =>
  `slide ${ids(list)} towards ${exact(x)} ${exact(y)}`;
export const settle = (list: readonly number[], x: number, y: number, x2: number, y2: number): string =>
  `settle ${ids(list)} towards ${x} ${y} then ${x2} ${y2}`;
export const push = (list: readonly number[], x: number, y: number): string => `push ${ids(list)} by ${pair(x, y)}`;
export const snap = (id: number, reach: number): string => `snap ${id} within ${textOfMm(reach)}`;
export const addFeature = (f: Named, grade: number, outline: readonly (readonly [number, number])[]): string =>
  `${named('add', f)} ${grade} outline ${outline.map(([x, y]) => pair(x, y)).join(' ')}`;
export const moveFeature = (f: Named, x: number, y: number): string => `${named('move', f)} by ${pair(x, y)}`;
export const gradeFeature = (f: Named, grade: number): string => `${named('grade', f)} ${grade}`;
export const removeFeature = (f: Named): string => named('remove', f);
/** Nests these parts or, without ids, the whole layout. The command is the server's own (docs/protocol.md). */
export const nest = (list: readonly number[], seconds: number, seed: number): string =>
  `nest ${list.length > 0 ? `${ids(list)} ` : ''}for ${seconds} seed ${seed}`;
/** Compacts a sheet or, without one, all in use. */
export const compact = (x: number, y: number, sheet?: Sheet): string =>
  `compact ${sheet ? `${quoted(sheet.stock.id)} ${sheet.copy} ` : ''}towards ${x} ${y}`;

/** What was typed as one word of a line, whatever it is: the server says what is wrong with it. */
const typedWord = (typed: string): string => (/^[^\s"]+$/.test(typed.trim()) ? typed.trim() : quoted(typed.trim()));
export const quantity = (part: string, typed: string): string => `quantity ${quoted(part)} ${typedWord(typed)}`;
export const rotations = (part: string, angles: string): string => `rotations ${quoted(part)} ${typedWord(angles)}`;
export const mirror = (part: string, may: boolean): string => `mirror ${quoted(part)} ${may ? 'yes' : 'no'}`;
export const removePart = (part: string): string => `remove-part ${quoted(part)}`;
export const count = (stock: string, typed: string): string => `count ${quoted(stock)} ${typedWord(typed)}`;
export const removeStock = (stock: string): string => `remove-stock ${quoted(stock)}`;
export const rule = (name: 'gap' | 'border' | 'kerf', typed: string): string => `${name} ${typedWord(typed)}`;
